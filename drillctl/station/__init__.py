"""The wiring of the screens: what panel/console.py asks for, made of the rooms below. Created by the screen verb.

    station    one machine kept running, one job after another     views      status, machine and job as drawn
    operating  the same without boards                             hand       the operator's hold and its end
    inuse      which machine, on which port                        portbench  its port, looked at and tested
    handbench  signals, outputs and single ticks
    jogging    a key pressed, a key held down              toolgate   the tool change, asked on the screen
    boards     the board on the desk, its journal, recent and unfinished jobs    workingbase  where mm count from
    workbench  tables as the editors change them                   queuebench queues as the editor changes them
    scope      a run as the scope sees it                          scope_layout which lanes a machine has
    tracefile  the run of a file                                   scopebench which runs there are to look at
"""
