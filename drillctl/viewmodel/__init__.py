"""The door of layer 1: what a person may see and ask, as records and protocols, with words for every fault code.

    console.py     the machine and the board: MachineView, and the Console that screens ask
    job_options.py how a board is read, placed and drilled: made by verbs and screens, kept by journals
    choices.py     what options of a job may be, by name
    jobs.py        measured holes; recent and interrupted jobs
    records.py     Estimate before a job, Progress while it runs, Outcome when it is over
    tables.py      tables and queues as their editors see them
    bench.py       a table tried on bench motors
    signals.py     signals, outputs by hand, single ticks; the port and a test of it
    plant.py       plant, faults and seed of the simulated machine
    scope.py       runs as the scope sees them
    reports.py     how punctual ticks are here; pictures of numbers
    fault_texts.py cause and remedy of every fault

Rule: a screen is a function of these records. May import kmd (for its codes) only. This file imports nothing, so that
who needs a list of choices does not wait for the words of the faults.
"""
