"""One run of a job, from the program to the last line of its journal.

    session.py     opens port and journal, runs the job, closes both
    runner.py      fills the queue, journals each hole, says how the job ended
    operator.py    requests, hold and tool changes, as the runner asks for them
    keys.py        an operator's keys on a terminal
    journal/       each hole begun and done, a chain of lines
    site.py        where a job runs: port, pace, plant
    estimate.py    what a job will take, and what is left of it
    interrupts.py  what Ctrl-C and SIGTERM do

Rule: a hole is journalled as begun before its commands are sent, and as done after execution has confirmed it.
"""
