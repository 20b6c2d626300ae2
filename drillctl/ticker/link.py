"""The desk's end of a ticker: the protocol Link, and LocalLink for a ticker in the desk's own process.

Rule: commands, requests and status go through the doors (kmd); beside them come up only what the plant saw, the trace,
and sentences for the operator. The link to a ticker in another process is in paced_link.py.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from drillctl.kmd import CommandQueue, Request, TickGate
from drillctl.language import Message
from drillctl.plant import Plant
from drillctl.portio.simulated import SwitchedCard
from drillctl.ports import Driver, close_port
from drillctl.ticker.converter.card import carried
from drillctl.ticker.edited_tables import take_tables
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Segments, Trace

Header = list[tuple[str, str]]
MOMENT_TICKS = 250  # some ten milliseconds: requests wait no longer


class Touch(NamedTuple):
    """The plant saw a bit meet its board: tool, tag of the hole, place in steps from machine zero by axis; the axis of
    the bit.
    """

    tool: int
    tag: int
    places: tuple[float, ...]
    axis: int


class Link(Protocol):
    """A ticker as the desk sees it."""

    @property
    def measured(self) -> bool:
        """Whether there is a plant, which measures lost steps and holes."""

    @property
    def plant_lanes(self) -> Sequence[str]:
        """Names of what a recording has of the plant for each axis; empty without a plant."""

    @property
    def plant_header(self) -> Header:
        """The header lines by which a trace names the plant."""

    @property
    def queue(self) -> CommandQueue:
        """The queue into which commands are put."""

    @property
    def gate(self) -> TickGate:
        """The gate at which ticks can be stopped and let through one by one."""

    def post(self, request: Request) -> None:
        """Makes a request; the next tick serves it, whatever waits in the queue."""

    def set_output(self, bit: int, value: int) -> bool:
        """Makes the request OUTPUT. False, and nothing asked, where too many of them wait."""

    def hold_input(self, bit: int, level: int | None) -> bool:
        """Holds an input line of a simulated card at a level (1, 0), or lets it go (None). False, and nothing done,
        where the inputs are a machine's own.
        """

    @property
    def held_inputs(self) -> int:
        """The input bits that are held, as an image."""

    def set_rate(self, tick_hz: int) -> bool:
        """Makes the request PACE. False, and nothing asked, where too many wait. The caller has checked that port and
        computer carry the rate (launch.check_rate); the status record has the one in force.
        """

    def load(self, text: str) -> Message | None:
        """Loads edited tables, a bundle (machine/bundle.py), at rest; returns why they are refused, or None.
        May take some seconds.
        """

    def turn(self) -> None:
        """Lets the machine run for a moment; in a free run nothing runs but within this call."""

    def status(self) -> np.void:
        """The newest status record, dtype kmd.STATUS; it doesn't change afterwards."""

    def touches(self) -> list[Touch]:
        """The holes that the plant saw begun since the last call."""

    def lost(self) -> int:
        """The fault that took the ticker away (kmd.Fault), or 0."""

    def trace(self, header: Iterable[tuple[str, str]]) -> Trace | Segments | None:
        """The trace of the run, under this header; None where none was kept. To be called once, at the end."""

    def notices(self) -> list[Message]:
        """Sentences for the operator about how the run is paced."""

    def close(self) -> None:
        """Makes the outputs safe, ends what was started and gives the port back."""


@dataclass
class LocalLink:
    """A Link to a ticker in this process, which runs free.

    A turn is as many ticks as the queue is sure to last for, and on to the end of the command in execution, so that the
    queue never runs empty. After a request it is a single tick, so that the caller sees its effect before a short job
    is over.
    """

    ticker: Ticker

    @property
    def measured(self) -> bool:
        """Whether the ticker has a plant."""
        return self.ticker.plant is not None

    @property
    def plant_lanes(self) -> Sequence[str]:
        """The lanes of the ticker's plant."""
        return self.ticker.plant.lanes if self.ticker.plant else ()

    @property
    def plant_header(self) -> Header:
        """The header lines of the ticker's plant."""
        return header_of(self.ticker.plant)

    @property
    def queue(self) -> CommandQueue:
        """The queue that the ticker takes from."""
        return self.ticker.queue

    @property
    def gate(self) -> TickGate:
        """The gate that the ticker asks."""
        return self.ticker.gate

    def post(self, request: Request) -> None:
        """Puts a request into the ticker's mailbox."""
        self.ticker.requests.post(request)

    def set_output(self, bit: int, value: int) -> bool:
        """Puts OUTPUT into the ticker's mailbox."""
        return self.ticker.requests.set_output(bit, value)

    def hold_input(self, bit: int, level: int | None) -> bool:
        """Holds an input of the ticker's card."""
        return hold_input(self.ticker.port, bit, level)

    @property
    def held_inputs(self) -> int:
        """What is held on the ticker's card."""
        return held_inputs(self.ticker.port)

    def set_rate(self, tick_hz: int) -> bool:
        """Puts PACE into the ticker's mailbox."""
        return self.ticker.requests.set_rate(tick_hz)

    def load(self, text: str) -> Message | None:
        """Loads edited tables between two ticks."""
        reason = take_tables(self.ticker, text)
        if reason is None:
            self.ticker.requests.post(Request.LOAD)
        return reason

    def turn(self) -> None:
        """Runs ticks: one after a request, else as far as the queue is sure to last, or MOMENT_TICKS."""
        if self.ticker.requests.waiting:
            self.ticker.advance(1)
            return
        self.ticker.turn(self.ticker.over)
        if self.ticker.controller.busy:
            self.ticker.advance(MOMENT_TICKS, lambda: not self.ticker.controller.busy)

    def status(self) -> np.void:
        """A copy of the status record, written now."""
        return self.ticker.report().copy()

    def touches(self) -> list[Touch]:
        """The holes seen since the last call."""
        seen, self.ticker.touched = self.ticker.touched, []
        return [Touch(*touch) for touch in seen]

    def lost(self) -> int:
        """Always 0: a ticker in this process isn't lost without the desk."""
        return 0

    def trace(self, header: Iterable[tuple[str, str]]) -> Trace | Segments | None:
        """The trace that the ticker kept."""
        return self.ticker.record(header)

    def notices(self) -> list[Message]:
        """Always empty: a free run is not paced."""
        return []

    def close(self) -> None:
        """Closes the port, which makes the outputs safe."""
        close_port(self.ticker.port, self.ticker.controller.safe_image)


def hold_input(port: Driver, bit: int, level: int | None) -> bool:
    """Holds an input line where the port is a simulated card that can be held; returns whether it is."""
    card = carried(port)
    if not isinstance(card, SwitchedCard):
        return False
    card.hold(bit, level)
    return True


def held_inputs(port: Driver) -> int:
    """The input bits that are held; 0 on a port where none can be."""
    card = carried(port)
    return card.held if isinstance(card, SwitchedCard) else 0


def header_of(plant: Plant | None) -> Header:
    """The header lines by which a trace names its plant; ``none`` on a real port."""
    return [("plant", plant.described if plant else "none"), ("seed", str(plant.seed if plant else 0))]
