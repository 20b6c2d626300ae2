"""The parameters of a machine as every other room sees them: checked, immutable, each set or unset.

Rule: nothing is read or checked here (parameter_file.py does that); which parameters there are is parameter_table.py's.
Lengths are mm, speeds mm/min, accelerations mm/min², times ms, lives in hits. An unset parameter is None.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from drillctl.machine.parameter_table import (
    AXIS,
    COORDINATES,
    LISTS,
    MACHINING,
    OPTIONAL,
    SYSTEM,
    TOOL,
    Value,
    of_group,
)
from drillctl.machine.parameter_table import PARAMETERS as TABLE

AXIS_SWITCHES = ("installed", "enabled")


@dataclass(frozen=True, slots=True)
class ParameterRow:
    """The parameters that are set of one axis, one tool, one place of the magazine, or a whole group."""

    values: tuple[tuple[str, Value], ...] = ()

    def value(self, name: str) -> Value | None:
        """Returns a parameter's value, None where it is unset."""
        return next((value for key, value in self.values if key == name), None)

    def number(self, name: str) -> float | None:
        """Returns the value of a parameter of a number, None where it is unset."""
        value = self.value(name)
        assert value is None or isinstance(value, int | float)
        return value


@dataclass(frozen=True, slots=True)
class Parameters:
    """All parameters of a machine. ``axes`` holds the name of each axis with its row; ``tools`` and ``places`` are in
    the order of the file.
    """

    axes: tuple[tuple[str, ParameterRow], ...] = ()
    system: ParameterRow = ParameterRow()
    machining: ParameterRow = ParameterRow()
    coordinates: ParameterRow = ParameterRow()
    places: tuple[ParameterRow, ...] = ()
    tools: tuple[ParameterRow, ...] = ()

    def value(self, group: str, name: str) -> Value | None:
        """Returns a parameter of the groups system, machining or coordinates, None where it is unset."""
        return self._single(group).value(name)

    def number(self, group: str, name: str) -> float | None:
        """Like ``value``, for a parameter that is a number."""
        return self._single(group).number(name)

    def axis(self, axis: str, name: str) -> Value | None:
        """Returns a parameter of an axis by the axis's name, None where it is unset."""
        return self.of_axis(axis).value(name)

    def of_axis(self, axis: str) -> ParameterRow:
        """Returns the row of an axis; an empty one where the file says nothing of it."""
        return dict(self.axes).get(axis, ParameterRow())

    def in_use(self, axis: str) -> bool:
        """Returns whether an axis is installed and enabled."""
        return all(self.axis(axis, switch) is True for switch in AXIS_SWITCHES)

    def tool(self, number: int) -> ParameterRow | None:
        """Returns a tool's row by its number, None where there is none."""
        return next((row for row in self.tools if row.value("number") == number), None)

    def place(self, number: int) -> ParameterRow | None:
        """Returns the row of a place of the magazine by its number, None where there is none."""
        return next((row for row in self.places if row.value("place") == number), None)

    def rows(self, group: str) -> tuple[tuple[str, ParameterRow], ...]:
        """Returns the rows of a group, each with what it is called: ``axis.x``, ``system``, ``tool.3``."""
        if group == AXIS:
            return tuple((f"{AXIS}.{name}", row) for name, row in self.axes)
        if group in LISTS:
            rows = self.tools if group == TOOL else self.places
            return tuple((f"{group}.{row.value(LISTS[group])}", row) for row in rows)
        return ((group, self._single(group)),)

    def missing(self) -> tuple[str, ...]:
        """Returns the names of all parameters that must be entered before machining and are unset, such as
        ``axis.x.s_share`` or ``tool.3.life_hits``. Of an axis that is not installed or not enabled no others must be.
        """
        groups = dict.fromkeys(row.group for row in TABLE if row.group not in OPTIONAL)
        return tuple(name for group in groups for name in self._missing_of(group))

    def _missing_of(self, group: str) -> Iterator[str]:
        rows = self.rows(group)
        if not rows:
            yield group  # no tool at all, or no place of the magazine
        for called, row in rows:
            needed = [parameter.name for parameter in of_group(group)]
            if group == AXIS and any(row.value(switch) is False for switch in AXIS_SWITCHES):
                needed = list(AXIS_SWITCHES)
            yield from (f"{called}.{name}" for name in needed if row.value(name) is None)

    def _single(self, group: str) -> ParameterRow:
        return {SYSTEM: self.system, MACHINING: self.machining, COORDINATES: self.coordinates}[group]
