"""Runs that nobody drills by: what a job will take, before it is run, and how punctual this computer is.

    forecast.py   ticks of every command of a program, exact on the ideal plant
    capacity.py   how many ticks a second this computer can work off
    latency.py    how late ticks begin here, and whose fault that is
    wakes.py      what it measures; grades.py: what that is good for

May import execution, machine, kmd, panel, and the wiring of ticks.
"""

from drillctl.lab.forecast import Forecast, forecast

__all__ = ["Forecast", "forecast"]
