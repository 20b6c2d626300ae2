"""The machine kept running for the screens: implements what viewmodel/console.py and its neighbours ask for.

    machine_console.py  one machine, one board after another     operating.py  jobs, jogs, queues, requests on it
    machine_in_use.py   its link and port, or another machine    boards.py     the board: planned, drilled, resumed
    operator_state.py   hold, tool change and working base, as the operator has asked
    jogging.py          a key pressed, a key held down
    views.py            status, machine and job as records       signals.py    signals, outputs, single ticks
    port.py             the port in use, tested                  tables.py, queues.py  as the editors change them
    scope.py, scope_layout.py, scope_runs.py   runs for the scope                    recent_jobs.py
"""
