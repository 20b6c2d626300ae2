"""Runs without a clock and without a person: what a job will take, before it is run.

    forecast.py   ticks of every command of a program, exact on the ideal plant

May import machine, kmd and the wiring of ticks.
"""

from drillctl.lab.forecast import Forecast, forecast

__all__ = ["Forecast", "forecast"]
