"""LOAD: edited phase and ramp tables for a machine that rests. Between ticks, never in one.

Rule: what was counted goes on being counted; where the machine stands is unknown from here on (docs/SPEC.md, 1.19).
"""

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.machine import Machine

KEPT = (
    "tick", "underruns", "inputs", "sensors", "switched", "image", "epoch", "done", "hole_begun", "holes_done", "tool",
)  # fmt: skip
KEPT_BY_AXIS = ("position", "target", "base", "made", "travelled", "direction", "least", "most")


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
