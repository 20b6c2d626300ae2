"""The door between what a person sees and generation: progress and outcome up, with words for every code.

    records.py   Progress while a job runs, Outcome when it is over
    words.py     cause and remedy of every fault

Rule: a screen is a function of these records. May import kmd (for its codes) only.
"""

from drillctl.panel.records import FaultReport, Outcome, Progress
from drillctl.panel.words import FAULT_WORDS, FaultWords, fault_report

__all__ = ["FAULT_WORDS", "FaultReport", "FaultWords", "Outcome", "Progress", "fault_report"]
