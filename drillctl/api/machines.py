"""Machines for another program: found by name or file, and changed in memory."""

from collections.abc import Mapping
from os import PathLike, fsdecode
from typing import Any

from drillctl.api.arguments import Whole, named, path_of, plain, unexpected, whole
from drillctl.language import Message
from drillctl.machine import Library, Machine, TableError
from drillctl.machine.edited import edited
from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ

DEFAULT = "pcb-drill"


def machine_names(tables: str | PathLike[str] | None = None) -> list[str]:
    """Returns the names of the machines that can be found, sorted.

    >>> import drillctl
    >>> "pcb-drill" in drillctl.machine_names()
    True
    """
    return library_of(tables).machine_names()


def load_machine(
    name: str | PathLike[str] = DEFAULT,
    *,
    tables: str | PathLike[str] | None = None,
    tick_hz: Whole | None = None,
    changes: Mapping[str, Any] | None = None,
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
    library = library_of(tables)
    if not isinstance(name, str | PathLike):
        raise unexpected("machine", "a name or a file", name)
    found = library.machine(fsdecode(name))
    if changes is not None:
        values = {place: plain(value) for place, value in named(changes, "changes").items()}
        found = edited(library, found, values) if values else found
    return _at_rate(found, tick_hz)


def machine_of(given: Machine | str | PathLike[str], tick_hz: Whole | None = None) -> Machine:
    """Returns a machine that is given itself, by name or by file; at another rate where one is given."""
    return _at_rate(given if isinstance(given, Machine) else load_machine(given), tick_hz)


def library_of(tables: str | PathLike[str] | None) -> Library:
    """Returns the tables that are searched, this folder's first. Raises TableError for a folder that is not there."""
    folder = None if tables is None else path_of(tables, "tables")
    if folder is not None and not folder.is_dir():
        raise TableError(folder, Message("no such folder"))
    return Library.standard(folder)


def _at_rate(machine: Machine, tick_hz: Whole | None) -> Machine:
    """The machine at this interrupt frequency. Raises Refused for one that no machine may have."""
    if tick_hz is None:
        return machine
    return machine.at_rate(whole(tick_hz, "tick_hz", SLOWEST_TICK_HZ, FASTEST_TICK_HZ))
