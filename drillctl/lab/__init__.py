"""Runs that nobody drills by: what a job will take, how punctual this computer is, which moves lose steps.

    forecast.py   ticks of every command of a program, exact on the ideal plant
    capacity.py   how many ticks a second this computer can work off
    latency.py    how late ticks begin here, and whose fault that is
    wakes.py      what it measures; grades.py: what that is good for
    moves.py      what an axis puts out for a move        trials.py  thousands of these on the dynamic plant
    broken.py     phase tables broken on purpose

May import execution, machine, kmd, panel, plant, and the wiring of ticks.
"""

from drillctl.lab.forecast import Forecast, forecast

__all__ = ["Forecast", "forecast"]
