"""The door between what a person sees and generation: progress and outcome up, with words for every code.

    records.py   Estimate before a job, Progress while it runs, Outcome when it is over
    jobs.py      what is asked of a board; recent and unfinished jobs
    manual_control.py  signals, outputs by hand, single ticks    ports.py  the port in use and a test of it
    fault_texts.py     cause and remedy of every fault
    latency.py   LatencyReport: how punctual ticks are here

Rule: a screen is a function of these records. May import kmd (for its codes) only.
"""

from drillctl.viewmodel.fault_texts import FAULT_WORDS, FaultWords, fault_report
from drillctl.viewmodel.records import Estimate, FaultReport, Outcome, Progress, ToolEstimate

__all__ = [
    "FAULT_WORDS", "Estimate", "FaultReport", "FaultWords", "Outcome", "Progress", "ToolEstimate", "fault_report",
]  # fmt: skip
