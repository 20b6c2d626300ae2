"""Experiments that drill nothing: how punctual this computer is, which moves lose steps, the fastest ramp.

    latency.py        how late ticks begin on this computer, and whose fault that is
    wakeups.py        the log of one process's wakeups, in shared memory
    grades.py         what a measured lateness is good for

    moves.py          what an axis puts out for one move
    trials.py         thousands of such moves on the dynamic plant

    board.py          a board that many machines drill
    question.py       the grid of machines that a sweep tries
    answers.py        the rows of its results
    workers.py        the processes that work them out
    sweep.py          the results file, and the sweep itself
    sweep_picture.py  the picture of a sweep

    tune.py           the search for the fastest ramp
    tune_board.py     the fastest setting for a board
    ramp_trials.py, retargeting.py   ramps tried and proved exact

    table_bench.py   a table that is being edited, tried on the motors of a machine

    dynamic_rerun.py  a recorded run on the dynamic plant
    pictures.py       what is drawn of it; the pull-out curve
    tables.py         the tables that an operator names, and tables broken on purpose

Rule: no port is opened here and nothing paces a machine; the controller is the one that drives real machines.
"""
