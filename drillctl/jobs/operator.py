"""The operator of a job, as its runner knows one: requests, the hold, the change of a tool.

Rule: whether a job is to be held is known in one place, its JobHold. Keys and screens only say that the operator
pressed something; the runner asks the machine until it is as the operator wants it.
"""

import time
from collections.abc import Callable, Iterable
from typing import Protocol

import numpy as np

from drillctl.kmd import Condition, Request
from drillctl.language import Message
from drillctl.machine import Machine

ToolChange = Callable[[int, float | None], bool]  # tool and diameter; asked again and again until it is True


class Operator(Protocol):
    """A person at the machine, asked by the runner at every turn."""

    def requests(self, held: bool) -> Iterable[Request]:
        """What was asked since the last call: HOLD, RESUME, STOP and ESTOP. ``held``: the job is held now, or is to
        be, for a key that both holds and resumes.
        """


class JobHold:
    """Whether one job is to be held.

    wanted         what the operator asked last: to hold it or not; None where nothing was asked, or it is so
    resumes_itself a hold by a gap in time is ended at once: no person is there who could resume the job
    """

    def __init__(self, resumes_itself: bool):
        self.wanted: bool | None = None
        self._resumes_itself = resumes_itself

    @property
    def held(self) -> bool:
        """Whether the operator wants the job held."""
        return bool(self.wanted)

    def due(self, status: np.void) -> Request | None:
        """The request that brings a machine with this status record to what is wanted; None where it is so. To be asked
        at every turn: a request may come together with the hold for a gap in time, or with the end of a command.
        """
        holding = status["condition"] == Condition.HOLDING
        if self.wanted is False and not holding:
            self.wanted = None
        if self.held:
            return Request.HOLD if status["condition"] == Condition.READY and status["job"] else None
        return Request.RESUME if self._resumes_itself and holding and not status["moving"] else None

    def forecast(self, condition: str) -> str:
        """The condition that a machine in ``condition`` has, or is about to have by what is wanted. A screen shows it,
        so that two keys pressed at once mean a hold and its end.
        """
        if self.wanted and condition == "ready":
            return "holding"
        return "ready" if self.wanted is False and condition in ("holding", "held") else condition


class HoldLimit:
    """How long the inputs of a machine that hold a job (``action = "pause"``) may do so where nobody is there who could
    put it right. ``clock`` returns seconds.
    """

    def __init__(self, machine: Machine, most_s: float, clock: Callable[[], float] = time.monotonic):
        self._inputs = {line.name: 1 << line.bit for line in machine.inputs if line.action == "pause"}
        self._most_s, self._clock = most_s, clock
        self._since_s: float | None = None

    def exceeded(self, status: np.void) -> Message | None:
        """Why the job is to be stopped, None while it is not. To be asked at every turn."""
        on = [name for name, bit in self._inputs.items() if int(status["sensors"]) & bit]
        if not on or not status["job"]:
            self._since_s = None
            return None
        now_s = self._clock()
        self._since_s = now_s if self._since_s is None else self._since_s
        if now_s - self._since_s < self._most_s:
            return None
        fields = {"inputs": ", ".join(on), "seconds": self._most_s}
        return Message("{inputs} held the job for {seconds:g} s; it was stopped, and can be resumed", **fields)
