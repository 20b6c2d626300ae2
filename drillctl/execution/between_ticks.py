"""What is done between two ticks, never in one: the status record is written, edited tables are loaded.

Rule: over a load what was counted goes on being counted; where the machine stands is unknown from then on
(docs/SPEC.md, 1.19).
"""

import numpy as np

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.kmd import Op
from drillctl.machine import Machine

TWO_CARDS = (1 << 64) - 1
KEPT = (
    "tick", "underruns", "inputs", "sensors", "switched", "image", "epoch", "done", "hole_begun", "holes_done", "tool",
)  # fmt: skip
KEPT_BY_AXIS = ("position", "target", "base", "made", "travelled", "direction", "least", "most")


def report(m: Controller, status: np.void) -> None:
    """Overwrites a record of dtype kmd.STATUS with what the controller knows."""
    command = m.command
    for name in ("tick", "tick_hz", "underruns", "epoch", "done", "hole_begun", "holes_done", "tool", "condition",
                 "fault", "fault_kept", "position_known", "cut_off", "job", "moving"):  # fmt: skip
        status[name] = getattr(m, name)
    status["sensors"], status["image"] = m.sensors & TWO_CARDS, m.image & TWO_CARDS
    status["sequence"] = command.sequence if m.busy else 0
    status["opcode"] = command.opcode if m.busy else Op.IDLE
    status["hot_ticks"] = max(0, m.hot_until - m.tick)
    status["queued"] = len(m.queue)
    for index, axis in enumerate(m.axes):
        status["position"][index] = axis.position
        status["target"][index] = axis.target
        status["base"][index] = axis.base
        status["steps"][index] = axis.made
        status["state"][index] = axis.state
        status["column"][index] = axis.column + 1


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
