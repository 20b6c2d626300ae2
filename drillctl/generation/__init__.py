"""LAYER 2: from drill files and queues to programs of KMD commands.

    drillfile/    reads every drill file there is, and says which format it took it for
    placing.py    where the board lies: mirror, turn, shift, panel      alignment.py  as measured.py has it
    order/        in which order the holes of a tool are drilled
    worklist.py   tool groups and holes in steps; refuses what the machine can't reach
    sequences.py  what a sequence of KMD commands means: a hole, a tool change
    pcb_drill/    a board's program, hole by hole               spindles.py   which of several spindles drill
    job.py        what is run: a program with its names and holes
    readers.py    the readers of jobs, by what they recognise           queues.py  ``.kmd`` queues
    job_setup.py  options, machine and base of a job, as a journal keeps them    work_settings.py  what is made of them
    drills.py     the drills that a workshop owns                       choices.py what options may be, by name
    feeder.py     puts a program into the queue as room is made
    errors.py     JobError: the operator's input, refused before anything moves

Millimetres end here: below the queue there are steps.
"""
