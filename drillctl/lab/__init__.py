"""Experiments that drill nothing: how punctual this computer is, which moves lose steps, the fastest ramp.

    latency.py        how late ticks begin here, and whose fault that is
    wakeups.py        what it measures                 grades.py         what a measured lateness is good for
    moves.py          what an axis puts out for a move  trials.py        thousands of these on the dynamic plant
    dynamic_rerun.py  a recorded run on the dynamic plant  pictures.py   what is drawn of it, the pull-out curve
    question.py       what a sweep asks  answers.py      its rows   sweep.py  a question answered into a file
    workers.py        by how many processes            sweep_picture.py  the picture of a sweep
    tune.py           the fastest ramp, as a table     ramp_trials.py, retargeting.py   tried, and proved exact
    tables.py         the tables that an operator names, and tables broken on purpose
"""
