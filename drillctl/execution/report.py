"""Writes the status record. Between ticks, never in one."""

import numpy as np

from drillctl.execution.controller import Controller
from drillctl.kmd import Op

TWO_CARDS = (1 << 64) - 1


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
