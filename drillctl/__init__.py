"""drillctl: drives and simulates stepper-motor drilling machines. This is the map, in the order data flows.

A person asks for holes; *generation* turns them into ``KMD_*`` commands; *execution* turns commands into one
port image a tick; *port I/O* carries that image to a card or to a simulated machine, and brings the sensors back.

    cli/             verbs and options
    ui/              LAYER 1  what a person sees: views, each a function of a record
    panel/           door     what a screen may see and ask
    generation/      LAYER 2  drill files and queues -> work list -> programs of KMD commands; the job's journal
    kmd/             door     the queue of commands, the requests that overtake it, the status that comes up
    execution/       LAYER 3  tick.py (one INT8: read this first), axis.py (the automaton), commands, guard
    ports.py         door     the port image, and what a driver must do
    portio/          LAYER 4  one driver a file
    plant/           beyond the ports: motors, sensors, board; sees coil bits only
    machine/         reads and checks tables/; what follows from a table alone
    trace/           one columnar record of a run: text, VCD, first difference
    lab/             forecasts, and how punctual this computer is

and what composes them and decides nothing about motion:

    wiring/          ticker (layers 3 and 4), desk (layers 1 and 2), the processes and the guard, sessions, replay
    station/         a machine kept running for the screens
    pytest_plugin.py ``*.trace`` files as tests

docs/ARCHITECTURE.md follows one command from its text to a port byte; tests/test_rooms.py holds the walls.
This package imports nothing.
"""

__version__ = "0.1.0"
