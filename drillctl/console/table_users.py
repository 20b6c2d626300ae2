"""Which motors have which table: of one machine, and of all machines of a library."""

from drillctl.machine import Library, Machine, TableError
from drillctl.viewmodel.tables import TableKind


def used_tables(kind: TableKind, machine: Machine | None) -> dict[str, tuple[str, ...]]:
    """The names of the tables that a machine is made of, each with the axes that have it; none for no machine."""
    if machine is None:
        return {}
    if kind == "machines":
        return {machine.name: ()}
    names = [getattr(axis, kind).name for axis in machine.axes]
    pairs = [*zip(machine.axis_names, names, strict=True)]
    return {name: tuple(axis for axis, other in pairs if other == name) for name in names}


def users(library: Library, kind: TableKind, name: str) -> list[tuple[str, tuple[str, ...]]]:
    """The machines that can be read and have the table, each with its motors that have it; reads every machine."""
    found = ((each, used_tables(kind, _machine(library, each)).get(name, ())) for each in library.machine_names())
    return [(machine, motors) for machine, motors in found if motors]


def _machine(library: Library, name: str) -> Machine | None:
    try:
        return library.machine(name)
    except TableError:
        return None
