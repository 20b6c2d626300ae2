"""What is done between two ticks, never in one: the status record is written, edited tables are loaded.

Rule: over a load what was counted goes on being counted; where the machine stands is unknown from then on
(docs/SPEC.md, 1.19). The record is packed piece by piece: a paced run writes it after each tick, and to set its fields
one by one costs ten times as much.
"""

import struct
from collections.abc import Mapping
from typing import Any

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.kmd import STATUS, Op
from drillctl.kmd.commands import MOST_AXES
from drillctl.machine import Machine

TWO_CARDS = (1 << 64) - 1
KEPT = (
    "tick", "underruns", "inputs", "sensors", "shared_on", "switched", "image", "epoch", "done", "hole_begun",
    "holes_done", "tool", "speed_reached",
)  # fmt: skip
KEPT_BY_AXIS = ("position", "target", "base", "made", "travelled", "direction", "least", "most", "met")


# Of a numpy type: the letter that struct has for it.
CODES = {"<i8": "q", "<u8": "Q", "<i4": "i", "<u4": "I", "<i2": "h", "<u2": "H", "|i1": "b", "|u1": "B"}
# The fields of the status record in pieces that lie side by side; those between them are the ticker's.
CLOCK = ("tick", "tick_hz")
JOB = ("underruns", "epoch", "sequence", "done", "hole_begun", "holes_done", "tool", "opcode", "condition", "fault",
       "fault_kept", "fault_axes", "position_known", "step", "cut_off", "hot_ticks", "job", "moving", "queued",
       "position", "target", "base", "steps")  # fmt: skip
WIRES = ("state", "column", "sensors", "image")


def _piece(names: tuple[str, ...]) -> tuple[struct.Struct, int]:
    """What packs fields that lie side by side in the record, and where they begin."""
    fields: Mapping[str, Any] = STATUS.fields or {}
    code = "<"
    for name in names:
        kind = fields[name][0]
        code += "".join(map(str, kind.shape)) + CODES[kind.base.str]
    piece, first = struct.Struct(code), fields[names[0]][1]
    assert first + piece.size == fields[names[-1]][1] + fields[names[-1]][0].itemsize, "the fields lie elsewhere"
    return piece, first


_CLOCK, _JOB, _WIRES = map(_piece, (CLOCK, JOB, WIRES))


def report(m: Controller, record: memoryview) -> None:
    """Overwrites the bytes of a record of dtype kmd.STATUS with what the controller knows."""
    command, axes, unused = m.command, m.axes, (0,) * (MOST_AXES - len(m.axes))
    piece, first = _CLOCK
    piece.pack_into(record, first, m.tick, m.tick_hz)
    piece, first = _JOB
    piece.pack_into(
        record, first, m.underruns, m.epoch, command.sequence if m.busy else 0, m.done, m.hole_begun, m.holes_done,
        m.tool, command.opcode if m.busy else Op.IDLE, m.condition, m.fault, m.fault_kept, m.fault_axes,
        m.position_known, m.step, m.cut_off, max(0, m.hot_until - m.tick), m.job, m.moving, len(m.queue),
        *[axis.position for axis in axes], *unused, *[axis.target for axis in axes], *unused,
        *[axis.base for axis in axes], *unused, *[axis.made for axis in axes], *unused,
    )  # fmt: skip
    piece, first = _WIRES
    piece.pack_into(
        record, first, *[axis.state for axis in axes], *unused, *[axis.column + 1 for axis in axes], *unused,
        m.sensors & TWO_CARDS, m.image & TWO_CARDS,
    )  # fmt: skip


def loaded(machine: Machine, old: Controller) -> Controller:
    """A controller for the same axes with other tables, resting where the old one rests."""
    m = Controller(machine, old.queue, old.requests, old.port)
    for name in KEPT:
        setattr(m, name, getattr(old, name))
    for axis, before in zip(m.axes, old.axes, strict=True):
        _stand(axis, before)
    return m


def _stand(axis: Axis, before: Axis) -> None:
    """In the column of the same number; a current that was held is held by the new table's pattern."""
    for name in KEPT_BY_AXIS:
        setattr(axis, name, getattr(before, name))
    axis.column = before.column % axis.length
    if before.bits:
        axis.bits = axis.hold_bits = axis.hold_patterns[axis.direction * axis.direction_sign][axis.column]
