"""drillctl: drives and simulates stepper-motor drilling machines. This is the map, in the order data flows.

A person asks for holes; *generation* turns them into ``KMD_*`` commands; *execution* turns commands into one
port image a tick; *port I/O* carries that image to a card or to a simulated machine, and brings the sensors back.

    cli/             verbs and options
    ui/              LAYER 1  what a person sees: the program on the screen, and what the verbs print
    console/         a machine kept running for the screens
    jobs/            one run of a job: runner, session, journal
    viewmodel/       door     what a screen may see and ask
    generation/      LAYER 2  drill files and queues -> work list -> programs of KMD commands
    kmd/             door     the queue of commands, the requests that overtake it, the status that comes up
    ticker/          the process of layers 3 and 4, its guard, and the link to it
    execution/       LAYER 3  tick.py (one INT8: read this first), axis.py (the automaton), commands
    ports.py         door     the port image, and what a driver must do
    portio/          LAYER 4  one driver a file
    plant/           beyond the ports: motors, sensors, board; sees coil bits only

and what serves them:

    machine/         reads and checks tables/; what follows from a table alone
    trace/           one columnar record of a run: text, segments, VCD, first difference
    replay/          a recorded run once more; pytest_plugin.py: ``*.trace`` files as tests
    lab/             experiments: how punctual this computer is, sweeps, tuned ramps, pictures of a run
    language/        words on their way to a person        files/   input and output files, within limits

docs/ARCHITECTURE.md follows one command from its text to a port byte; tests/test_rooms.py holds the walls.
This package imports nothing.
"""

__version__ = "0.1.0"
