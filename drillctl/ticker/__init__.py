"""The ticker, the process of layers 3 and 4: ticks one machine on one port. And its link to the desk, layers 1 and 2.

    desk process                       ticker process                        guard process
    job, screen, journal               every tick, every port access         nothing but this watch
    +---------------+  queue, requests +-------------------+   heartbeat     +------------------+
    | link.py       | ---------------> | ticker_process.py | --------------> | guard_process.py |
    | paced_link.py | <--------------- | ticker.py         |                 +------------------+
    +---------------+  status, holes,  +-------------------+                          |
                       trace, notices          | image, inputs                        | safe image only, after it
                                               v                                      v has killed the ticker
                                             port (portio) <--------------------------+

What runs where: a paced run (real machines, and the screen) has all three. paced_link.py opens the port, then forks the
guard and the ticker; commands and status go through a mapped file (kmd/channel.py). The ticker watches the desk's
heartbeat and holds or stops the machine when it falls silent; the desk watches the guard's. A free run (simulated, as
fast as may be) has no process but the desk's: LocalLink runs the ticks within ``turn``.

    link.py              the desk's end: the protocol, and the link within one process
    paced_link.py        the desk's end of a ticker in a process of its own; starts and ends both processes
    ticker_process.py    what runs in the ticker's process      guard_process.py    what runs in the guard's
    child_process.py     a forked process, ended by its id      realtime.py         punctual ticks, where allowed
    ticker.py            ticks, samples, counts holes           fast_ticker.py      the same, whole commands at once
    sampler.py           which number is which signal           confirmed_status.py a status waits for the board
    edited_tables.py     tables into a running ticker           forecast.py         ticks that a program will take
    program_run.py       a whole program run free, for experiments
    launch.py            checks the settings of a run, opens its port and starts its ticker
"""
