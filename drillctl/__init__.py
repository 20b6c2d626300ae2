"""drillctl: drives and simulates stepper-motor drilling machines. This is the map, in the order data flows.

A person asks for holes; *generation* turns them into ``KMD_*`` commands; *execution* turns commands into one
port image a tick; *port I/O* carries that image to a card or to a simulated machine, and brings the sensors back.

    api/             for other Python programs: what ``import drillctl`` gives; a pytest plugin
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
    replay/          a recorded run once more
    lab/             experiments: how punctual this computer is, sweeps, tuned ramps, pictures of a run
    language/        words on their way to a person        files/   input and output files, within limits

docs/ARCHITECTURE.md follows one command from its text to a port byte; tests/test_rooms.py holds the walls.

The public names stand in api/__init__.py (docs/API.md). This module imports nothing: each is loaded when it is first
used, so ``import drillctl`` costs as much as an empty module.
"""

TYPE_CHECKING = False  # a type checker takes it for true; importing typing would cost more than all the rest here

if TYPE_CHECKING:
    from drillctl.api.errors import Refused
    from drillctl.api.jobs import estimate, inspect, job, replay_trace
    from drillctl.api.machines import load_machine, machine_names
    from drillctl.api.result import Run
    from drillctl.api.runs import run
    from drillctl.api.sweeps import sweep

__version__ = "0.1.0"
__all__ = [
    "Refused", "Run", "estimate", "inspect", "job", "load_machine", "machine_names", "replay_trace", "run", "sweep",
]  # fmt: skip


if not TYPE_CHECKING:  # else a type checker would take any name for one that is there

    def __getattr__(name: str) -> object:
        """Loads a public name. Raises AttributeError for one that is not public."""
        if name.startswith("_"):  # asked for by every importer of a package
            raise AttributeError(f"module 'drillctl' has no attribute {name!r}")
        from drillctl.api import load

        return load(name)


def __dir__() -> list[str]:
    return sorted((*globals(), *__all__))
