"""The ``[parameters]`` of a machine's file: read, each value checked by its row of parameter_table.py, then against the
rest of the machine.

Rule: a key that is missing or ``"unset"`` is unset, and the machine can be read without it; a job on it is refused
(generation/entered.py). An unknown key, a value out of its bounds and a place out of reach are errors with their line.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from drillctl.language import Message, known_words, message_of
from drillctl.machine.model import Machine
from drillctl.machine.parameter_entry import checked
from drillctl.machine.parameter_table import AXIS, COORDINATES, GROUPS, MACHINING, MAGAZINE, SYSTEM, TOOL, of_group
from drillctl.machine.parameters import ParameterRow, Parameters
from drillctl.machine.positions import Place
from drillctl.machine.shape import MachineFile
from drillctl.machine.source import Source

PARAMETERS = "parameters"


def read_parameters(source: Source, raw: MachineFile) -> Parameters | None:
    """Returns the parameters of a machine's file, None for a file without ``[parameters]``. Raises TableError."""
    if raw.parameters is None:
        return None
    written = _table(source, raw.parameters, (PARAMETERS,), list(GROUPS))
    axes = _table(source, written.get(AXIS, {}), (PARAMETERS, AXIS), [row.name for row in raw.axis])
    single = {
        group: _row(source, group, written.get(group, {}), (PARAMETERS, group))
        for group in (SYSTEM, MACHINING, COORDINATES)
    }
    return Parameters(
        axes=tuple(
            (row.name, _row(source, AXIS, axes.get(row.name, {}), (PARAMETERS, AXIS, row.name))) for row in raw.axis
        ),
        system=single[SYSTEM],
        machining=single[MACHINING],
        coordinates=single[COORDINATES],
        places=_rows(source, MAGAZINE, "place", written.get(MAGAZINE, [])),
        tools=_rows(source, TOOL, "number", written.get(TOOL, [])),
    )


def check_parameters(source: Source, machine: Machine) -> None:
    """Checks the parameters against each other and against axes and homing. Raises TableError."""
    if machine.parameters is not None:
        _check_tools(source, machine.parameters)
        _check_homing(source, machine, machine.parameters)
        _check_reach(source, machine, machine.parameters)


def with_backlash(source: Source, raw: MachineFile, machine: Machine) -> Machine:
    """Returns the machine whose axes have the backlash of their parameters, in whole steps. Raises TableError where the
    row of an axis names another.
    """
    axes = []
    for index, table in enumerate(machine.axes):
        entered = machine.parameters.of_axis(table.name).number("backlash_mm") if machine.parameters else None
        steps = table.backlash_steps if entered is None else round(entered * table.steps_per_mm)
        written = raw.axis[index].backlash
        if written and steps != written:
            reason = Message("axis {name}: backlash {written}, and backlash_mm is {entered:g} mm, {steps} steps",
                             name=table.name, written=written, entered=entered, steps=steps)  # fmt: skip
            raise source.error(reason, "axis", index, "backlash")
        axes.append(replace(table, backlash_steps=steps))
    return replace(machine, axes=tuple(axes))


def _table(source: Source, value: object, place: Place, known: Sequence[str]) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise source.error(Message("a table is wanted").at(_dotted(place)), *place)
    for key in value:
        if key not in known:
            reason = Message("unknown key {name!r}; {words}", name=key, words=known_words(key, known))
            raise source.error(reason.at(_dotted(place)), *place, key)
    return value


def _row(source: Source, group: str, value: object, place: Place) -> ParameterRow:
    rows = of_group(group)
    written = _table(source, value, place, [parameter.name for parameter in rows])
    found = []
    for parameter in (parameter for parameter in rows if parameter.name in written):
        try:
            entered = checked(parameter, written[parameter.name])
        except ValueError as error:
            raise source.error(message_of(error).at(_dotted(place)), *place, parameter.name) from error
        if entered is not None:
            found.append((parameter.name, entered))
    return ParameterRow(tuple(found))


def _rows(source: Source, group: str, key: str, value: object) -> tuple[ParameterRow, ...]:
    """Returns the numbered rows of a group; a number is written in each, and once."""
    if not isinstance(value, list):
        reason = Message("rows of [[{table}]] are wanted", table=_dotted((PARAMETERS, group)))
        raise source.error(reason, PARAMETERS, group)
    rows: list[ParameterRow] = []
    for index, written in enumerate(value):
        row = _row(source, group, written, (PARAMETERS, group, index))
        number = row.value(key)
        if number is None:
            reason = Message("{key} is missing", key=key)
            raise source.error(reason.at(_dotted((PARAMETERS, group))), PARAMETERS, group, index)
        if any(other.value(key) == number for other in rows):
            reason = Message("{key} {number}: a second row of this number", key=key, number=number)
            raise source.error(reason.at(_dotted((PARAMETERS, group))), PARAMETERS, group, index, key)
        rows.append(row)
    return tuple(rows)


def _check_tools(source: Source, parameters: Parameters) -> None:
    for index, tool in enumerate(parameters.tools):
        life, left, place = (tool.number(name) for name in ("life_hits", "hits_left", "magazine_place"))
        called, at = f"{PARAMETERS}.{TOOL}.{tool.value('number')}", (PARAMETERS, TOOL, index)
        if life is not None and left is not None and left > life:
            reason = Message("hits_left {left} is more than life_hits {life}", left=left, life=life)
            raise source.error(reason.at(called), *at, "hits_left")
        if place and parameters.place(int(place)) is None:
            raise source.error(
                Message("the magazine has no place {place}", place=place).at(called), *at, "magazine_place"
            )
        if place and any(other.value("magazine_place") == place for other in parameters.tools[:index]):
            raise source.error(
                Message("place {place} is another tool's already", place=place).at(called), *at, "magazine_place"
            )


def _check_homing(source: Source, machine: Machine, parameters: Parameters) -> None:
    """An axis looks for its switch in the direction that its homing rows go."""
    for index, table in enumerate(machine.axes):
        direction = parameters.axis(table.name, "home_direction")
        ends = {step.end for step in machine.homing if step.do != "zero" and index in step.axes}
        if direction is None or ends == {-1: {"min"}, 1: {"max"}, 0: set()}[int(direction)]:
            continue
        reason = Message(
            "home_direction {direction}, and its homing rows look at {ends}",
            direction=direction,
            ends=", ".join(sorted(ends)) or "-",
        )
        place = (PARAMETERS, AXIS, table.name, "home_direction")
        raise source.error(reason.at(_dotted(place[:-1])), *place)


def _check_reach(source: Source, machine: Machine, parameters: Parameters) -> None:
    """Parking, places of the magazine and the change height lie where their axes can go."""
    places: list[tuple[ParameterRow, str, str, Place]] = [
        (parameters.system, f"parking_{axis}_mm", axis, (PARAMETERS, SYSTEM)) for axis in "xy"
    ]
    for number, row in enumerate(parameters.places):
        places += [(row, f"{axis}_mm", axis, (PARAMETERS, MAGAZINE, number)) for axis in "xy"]
    heads = [machine.axes[index].name for index in machine.drill_axes]
    places += [(parameters.system, "change_height_mm", head, (PARAMETERS, SYSTEM)) for head in heads]
    for row, name, axis, place in places:
        _check_within(source, machine, row.number(name), axis, (*place, name))


def _check_within(source: Source, machine: Machine, wanted_mm: float | None, axis: str, place: Place) -> None:
    index = machine.axis_index(axis)
    if wanted_mm is None or index is None:
        return
    scale = machine.axes[index].steps_per_mm
    low_mm, high_mm = (steps / scale for steps in machine.reach(index))
    if not low_mm <= wanted_mm <= high_mm:
        reason = Message(
            "{name} {value:g} mm is out of reach: {axis} goes from {low:g} to {high:g} mm",
            name=place[-1],
            value=wanted_mm,
            axis=axis,
            low=low_mm,
            high=high_mm,
        )
        raise source.error(reason.at(_dotted(place[:-1])), *place)


def _dotted(place: Place) -> str:
    return ".".join(str(part + 1) if isinstance(part, int) else part for part in place)
