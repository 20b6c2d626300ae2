"""A production machine's parameters and records: what its screen shows and asks (implemented in console/).

Rule: as for the Console: asking never raises for what a person did, and a refused request changes nothing. Lengths are
mm. Parameters go by names such as ``axis.x.s_share``; values are texts as they are typed.
"""

from collections.abc import Mapping, Sequence
from typing import Protocol

import msgspec

from drillctl.language import Message
from drillctl.viewmodel.console import Problems


class ParameterView(msgspec.Struct, frozen=True):
    """A parameter: its name, its value (``unset`` where it has none), what it may be, what it means and does, and the
    values that it can have, if they are few.
    """

    name: str
    value: str
    allowed: str
    meaning: str
    effect: str
    choices: tuple[str, ...] = ()


class ToolRecord(msgspec.Struct, frozen=True):
    """A tool of the machine; None for what is not entered. ``place``: of the magazine, 0 for none."""

    number: int
    diameter_mm: float | None
    offset_mm: float | None
    hits_left: int | None
    place: int | None


class PlaceRecord(msgspec.Struct, frozen=True):
    """A place of the magazine: whose it is (None: no tool's), and by spindle whether a bit stands there, None where
    that is unknown. ``bits`` is empty where nothing is recorded.
    """

    number: int
    tool: int | None
    bits: tuple[bool | None, ...] = ()


class Records(msgspec.Struct, frozen=True):
    """What is known of the machine beside its state.

    stroke_mm     how far the spindles lift between two holes; None: not entered
    bottom_mm     the bottom dead centre: the lowest place that a spindle is sent to
    absolute_mm   X and Y of the origin of absolute coordinates, from machine zero
    relative_mm   X and Y of the origin of relative ones, from machine zero; None: the working base
    cycle_s       how often positions and signals are looked at
    chucks        by spindle the tool in its chuck: 0 none, None unknown; empty where nothing is recorded
    missing       names of the parameters that must be entered before a board is drilled
    trouble       why the magazine record can't be read
    """

    stroke_mm: float | None
    bottom_mm: float | None
    absolute_mm: tuple[float, float]
    relative_mm: tuple[float, float] | None
    cycle_s: float
    tools: tuple[ToolRecord, ...]
    places: tuple[PlaceRecord, ...]
    chucks: tuple[int | None, ...]
    missing: tuple[str, ...]
    trouble: Message | None = None


class Production(Protocol):
    """The parameters of the machine in use, the records of its tools, and its parking place."""

    @property
    def position_known(self) -> bool:
        """Whether a change of the parameters costs the position: the machine is started anew with them."""

    def records(self) -> Records:
        """What is known now."""

    def groups(self) -> Sequence[tuple[str, str]]:
        """The groups of parameters: name, heading."""

    def parameters(self, group: str) -> Sequence[ParameterView]:
        """All parameters of a group, set or not."""

    def problem(self, name: str, typed: str) -> Problems:
        """Why this can't be a parameter's value; empty where it can."""

    def enter(self, typed: Mapping[str, str]) -> Problems:
        """Sets parameters by name, saves the machine's file, and takes the machine as it then is. Refused while
        something moves, and where one of them can't be.
        """

    def add(self, group: str, number: int) -> Problems:
        """Adds a tool, or a place of the magazine, with its number alone; saved as by ``enter``."""

    def remove(self, group: str, number: int) -> Problems:
        """Removes a tool or a place of the magazine; saved as by ``enter``."""

    def park(self) -> Problems:
        """Moves the table to the parking place, the heads raised."""
