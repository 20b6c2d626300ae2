"""Runs that nobody drills by: what a job will take, how punctual this computer is, which moves lose steps.

    forecast.py   ticks of every command of a program, exact on the ideal plant
    capacity.py   how many ticks a second this computer can work off
    latency.py    how late ticks begin here, and whose fault that is
    wakes.py      what it measures; grades.py: what that is good for
    moves.py      what an axis puts out for a move        trials.py  thousands of these on the dynamic plant
    broken.py     phase tables broken on purpose
    watched.py    a recorded run once more on the dynamic plant   pictures.py, pullout.py   what is drawn of it
    question.py   what a sweep asks     answers.py, crowd.py      by how many processes it is answered
    results.py    into which file       sweep.py, sweep_picture.py
    tune.py       the fastest ramp      ramp_trials.py, retargeting.py, ramp_text.py   tried, proved, written
    tables.py, numbers.py               what an operator names and lists          errors.py  LabError

May import execution, machine, kmd, panel, plant, and the wiring of ticks.
"""

from drillctl.lab.forecast import Forecast, forecast

__all__ = ["Forecast", "forecast"]
