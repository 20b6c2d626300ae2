"""Wiring: the desk's end of a ticker, whether it runs in this process or in one of its own.

Rule: commands, requests and status go through the doors (kmd) and nothing else does; what the plant saw comes beside
them. Created by the verbs' wiring, used by desk.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from drillctl.kmd import CommandQueue, Condition, Request
from drillctl.machine import Machine
from drillctl.plant import IdealPlant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import Driver
from drillctl.trace import Trace
from drillctl.wiring.ticker import Ticker

Header = list[tuple[str, str]]


class Touch(NamedTuple):
    """The plant's bit met the board: tool, tag of the hole, place in steps from machine zero by axis."""

    tool: int
    tag: int
    places: tuple[float, ...]


class Link(Protocol):
    """A ticker as the desk sees it."""

    @property
    def measured(self) -> bool:
        """Whether a plant tells of lost steps."""

    @property
    def queue(self) -> CommandQueue:
        """Where commands go."""

    def post(self, request: Request) -> None:
        """A request, overtaking the queue."""

    def turn(self) -> None:
        """Lets the machine go on for a moment; returns at once when it has nothing to do."""

    def status(self) -> np.void:
        """The newest status record."""

    def touches(self) -> list[Touch]:
        """What the plant saw since the last call."""

    def lost(self) -> int:
        """The fault that took the ticker away (kmd.Fault), or 0."""

    def trace(self, header: Header) -> Trace | None:
        """The record of the run, where one was kept. Called once, at the end."""

    def notices(self) -> list[str]:
        """Sentences about how the run is paced, for the operator."""

    def close(self) -> None:
        """The outputs are safe, and whatever was started has ended."""


@dataclass
class LocalLink:
    """A ticker in this process, running free: a turn is as many ticks as the queue is sure to last for."""

    ticker: Ticker

    @classmethod
    def simulated(cls, machine: Machine, port: "OpenPort | None" = None, traced: bool = False, derived: bool = False
                  ) -> "LocalLink":  # fmt: skip
        """The machine on a simulated card; ``port`` may put another driver in front of that."""
        plant = IdealPlant(machine)
        card: Driver = SimulatedCard(plant)
        return cls(Ticker(machine, port(card) if port else card, plant, traced, derived))

    @property
    def measured(self) -> bool:
        """True where there is a plant."""
        return self.ticker.plant is not None

    @property
    def queue(self) -> CommandQueue:
        """The ticker's own."""
        return self.ticker.queue

    def post(self, request: Request) -> None:
        """Into the ticker's mailbox."""
        self.ticker.requests.post(request)

    def turn(self) -> None:
        """At most one command is taken a tick, so the queue can't run dry within."""
        self.ticker.run(max(1, len(self.ticker.queue)), self.ticker.over)

    def status(self) -> np.void:
        """Written now; a copy, so that it stays what it was."""
        return self.ticker.report().copy()

    def touches(self) -> list[Touch]:
        """Handed over once."""
        seen, self.ticker.touched = self.ticker.touched, []
        return [Touch(*touch) for touch in seen]

    def lost(self) -> int:
        """A ticker in this process can't be lost without us."""
        return 0

    def trace(self, header: Header) -> Trace | None:
        """As the sampler kept it."""
        return self.ticker.finished_trace(header)

    def notices(self) -> list[str]:
        """Nothing is paced."""
        return []

    def close(self) -> None:
        """Gives the port back."""
        self.ticker.port.close()


OpenPort = Callable[[Driver], Driver]


def is_over(status: np.void, last_sequence: int, first_epoch: int) -> bool:
    """Whether a program has ended and everything rests: its last command done, stopped, or latched by a fault."""
    if status["moving"]:
        return False
    if status["condition"] == Condition.LATCHED:
        return True
    ended = status["done"] == last_sequence or status["epoch"] != first_epoch
    return bool(status["condition"] == Condition.READY and not status["job"] and ended)


