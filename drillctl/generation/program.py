"""A work list as a program of KMD records: initialise, then tool by tool, hole by hole: go, down, up.

Rule: built with numpy in one piece; a record's ``tag`` is its hole's number from 1. Called by job.py.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.worklist import Group, WorkList, positioning_axes
from drillctl.kmd import RECORD, Op
from drillctl.kmd.commands import Flag
from drillctl.machine import Machine

PER_HOLE = 3


def board_program(work: WorkList, machine: Machine) -> NDArray[np.void]:
    """The program of a board, dtype RECORD: the base is machine zero; at the end the head is up and back at it."""
    x, y = positioning_axes(machine)
    spindle = dict(machine.outputs).get("spindle")
    parts = [_record(Op.INICJALIZACJA), *_switch(spindle, 1)]
    for group in work.groups:
        parts += [_record(Op.NARZEDZIE, [group.number]), _holes(work, group, x, y)]
    parts += [*_switch(spindle, 0), _goto(np.zeros((1, 2), dtype=np.int64), x, y), _record(Op.KONIEC)]
    program = np.concatenate(parts)
    program["sequence"] = np.arange(1, len(program) + 1)
    return program


def _holes(work: WorkList, group: Group, x: int, y: int) -> NDArray[np.void]:
    """(3 m,) records for the m holes of a tool."""
    steps = work.steps[group.start : group.stop]
    records = np.zeros((len(steps), PER_HOLE), dtype=RECORD)
    records[:, 0] = _goto(steps, x, y)
    records["opcode"][:, 1] = Op.WIERTLO_DOL
    records["opcode"][:, 2] = Op.WIERTLO_GORA
    records["tag"] = np.arange(group.start + 1, group.stop + 1)[:, None]
    return records.reshape(-1)


def _goto(steps: NDArray[np.int64], x: int, y: int) -> NDArray[np.void]:
    records = np.zeros(len(steps), dtype=RECORD)
    records["opcode"] = Op.GOTO_X_Y
    records["flags"] = Flag.ABSOLUTE
    records["axes"] = 1 << x | 1 << y
    records["args"][:, x], records["args"][:, y] = steps[:, 0], steps[:, 1]
    return records


def _record(op: Op, args: list[int] | None = None) -> NDArray[np.void]:
    record = np.zeros(1, dtype=RECORD)
    record["opcode"] = op
    record["args"][0, : len(args or [])] = args or []
    return record


def _switch(bit: int | None, level: int) -> list[NDArray[np.void]]:
    return [] if bit is None else [_record(Op.WYJSCIE, [bit, level])]
