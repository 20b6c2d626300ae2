"""Workpieces of a machine that has stores of them: what a panel shows, and what it asks (implemented in console/).

Rule: as for the Console: asking never raises for what a person did, and a refused request changes nothing. Lengths are
mm from zero, the place where the tool was set.
"""

from collections.abc import Sequence
from typing import Protocol

import msgspec

from drillctl.language import Message
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.records import Estimate


class SentenceView(msgspec.Struct, frozen=True):
    """A sentence of a part program.

    text         its six characters; ``words``: what it does; ``cell``: the address of its first byte in the store
    axis         that moves, ``way_mm`` (signed) far, at most ``m_min`` metres a minute
    x_mm, y_mm   where the carriages are after it
    ticks        that it takes, by the forecast
    """

    text: str
    words: Message
    cell: int
    axis: str
    way_mm: float
    m_min: float
    x_mm: float
    y_mm: float
    ticks: int


class HoleView(msgspec.Struct, frozen=True):
    """A hole that a part program drills: its place along the drum, how deep the tool goes into the wall, and the number
    (from 1) of the sentence after which it is drilled.
    """

    x_mm: float
    depth_mm: float
    sentence: int


class PartView(msgspec.Struct, frozen=True, eq=False):
    """The part program that was called: number, store (EPROM or RAM), sentences, holes, exact time, warnings.

    surface_mm  where the tool meets the wall; None where the machine's file does not say
    """

    number: int
    store: str
    sentences: tuple[SentenceView, ...]
    holes: tuple[HoleView, ...]
    estimate: Estimate
    warnings: tuple[Message, ...]
    surface_mm: float | None


class WorkpieceView(msgspec.Struct, frozen=True):
    """A workpiece in a store: its number, the store, the address of its program."""

    number: int
    store: str
    cell: int


class Workpieces(Protocol):
    """The stores of a machine, and the part program that was called from them."""

    def listed(self) -> tuple[Sequence[WorkpieceView], Problems]:
        """The workpieces of both stores by number, or why a store can't be read."""

    def called(self) -> PartView | None:
        """The part program that was called; None for none."""

    def call(self, number: int) -> Problems:
        """Reads a workpiece, RAM before EPROM, and plans it. What was called before stays where this is refused."""

    def forget(self) -> None:
        """No part program is called any more."""

    def run(self) -> Problems:
        """Takes this place as zero, then runs the part program that was called."""

    def return_to_zero(self) -> Problems:
        """Moves the tool back to zero, then the large carriage, by the count of steps. A program that is held is ended
        first; refused while one runs.
        """

    def sentence(self) -> int:
        """The number, from 1, of the sentence in execution; 0 while none is."""

    def done(self) -> int:
        """How many sentences of the program that was called are done, of the run that goes on or was the last."""

    def cell(self, address: int) -> tuple[int, Problems]:
        """The content of a cell: RAM from 0000 on, EPROM from 8000 on; or why there is none."""

    def set_cell(self, address: int, content: int) -> Problems:
        """Writes a cell of the RAM, which keeps it across power loss. The program that was called is forgotten, since
        the cell may be one of its own.
        """
