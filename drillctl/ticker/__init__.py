"""The process of layers 3 and 4: ticks one machine on one port, paced by the clock or as fast as it may.

    desk (layers 1, 2)                 ticker (layers 3, 4)              guard
    link.py, paced_link.py  ── kmd ──  paced_ticker.py ── ports ── port  guard_process.py

A free run has the ticker in the desk's own process; a paced one forks both processes from paced_link.

    ticker.py            runs ticks, watches the plant      fast_ticker.py    whole commands at once, as tapes
    link.py              the desk's end, in one process     paced_link.py     ... of a process of its own
    paced_ticker.py      what runs in that process          guard_process.py  makes outputs safe when it can't
    processes.py         processes ended by their ids       realtime.py       punctual ticks, as far as may be
    launch.py            opens a port, a ticker behind it   forecast.py       the ticks that a program will take
    sampler.py           which number is which signal       table_loading.py  edited tables into a running ticker
    confirmed_status.py  a status waits for the board's answer
"""
