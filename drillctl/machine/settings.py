"""The values of a machine's file that screens change: the configuration (the paper's Fig. 4) and the bit of each wire
(Table 1), with what each may be.

Rule: types and bounds come from shape.py, by which files are checked too; no bound is written twice. What ``locked``
names, by its key or as AXIS.KEY, is shown and not changed.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import msgspec
from msgspec.inspect import FloatType, IntType, LiteralType, StructType, TupleType, Type, type_info

from drillctl.language import Message
from drillctl.machine.positions import Place
from drillctl.machine.shape import LAST_BIT, MachineFile
from drillctl.machine.source import Source, Value

# In the paper's order (Fig. 4), then what the paper has not; the settings of an axis are repeated for each axis.
CARD_PLACES: tuple[Place, ...] = (
    ("configuration", "card"),
    ("configuration", "card_address"),
    ("configuration", "mode"),
)
SCALE_PLACES: tuple[Place, ...] = (("columns_per_inch",),)
RANGE_PLACES: tuple[Place, ...] = (("range", 0), ("range", 1))
TOOL_CHANGE: Place = ("configuration", "tool_change")
OTHER_PLACES: tuple[Place, ...] = (
    ("configuration", "longest_drilling_s"),
    TOOL_CHANGE,
    ("tick_hz",),
    ("description",),
)
MOTOR_PLACES: tuple[Place, ...] = (("phase",), ("ramp",), ("columns_per_step",))
LAST_PLACES: tuple[Place, ...] = (("configuration", "spin_up_s"),)


WIRING = "wiring"


@dataclass(frozen=True, slots=True)
class Setting:
    """One value of a machine's file: its place, the axis it belongs to ("" for none), and what it may be."""

    place: Place
    axis: str
    value: Value
    kind: type[Value]
    choices: tuple[str, ...] = ()
    least: float | None = None
    greatest: float | None = None
    above: float | None = None  # must be greater than this
    locked: bool = False

    @property
    def key(self) -> str:
        """The key in the file; the two ends of a range have the same."""
        return next(part for part in reversed(self.place) if isinstance(part, str))

    @property
    def names(self) -> frozenset[str]:
        """What ``locked`` may call it; all wires together are ``wiring``."""
        if self.place[0] == WIRING:
            return frozenset({WIRING, self.key})
        return frozenset({self.key, f"{self.axis}.{self.key}"} if self.axis else {self.key})

    def parsed(self, typed: str) -> Value:
        """Returns what was typed as the value for the file. Raises ValueError, with the reason,
        where it can't be that.
        """
        value = self._converted(typed.strip())
        if self.choices and value not in self.choices:
            raise ValueError(Message("it is one of {choices}", choices=", ".join(self.choices)).at(repr(typed)))
        if isinstance(value, str):
            return value
        too_low = (self.least is not None and value < self.least) or (self.above is not None and value <= self.above)
        if too_low or (self.greatest is not None and value > self.greatest):
            raise ValueError(Message("out of range").at(typed))
        return value

    def _converted(self, typed: str) -> Value:
        try:
            if self.kind is int:
                return int(typed, 0)
            if self.kind is float and not math.isfinite(float(typed)):
                raise ValueError
            return self.kind(typed)
        except ValueError:
            wanted = Message("a whole number") if self.kind is int else Message("a number")
            raise ValueError(Message("{kind} is wanted", kind=wanted).at(repr(typed))) from None


def settings(source: Source) -> tuple[Setting, ...]:
    """Returns all settings of a machine's text, in the order of the screen. Raises TableError for a text of wrong
    shape.
    """
    return settings_of(source.records(MachineFile))


def settings_of(raw: MachineFile) -> tuple[Setting, ...]:
    """Like ``settings``, for a file whose shape was checked. Who changes tools is a parameter where there are any."""
    others = [place for place in OTHER_PLACES if raw.parameters is None or place != TOOL_CHANGE]
    places = [
        *((place, "") for place in CARD_PLACES), *_of_axes(raw, SCALE_PLACES), *_of_axes(raw, RANGE_PLACES),
        *((place, "") for place in others), *_of_axes(raw, MOTOR_PLACES), *((place, "") for place in LAST_PLACES),
    ]  # fmt: skip
    return _with_locks(raw, (_setting(raw, place, axis) for place, axis in places))


def _of_axes(raw: MachineFile, places: Iterable[Place]) -> list[tuple[Place, str]]:
    return [(("axis", index, *place), row.name) for index, row in enumerate(raw.axis) for place in places]


def wire_settings(source: Source) -> tuple[Setting, ...]:
    """Returns the output bit of every motor's wire, in the order of the file. Raises TableError for a text of wrong
    shape.
    """
    return wire_settings_of(source.records(MachineFile))


def wire_settings_of(raw: MachineFile) -> tuple[Setting, ...]:
    """Like ``wire_settings``, for a file whose shape was checked. A bit that is no number is refused by the readers."""
    axes = {row.name for row in raw.axis}
    wires = ((name, name.partition(".")[0], bit) for name, bit in raw.wiring.items() if isinstance(bit, int))
    return _with_locks(
        raw,
        (
            Setting((WIRING, name), axis, bit, int, least=0, greatest=LAST_BIT)
            for name, axis, bit in wires
            if axis in axes
        ),
    )


def _with_locks(raw: MachineFile, found: Iterable[Setting]) -> tuple[Setting, ...]:
    return tuple(replace(setting, locked=bool(setting.names & set(raw.locked))) for setting in found)


def _setting(raw: MachineFile, place: Place, axis: str) -> Setting:
    value: Any = raw  # a place has indexes of lists and names of fields
    shape = _shape_of_a_machine()
    for part in place:
        value = value[part] if isinstance(part, int) else getattr(value, part)
        shape = _shape_inside(shape, part)
    assert isinstance(value, Value)
    return _bounded(place, axis, value, shape)


@cache
def _shape_of_a_machine() -> Type:
    return type_info(MachineFile)


def _shape_inside(shape: Type, part: str | int) -> Type:
    if isinstance(shape, StructType):
        return next(field.type for field in shape.fields if field.name == part)
    if isinstance(shape, TupleType) and isinstance(part, int):
        return shape.item_types[part]
    assert isinstance(shape, msgspec.inspect.ListType)
    return shape.item_type


def _bounded(place: Place, axis: str, value: Value, shape: Type) -> Setting:
    if isinstance(shape, LiteralType):
        return Setting(place, axis, value, str, choices=tuple(map(str, shape.values)))
    if isinstance(shape, IntType | FloatType):
        kind = int if isinstance(shape, IntType) else float
        return Setting(place, axis, value, kind, least=shape.ge, greatest=shape.le, above=shape.gt)
    return Setting(place, axis, value, str)
