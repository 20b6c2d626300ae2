"""Options that several verbs share, and what they stand for."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drillctl.machine import Library, Machine

DEFAULT_MACHINE = "pcb-drill"


def add_machine(verb: argparse.ArgumentParser) -> None:
    """``--machine``, ``--tables`` and ``--tick-hz``."""
    verb.add_argument("--machine", default=DEFAULT_MACHINE, metavar="NAME|FILE", help="default: %(default)s")
    add_tables(verb)
    verb.add_argument("--tick-hz", type=_rate, metavar="N", help="interrupt frequency; default: the machine's own")


def add_tables(verb: argparse.ArgumentParser) -> None:
    """``--tables``."""
    verb.add_argument("--tables", type=Path, metavar="DIR", help="look for tables here first")


def library(arguments: argparse.Namespace) -> "Library":
    """The tables to be searched. Raises TableError for a folder that is not there."""
    from drillctl.machine import Library, TableError

    if arguments.tables is not None and not arguments.tables.is_dir():
        raise TableError(arguments.tables, "no such folder")
    return Library.standard(arguments.tables)


def machine(arguments: argparse.Namespace) -> "Machine":
    """The machine asked for, at the rate asked for. Raises TableError."""
    found = library(arguments).machine(arguments.machine)
    return found if arguments.tick_hz is None else found.at_rate(arguments.tick_hz)


def _rate(text: str) -> int:
    from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ

    if not text.isdecimal() or not SLOWEST_TICK_HZ <= int(text) <= FASTEST_TICK_HZ:
        reason = f"{text[:20]!r} is not a whole number from {SLOWEST_TICK_HZ} to {FASTEST_TICK_HZ}"
        raise argparse.ArgumentTypeError(reason)
    return int(text)
