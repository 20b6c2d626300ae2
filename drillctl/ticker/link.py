"""The desk's end of a ticker, whether it runs in this process or in one of its own.

Rule: commands, requests and status go through the doors (kmd) and nothing else does; what the plant saw comes beside
them. Created by the verbs' wiring, used by desk.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from drillctl.kmd import CommandQueue, Condition, Request, TickGate
from drillctl.machine import Machine
from drillctl.plant import IdealPlant, Plant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import Driver
from drillctl.ticker.table_loading import take_tables
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Segments, Trace

Header = list[tuple[str, str]]
MOMENT_TICKS = 250  # some ten milliseconds: requests wait no longer


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
    def plant_lanes(self) -> Sequence[str]:
        """What a recording has of it, by axis; none where there is no plant."""

    @property
    def plant_header(self) -> Header:
        """What a trace says of the plant."""

    @property
    def queue(self) -> CommandQueue:
        """Where commands go."""

    @property
    def gate(self) -> TickGate:
        """Where ticks can be stopped and let through one by one."""

    def post(self, request: Request) -> None:
        """A request, overtaking the queue."""

    def set_output(self, bit: int, value: int) -> bool:
        """The request OUTPUT. False, and nothing asked, where too many of them wait."""

    def set_rate(self, tick_hz: int) -> bool:
        """The request PACE. False, and nothing asked, where too many wait. Whether the port and this computer carry the
        rate is looked at before (machinery.check_rate); the status record has the one in force.
        """

    def load(self, text: str) -> str:
        """Edited tables as a bundle (machine/bundle.py), at rest; the reason where they are refused. Takes a moment."""

    def turn(self) -> None:
        """Lets the machine go on for a moment; returns at once when it has nothing to do."""

    def status(self) -> np.void:
        """The newest status record."""

    def touches(self) -> list[Touch]:
        """What the plant saw since the last call."""

    def lost(self) -> int:
        """The fault that took the ticker away (kmd.Fault), or 0."""

    def trace(self, header: Iterable[tuple[str, str]]) -> Trace | Segments | None:
        """The record of the run, where one was kept. Called once, at the end."""

    def notices(self) -> list[str]:
        """Sentences about how the run is paced, for the operator."""

    def close(self) -> None:
        """The outputs are safe, and whatever was started has ended."""


@dataclass
class LocalLink:
    """A ticker in this process, running free: a turn is as many ticks as the queue is sure to last for, and on to the
    end of the command in execution, in which the queue can't run dry. A request has a turn of a single tick: who asked
    sees what came of it before a short job is over.
    """

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
    def plant_lanes(self) -> Sequence[str]:
        """The plant's."""
        return self.ticker.plant.lanes if self.ticker.plant else ()

    @property
    def plant_header(self) -> Header:
        """Of the ticker's plant."""
        return header_of(self.ticker.plant)

    @property
    def queue(self) -> CommandQueue:
        """The ticker's own."""
        return self.ticker.queue

    @property
    def gate(self) -> TickGate:
        """The ticker's own."""
        return self.ticker.gate

    def post(self, request: Request) -> None:
        """Into the ticker's mailbox."""
        self.ticker.requests.post(request)

    def set_output(self, bit: int, value: int) -> bool:
        """Into the ticker's mailbox."""
        return self.ticker.requests.set_output(bit, value)

    def set_rate(self, tick_hz: int) -> bool:
        """Into the ticker's mailbox."""
        return self.ticker.requests.set_rate(tick_hz)

    def load(self, text: str) -> str:
        """Between two ticks."""
        reason = take_tables(self.ticker, text)
        if not reason:
            self.ticker.requests.post(Request.LOAD)
        return reason

    def turn(self) -> None:
        """As far as the queue is sure to last, or for a moment."""
        if self.ticker.requests.waiting:
            self.ticker.advance(1)
            return
        self.ticker.turn(self.ticker.over)
        if self.ticker.controller.busy:
            self.ticker.advance(MOMENT_TICKS, lambda: not self.ticker.controller.busy)

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

    def trace(self, header: Iterable[tuple[str, str]]) -> Trace | Segments | None:
        """As the sampler kept it."""
        return self.ticker.record(header)

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


def header_of(plant: Plant | None) -> Header:
    """What a trace says of the plant behind its port; none behind a real one."""
    return [("plant", plant.described if plant else "none"), ("seed", str(plant.seed if plant else 0))]
