"""A recorded run once more: given to a ticker again, compared, or looked into for what the trace leaves out.

    stimuli.py      what a trace says of its run: machine, program, inputs, requests; and gives them to a ticker
    replay.py       the run again, and the first tick that differs
    rerun.py        the run again, for columns, positions and states, which a trace leaves out
    trace_files.py  files of traces in either form
"""
