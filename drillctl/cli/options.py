"""Options that several verbs share, and the values made from them."""

import argparse
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import streams
from drillctl.language import Message, json_text

if TYPE_CHECKING:
    from drillctl.jobs.outcome import JobResult
    from drillctl.machine import Library, Machine
    from drillctl.plant import PlantChoice
    from drillctl.ticker.converter.card import ConverterChoice
    from drillctl.ticker.launch import RunSettings

DEFAULT_MACHINE = "pcb-drill"


def add_machine(verb: argparse.ArgumentParser, default: str = DEFAULT_MACHINE) -> None:
    """Adds ``--machine``, ``--tables`` and ``--tick-hz`` to a verb."""
    verb.add_argument("--machine", default=default, metavar="NAME|FILE", help="machine; default: %(default)s")
    add_tables(verb)
    verb.add_argument("--tick-hz", type=_rate, metavar="N", help="interrupt frequency; default: the machine's own")


def add_action(
    actions: "argparse._SubParsersAction[argparse.ArgumentParser]",
    name: str,
    call: Callable[[argparse.Namespace], int],
    what: str,
) -> argparse.ArgumentParser:
    """Adds an action of a verb (``store list``), which ``call`` carries out; returns its parser."""
    action = actions.add_parser(name, help=what, description=f"{what[:1].upper()}{what[1:]}.")
    action.set_defaults(call=call)
    return action


def add_tables(verb: argparse.ArgumentParser) -> None:
    """Adds ``--tables`` to a verb."""
    verb.add_argument("--tables", type=Path, metavar="DIR", help="search this folder for tables first")


def folder(text: str) -> Path:
    """Reads an option that is a folder to be written to. Raises ArgumentTypeError for none, and for a file."""
    path = Path(text)
    if not text or (path.exists() and not path.is_dir()):
        raise argparse.ArgumentTypeError(f"{text[:200]!r} is no folder")
    return path


def library(arguments: argparse.Namespace) -> "Library":
    """Returns the library of tables to be searched. Raises TableError for a folder that is not there."""
    from drillctl.machine import Library, TableError

    if arguments.tables is not None and not arguments.tables.is_dir():
        raise TableError(arguments.tables, Message("no such folder"))
    return replace(Library.standard(arguments.tables), tell=LocalTables())


class LocalTables:
    """Prints on standard error which local tables are in use, each once, before anything else is printed of the run."""

    def __init__(self) -> None:
        self._named: set[Path] = set()

    def __call__(self, files: tuple[Path, ...]) -> None:
        """Prints one line for the files that were not named before."""
        from drillctl.viewmodel.fault_texts import local_tables

        new = [str(file) for file in dict.fromkeys(files) if file not in self._named]
        self._named.update(files)
        if new:
            streams.tell(f"{local_tables(new)}")


def machine(arguments: argparse.Namespace) -> "Machine":
    """Returns the machine of ``--machine``, at the rate of ``--tick-hz``. Raises TableError."""
    found = library(arguments).machine(arguments.machine)
    return found if arguments.tick_hz is None else found.at_rate(arguments.tick_hz)


def _rate(text: str) -> int:
    from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ

    return whole_number(text, SLOWEST_TICK_HZ, FASTEST_TICK_HZ)


def whole_number(text: str, least: int, most: int) -> int:
    """Reads an option's value. Raises ArgumentTypeError for anything but a whole number within the bounds."""
    if not text.isdecimal() or not least <= int(text[:20]) <= most:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is not a whole number from {least} to {most}")
    return int(text)


def number(text: str, least: float, most: float) -> float:
    """Reads an option's value. Raises ArgumentTypeError for anything but a number within the bounds."""
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not least <= found <= most:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is not a number from {least:g} to {most:g}")
    return found


def up_to(most: int) -> Callable[[str], int]:
    """Returns an option's type: a whole number from 1 to ``most``."""

    def read(text: str) -> int:
        return whole_number(text, 1, most)

    return read


MOST_HELD_S = 7 * 24 * 3600

# Defaults of the options of a run, as --help shows them.
DEFAULTS = {
    "port": "simulated, or with mode REAL in the machine's file the port of its card",
    "pace": "real on a real port, else free",
    "plant": "ideal",
    "seed": "0",
}
AS_IT_RAN = dict.fromkeys(DEFAULTS, "as the job ran")


def add_running(verb: argparse.ArgumentParser, defaults: Mapping[str, str] = DEFAULTS) -> None:
    """Adds ``--port`` and ``--pace``, and for a simulated machine ``--plant``, ``--fault`` and ``--seed``."""
    where = f"port, as drillctl ports lists them; default: {defaults['port']}"
    verb.add_argument("--port", metavar="NAME[:ADDRESS]", help=where)
    pace = f"free: as fast as possible; real: by the clock, in a process of its own; default: {defaults['pace']}"
    verb.add_argument("--pace", choices=("free", "real"), help=pace)
    plant = "plant of a simulated machine: ideal motors, or motors with inertia and friction; default: "
    verb.add_argument("--plant", choices=("ideal", "dynamic"), help=plant + defaults["plant"])
    wrong = "a fault of the machine on the dynamic plant, e.g. blunt=20; repeatable; --fault list prints all"
    verb.add_argument("--fault", action=_FaultAction, default=[], metavar="NAME=N", help=wrong)
    turned = "frequency converter of the spindle (--pace real): its table and serial device, delta-gs20:/dev/ttyUSB0"
    verb.add_argument("--converter", metavar="TABLE:DEVICE", help=turned)
    held = "without keys at a terminal: stop a job that an input (converter_fault) has held for so long; default: 60"
    verb.add_argument("--hold-limit", type=up_to(MOST_HELD_S), default=60, metavar="SECONDS", help=held)
    scatter = f"seed of the random numbers of the dynamic plant; default: {defaults['seed']}"
    verb.add_argument("--seed", type=_seed, metavar="N", help=scatter)


def add_engine(verb: argparse.ArgumentParser) -> None:
    """Adds ``--engine`` to a verb."""
    engine = "tick: compute every tick; fast: whole moves at once, with the same output; default: fast where possible"
    verb.add_argument("--engine", choices=("tick", "fast"), help=engine)


def add_from_tick(verb: argparse.ArgumentParser, what: str) -> None:
    """Adds ``--from-tick`` to a verb; ``what`` says what is done from there on."""
    verb.add_argument("--from-tick", type=_tick, default=0, metavar="N", help=f"{what} from this tick on; default: 0")


def _tick(text: str) -> int:
    return whole_number(text, 0, 10**12)


class _FaultAction(argparse.Action):
    """Adds one fault to the list; ``--fault list`` prints those that exist."""

    def __call__(
        self, parser: argparse.ArgumentParser, namespace: argparse.Namespace, values: object, option: str | None = None
    ) -> None:
        if values == "list":
            from drillctl.plant.faults import fault_lines

            print("\n".join(fault_lines()))
            parser.exit()
        setattr(namespace, self.dest, [*getattr(namespace, self.dest), values])


def _seed(text: str) -> int:
    from drillctl.plant.choice import GREATEST_SEED

    return whole_number(text, 0, GREATEST_SEED)


def port(arguments: argparse.Namespace, machine: "Machine") -> str:
    """Returns the port of ``--port``, else that of the machine's mode. Raises PortRefused for a mode that no port
    serves.
    """
    from drillctl.ticker.launch import port_of_mode

    return arguments.port or port_of_mode(machine)


def running(arguments: argparse.Namespace, port: str, traced: bool = False, derived: bool = False) -> "RunSettings":
    """Returns the settings of a run: port, pace and plant from the options, and what of it is recorded."""
    from drillctl.plant import IDEAL_PLANT
    from drillctl.ticker.launch import RunSettings

    settings = RunSettings(port, arguments.pace, traced, derived, plant(arguments) or IDEAL_PLANT)
    return replace(settings, converter=converter(arguments))


def converter(arguments: argparse.Namespace) -> "ConverterChoice | None":
    """Returns the converter of ``--converter``; None without it. Raises PortRefused, TableError for its table."""
    if arguments.converter is None:
        return None
    from drillctl.ticker.converter.card import choice_of

    return choice_of(arguments.converter, library(arguments))


def plant(arguments: argparse.Namespace) -> "PlantChoice | None":
    """Returns the plant of the options; None where none of them was given."""
    from drillctl.plant import PlantChoice
    from drillctl.plant.choice import IDEAL

    if arguments.plant is None and not arguments.fault and arguments.seed is None:
        return None
    return PlantChoice(arguments.plant or IDEAL, tuple(arguments.fault), arguments.seed or 0)


def add_tools(verb: argparse.ArgumentParser, otherwise: str = "ask on a real port") -> None:
    """Adds ``--tools`` to a verb; ``otherwise`` is the default in words."""
    verb.add_argument(
        "--tools", choices=("ask", "assume"),
        help=f"at a tool change: ask the operator, or assume that it is done; default: {otherwise}",
    )  # fmt: skip


def add_results(verb: argparse.ArgumentParser) -> None:
    """Adds ``--holes`` and ``--json`` to a verb."""
    verb.add_argument(
        "--holes", type=Path, metavar="F", help="write the holes that the simulated machine drilled (CSV)"
    )
    verb.add_argument("--json", action="store_true", help="print the outcome as one JSON object")


def report_outcome(done: "JobResult", as_json: bool, problems: Sequence[str] = ()) -> int:
    """Prints how a run ended, and what of it could not be kept; returns its exit code."""
    from drillctl.jobs.interrupts import exit_code
    from drillctl.ui.terminal.reports import summary_lines

    for notice in done.notices:
        streams.note(f"{notice}")
    lines = [json_text(done.outcome.as_dict(), 2)] if as_json else summary_lines(done.outcome)
    code = 1 if done.outcome.fault or done.trouble or problems else 0
    code = streams.delivered(code if done.signal is None else exit_code(done.signal), "\n".join(lines) + "\n")
    for problem in filter(None, (done.trouble, *problems)):
        streams.tell(f"{problem}")
    return code
