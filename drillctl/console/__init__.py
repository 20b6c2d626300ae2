"""The machine kept running for the screens: implements the protocols of viewmodel/.

    machine_console.py  the Console: everything that a person can ask of the machine, made of the parts below
    machine_in_use.py   the machine with its link and port; changes to another machine or port
    running_job.py      the job that runs on it, held and resumed
    readiness.py        whether it takes something new, and what is in the way
    boards.py           the board that is loaded: planned, drilled with a journal, what is left of one cut off
    job_request.py      options from a screen, for the machine in use; the fit of measured holes
    operator_state.py   the tool change that is waited for, and the working base
    jogging.py          jog keys: pressed, or held down
    views.py            status record, machine and board as the records that screens draw
    recent_jobs.py      the boards opened last, in a file
    workpieces.py       the stores of the machine in use, and the part program that was called from them

    tables.py, table_rows.py, table_users.py, effects.py   for the editors: tables, their rows, who uses them, what a
                        change will do
    queues.py           for the queue editor
    signals.py          signals, outputs, single ticks
    plant.py            plant, faults and seed of the simulated machine
    port.py             the port in use, tested
    scope.py, scope_layout.py, scope_runs.py   for the scope

Rule: nothing here draws or knows a key; a problem is returned as a sentence, never raised.
"""
