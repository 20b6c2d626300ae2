"""LAYER 2: from drill files and queues to programs of KMD commands.

    drillfile/    reads every drill file there is, and says which format it took it for
    placing.py    where the board lies: mirror, turn, shift, panel      alignment.py  as measured.py has it
    order/        in which order the holes of a tool are drilled
    worklist.py   tool groups and holes in steps; refuses what the machine can't reach
    program.py    a work list as a program of KMD records
    job.py        what is run: a program with its names and holes, from a drill file or a ``.kmd`` queue
    recipe.py     the options from which a job can be made again      wishes.py  what may be asked for
    strokes.py    how one hole is drilled                             drills.py  with which of a workshop's drills
    choices.py    what some of these may be, by name                  journal/   what was begun and done, and where
    feeder.py     puts a program into the queue as room is made
    errors.py     JobError: the operator's input, refused before anything moves

May import panel, kmd and machine. Millimetres end here: below the queue there are steps.
"""
