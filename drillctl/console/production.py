"""The parameters and records of the machine in use (viewmodel/production.py).

Rule: a parameter reaches the machine's file first, then the machine, which is started anew with it at rest. What the
readers of files refuse changes neither.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Protocol

from drillctl.console.magazine_record import MagazineRecord
from drillctl.console.parameters import Change, save, saved_in
from drillctl.generation.eight_axis.magazine import Magazine
from drillctl.language import Message, message_of
from drillctl.machine import Library, Machine, ParameterRow, Parameters
from drillctl.machine.library import user_tables
from drillctl.machine.parameter_edit import Entry, entries, entry, with_parameters, with_row, without_row
from drillctl.machine.parameter_entry import parsed, range_of, shown
from drillctl.machine.parameter_table import GROUPS, MACHINING, SYSTEM, Value
from drillctl.viewmodel.console import MachineView, Problems
from drillctl.viewmodel.production import ParameterView, PlaceRecord, Records, ToolRecord

RECORD = MagazineRecord()  # what it has read is kept for the next call
MONITOR_MS = 100  # where the position detection cycle is not entered


class Desk(Protocol):
    """What is asked of the console of the machine in use."""

    @property
    def machine(self) -> Machine:
        """The machine in use."""

    def view(self) -> MachineView:
        """The machine as it is now."""

    def busy(self) -> Problems:
        """Why nothing new can be begun now."""

    def choose_machine(self, name: str) -> Problems:
        """Changes to a machine by name or file."""

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        """Moves to a place in mm from the working base, the drill raised."""


class MachineProduction:
    """A Production of the machine that ``desk`` has in use, which has parameters."""

    def __init__(
        self, desk: Desk, library: Library, folder: Callable[[], Path] = user_tables,
        kept: MagazineRecord = RECORD,
    ):  # fmt: skip
        self._desk, self._library, self._folder = desk, library, folder
        self._kept = kept

    def records(self) -> Records:
        """What the parameters say; a magazine's record beside them where one is kept."""
        machine, parameters = self._desk.machine, self._parameters
        absolute = _pair(parameters.coordinates, "absolute_{}_mm") or (0.0, 0.0)
        relative = _pair(parameters.coordinates, "relative_{}_mm")
        magazine, trouble = self._kept.of(machine)
        owners = {row.value("magazine_place"): row.value("number") for row in parameters.tools}
        return Records(
            stroke_mm=parameters.number(MACHINING, "working_stroke_mm"),
            bottom_mm=_bottom_mm(machine),
            absolute_mm=absolute,
            relative_mm=(relative[0] + absolute[0], relative[1] + absolute[1]) if relative else None,
            cycle_s=(parameters.number(SYSTEM, "position_detection_cycle_ms") or MONITOR_MS) / 1000,
            tools=tuple(_tool(row, machine, magazine) for row in parameters.tools),
            places=tuple(_place(row, owners, magazine) for row in parameters.places),
            chucks=tuple(tool for _spindle, tool in sorted(magazine.chucks.items())) if magazine else (),
            missing=parameters.missing(),
            trouble=trouble,
        )

    def groups(self) -> Sequence[tuple[str, str]]:
        """The groups of the table of parameters, in its order."""
        return tuple(GROUPS.items())

    def parameters(self, group: str) -> Sequence[ParameterView]:
        """The parameters of a group with what the table says of them."""
        return [_view(one) for one in entries(self._parameters) if one.parameter.group == group]

    @property
    def position_known(self) -> bool:
        """Whether the machine knows where it stands, which is lost when it is started anew."""
        return self._desk.view().position_known

    def problem(self, name: str, typed: str) -> Problems:
        """What the row of the parameter says of a value."""
        try:
            parsed(entry(self._parameters, name).parameter, typed)
        except ValueError as error:
            return (message_of(error),)
        return ()

    def enter(self, typed: Mapping[str, str]) -> Problems:
        """Saves values in the file of the machine, and takes it anew."""
        return self._change(lambda source: with_parameters(source, typed))

    def add(self, group: str, number: int) -> Problems:
        """Saves one more row of a group."""
        return self._change(lambda source: with_row(source, group, number))

    def remove(self, group: str, number: int) -> Problems:
        """Saves a group without one of its rows."""
        return self._change(lambda source: without_row(source, group, number))

    def park(self) -> Problems:
        """Goes to the parking place, which counts from machine zero, by way of the working base."""
        parking = _pair(self._parameters.system, "parking_{}_mm")
        if parking is None:
            return (Message("the parking place is not entered: system.parking_x_mm, system.parking_y_mm"),)
        view = self._desk.view()
        if not view.position_known:
            return (Message("the position is not known: initialise first"),)
        places = {axis.name: axis.position_steps / axis.steps_per_mm - axis.position_mm for axis in view.axes}
        return self._desk.go_to(parking[0] - places["x"], parking[1] - places["y"])

    @property
    def _parameters(self) -> Parameters:
        found = self._desk.machine.parameters
        assert found is not None
        return found

    def _change(self, change: Change) -> Problems:
        machine = self._desk.machine
        target = saved_in(machine, self._folder())
        if problems := self._desk.busy() or save(self._library, machine, self._folder(), change):
            return problems
        by_name = self._library.find("machines", machine.name) == target
        return self._desk.choose_machine(machine.name if by_name else str(target))


def _view(one: Entry) -> ParameterView:
    row = one.parameter
    switch = ("true", "false") if row.kind == "switch" else ()
    choices = switch or tuple(map(str, row.choices))
    return ParameterView(one.name, shown(one.value), range_of(row), row.meaning, row.effect, choices)


def _tool(row: ParameterRow, machine: Machine, magazine: Magazine | None) -> ToolRecord:
    """A tool as its parameters have it; the holes that it is good for by the record, where one is kept."""
    number, left, place = int(row.number("number") or 0), row.number("hits_left"), row.number("magazine_place")
    kept = left if magazine is None or left is None else magazine.hits_left(machine, number)
    return ToolRecord(
        number,
        row.number("diameter_mm"),
        row.number("offset_mm"),
        None if kept is None else int(kept),
        None if place is None else int(place),
    )


def _place(
    row: ParameterRow, owners: Mapping[Value | None, Value | None], magazine: Magazine | None
) -> PlaceRecord:  # fmt: skip
    number = int(row.number("place") or 0)
    owner = owners.get(number)
    bits = sorted(magazine.bits.items()) if magazine is not None else []
    there = tuple(there for (place, _spindle), there in bits if place == number)
    return PlaceRecord(number, owner if isinstance(owner, int) else None, there)


def _pair(row: ParameterRow, name: str) -> tuple[float, float] | None:
    """X and Y of a place; None where one of them is not entered."""
    x_mm, y_mm = (row.number(name.format(axis)) for axis in "xy")
    return None if x_mm is None or y_mm is None else (x_mm, y_mm)


def _bottom_mm(machine: Machine) -> float | None:
    """The lowest place that the heads are sent to; None where a sensor stops them."""
    if machine.drill_down_steps is None:
        return None
    return max(machine.drill_down_steps / machine.axes[axis].steps_per_mm for axis in machine.drill_axes)
