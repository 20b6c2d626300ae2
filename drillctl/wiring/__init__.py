"""The wiring: puts the rooms together into processes and runs, and decides nothing about motion.

    ticker       layers 3 and 4: runs ticks            desk           layers 1 and 2: takes a job down the queue
    link         the desk's end of a ticker            paced          ... in a process of its own, with guard beside it
    paced_ticker what runs there, by the clock         children       processes of ours, ended by their ids
    realtime     punctual ticks, as far as may be      guard          makes outputs safe when the ticker can't
    fast_ticker  ... as fast as may be                 tape_recorder  its record in segments
    machinery    opens a port, a ticker behind it      session        one run of a job, with its journal
    sampler      which number is which signal          trace_files    files of traces, in either form
    recorded     what a trace says of its run          replay         a recorded run again, and compared
    rerun        ... for what the trace leaves out     estimate       what a job will take
    outputs      files reserved before anything moves  timeleft       how long it will still take
    loading      edited tables into a running one      porttest       who answers at a port, before it is driven
    interrupts   what signals do                       terminal_keys  the operator's keys while a job runs
    vouched      what a board must answer for first            site           where a job runs, for its journal

Called by the verbs, by the screens' station and by the pytest plugin. Imports nothing by itself.
"""
