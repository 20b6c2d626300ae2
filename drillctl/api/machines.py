"""Machines for another program: found by name or file, and changed in memory."""

from collections.abc import Mapping
from os import PathLike
from pathlib import Path

from drillctl.machine import Library, Machine
from drillctl.machine.edited import Value, edited

DEFAULT = "pcb-drill"


def machine_names(tables: str | PathLike[str] | None = None) -> list[str]:
    """Returns the names of the machines that can be found, sorted.

    >>> import drillctl
    >>> "pcb-drill" in drillctl.machine_names()
    True
    """
    return _library(tables).machine_names()


def load_machine(
    name: str | PathLike[str] = DEFAULT,
    *,
    tables: str | PathLike[str] | None = None,
    tick_hz: int | None = None,
    changes: Mapping[str, Value] | None = None,
) -> Machine:
    """Returns a machine by its name, or by its file (``.toml``); checked, complete, immutable.

    tables   a folder that is searched for tables before the usual ones
    tick_hz  the interrupt frequency in Hz in place of the machine's own
    changes  values by their place, in the machine's file or in a table that it names; no file is changed:
             ``"axis.x.ramp": "drive-servo"``, ``"configuration.longest_drilling_s": 2``,
             ``"phase.two-phase-forced.wire.1a.pattern": "x..xxx......"``, ``"ramp.seven-state.state.1.interval": 5``

    Raises Refused (TableError) for a machine that is not there, a place that is not, or a value that a table can't
    have.

    >>> import drillctl
    >>> slow = drillctl.load_machine("pcb-drill", tick_hz=250, changes={"configuration.longest_drilling_s": 2})
    >>> slow.tick_hz, slow.configuration.longest_drilling_s
    (250, 2.0)
    """
    library = _library(tables)
    found = library.machine(str(name))
    if changes:
        found = edited(library, found, changes)
    return found if tick_hz is None else found.at_rate(checked_rate(tick_hz))


def checked_rate(tick_hz: int) -> int:
    """Returns the interrupt frequency. Raises Refused for one that no machine may have."""
    from drillctl.language import Message, Refusal
    from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ

    if not SLOWEST_TICK_HZ <= tick_hz <= FASTEST_TICK_HZ:
        raise Refusal(
            Message(
                "tick_hz {rate}: {slowest} to {fastest} Hz", rate=tick_hz, slowest=SLOWEST_TICK_HZ,
                fastest=FASTEST_TICK_HZ,
            )
        )  # fmt: skip
    return tick_hz


def machine_of(given: Machine | str | PathLike[str], tick_hz: int | None = None) -> Machine:
    """Returns a machine that is given itself, by name or by file; at another rate where one is given."""
    if not isinstance(given, Machine):
        return load_machine(given, tick_hz=tick_hz)
    return given if tick_hz is None else given.at_rate(checked_rate(tick_hz))


def _library(tables: str | PathLike[str] | None) -> Library:
    return Library.standard(None if tables is None else Path(tables))
