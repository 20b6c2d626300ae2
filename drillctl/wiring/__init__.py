"""The wiring: puts the rooms together into processes and runs, and decides nothing about motion.

    ticker    layers 3 and 4: runs ticks         desk      layers 1 and 2: takes a job down the queue
    link      the desk's end of a ticker         paced     ... in a process of its own, with guard beside it
    fast_ticker  ... as fast as may be               tape_recorder  its record in segments
    trace_files  files of traces, in either form
    machinery opens a port, a ticker behind it   session   one run of a job, with its journal
    sampler   which number is which signal       replay    a recorded run again
    estimate  what a job will take               outputs   files reserved before anything moves
    loading   edited tables into a running one   porttest  who answers at a port, before it is driven
    interrupts what signals do                   terminal_keys  the operator's keys while a job runs

Called by the verbs, by the screens' station and by the pytest plugin. Imports nothing by itself.
"""
