"""Tables broken on purpose: what goes wrong with a motor when its table does. For trials and exercises.

Rule: each phase table is made from a sound one of two phases, twelve columns and two forcing wires (paper, Table 1).
Column numbers are the paper's, from 1.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

from drillctl.machine import PhaseTable, RampTable
from drillctl.machine.phase import Wire

Breaking = Callable[[PhaseTable], PhaseTable]


def direct_start(ramp: RampTable) -> RampTable:
    """No ramp: every state as fast as the fastest."""
    return replace(ramp, interval=(min(ramp.interval),) * len(ramp.interval))


def reordered(table: PhaseTable, order: Sequence[int]) -> PhaseTable:
    """The columns in another order."""
    return _with(table, lambda wire: [wire.forward[column - 1] for column in order])


def without(table: PhaseTable, *names: str) -> PhaseTable:
    """Wires that are never on."""
    return _with(table, lambda wire: [on and wire.name not in names for on in wire.forward])


def wave(table: PhaseTable) -> PhaseTable:
    """One half winding at a time, three columns each, without forcing."""
    first = {"1a": 1, "2b": 4, "1b": 7, "2a": 10}
    return _with(table, lambda wire: [wire.name in first and 0 <= c - first[wire.name] < 3 for c in range(1, 13)])


def _with(table: PhaseTable, row: Callable[[Wire], Sequence[bool]]) -> PhaseTable:
    """The same wires with other rows, played backwards for the other direction."""
    wires = tuple(replace(wire, forward=tuple(row(wire)), backward=tuple(row(wire))) for wire in table.wires)
    return replace(table, wires=wires)


BROKEN: dict[str, Breaking] = {
    "forcing removed": lambda table: without(table, "24a", "24b"),
    "forcing of one phase": lambda table: without(table, "24b"),
    "columns 1 and 2 exchanged": lambda table: reordered(table, (2, 1, *range(3, 13))),
    "columns 3 and 4 exchanged": lambda table: reordered(table, (1, 2, 4, 3, *range(5, 13))),
    "columns 4 and 7 exchanged": lambda table: reordered(table, (1, 2, 3, 7, 5, 6, 4, *range(8, 13))),
    "columns 4-6 and 7-9 exchanged": lambda table: reordered(table, (1, 2, 3, 7, 8, 9, 4, 5, 6, 10, 11, 12)),
    "reversed": lambda table: reordered(table, range(12, 0, -1)),
    "one phase alone": lambda table: without(table, "2a", "2b", "24b"),
    "2b never on": lambda table: without(table, "2b"),
    "one winding at a time": wave,
}
