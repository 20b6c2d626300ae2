"""A recorded run once more: given to a ticker again, and compared with the recording or looked into.

    header.py           what a trace's header says of its run: machine, tables, plant, program
    player.py           gives a ticker the program, inputs and requests of a recorded run
    compare.py          runs a trace again and finds the first tick that differs; records golden traces anew
    derived_signals.py  runs a trace again for what it leaves out: columns, positions and states of the axes

Rule: a run is repeated from what came from outside (program, inputs, requests, gaps in time); all else is worked out.
"""
