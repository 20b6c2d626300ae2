"""LAYER 2: from drill files and queues to programs of KMD commands.

    drillfile/    reads every drill file there is, and says which format it took it for
    placing.py    where the board lies: mirror, turn, shift, panel      alignment.py  measured holes
    order/        in which order the holes of a tool are drilled
    worklist.py   tool groups and holes in steps; refuses what the machine can't reach
    program.py    a work list as a program of KMD records
    job.py        what is run: a program with its names and holes, from a drill file or a ``.kmd`` queue
    feeder.py     puts a program into the queue as room is made
    errors.py     JobError: the operator's input, refused before anything moves

May import panel, kmd and machine. Millimetres end here: below the queue there are steps.
"""
