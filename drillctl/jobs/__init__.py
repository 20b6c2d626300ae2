"""One run of a job, from the program to the last line of its journal.

    runner.py      takes a job down the queue to its end     session.py    opens port and journal around it
    journal/       each hole begun and done, a chain of lines     site.py  where a job runs: port, pace, plant
    estimate.py    what a job will take, and what is left of it
    interrupts.py  what Ctrl-C and SIGTERM do                keys.py       the operator's keys on a terminal
"""
