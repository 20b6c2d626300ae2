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
    verb.add_argument("--tick-hz", type=int, metavar="N", help="interrupt frequency; default: the machine's own")


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
    from drillctl.machine import TableError
    from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ

    found = library(arguments).machine(arguments.machine)
    rate = arguments.tick_hz
    if rate is None:
        return found
    if not SLOWEST_TICK_HZ <= rate <= FASTEST_TICK_HZ:
        raise TableError("--tick-hz", f"{rate} is outside {SLOWEST_TICK_HZ}..{FASTEST_TICK_HZ}")
    return found.at_rate(rate)
