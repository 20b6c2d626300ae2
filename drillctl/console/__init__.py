"""The machine kept running for the screens: implements the protocols of viewmodel/.

    machine_console.py  the Console: everything that a person can ask of the machine, made of the parts below
    machine_in_use.py   the machine with its link and port; changes to another machine or port
    running_job.py      the job that runs on it, held and resumed
    boards.py           the board that is loaded: planned, drilled with a journal, what is left of one cut off
    job_request.py      options from a screen, for the machine in use; the fit of measured holes
    operator_state.py   the tool change that is waited for, and the working base
    jogging.py          jog keys: pressed, or held down
    views.py            status record, machine and board as the records that screens draw
    recent_jobs.py      the boards opened last, in a file

    tables.py, queues.py    for the editors                   signals.py      signals, outputs, single ticks
    effects.py          what a change of a machine's file will do
    plant.py                plant, faults and seed of the simulated machine
    port.py                 the port in use, tested           scope.py, scope_layout.py, scope_runs.py   for the scope

Rule: nothing here draws or knows a key; a problem is returned as a sentence, never raised.
"""
