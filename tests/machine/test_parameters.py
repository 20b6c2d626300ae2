"""Parameters of a machine: each at, below and above its bounds, unset ones, and what they must agree with."""

import math
import re
from dataclasses import replace
from functools import cache

import pytest

from drillctl.machine import Library, Machine, TableError, shipped_tables
from drillctl.machine.parameter_entry import checked, parsed, range_of, shown
from drillctl.machine.parameter_table import AXIS, COORDINATES, GROUPS, LISTS, MAGAZINE, PARAMETERS, TOOL, Parameter
from drillctl.machine.source import Source, Value

FILE = shipped_tables() / "machines" / "eight-axis.toml"
LIBRARY = Library((shipped_tables(),))
NUMBERS = [row for row in PARAMETERS if row.low is not None]


@cache
def shipped_text() -> str:
    return FILE.read_text("utf-8")


def machine_of(text: str) -> Machine:
    return LIBRARY.machine_of(Source(FILE, text))


def header_of(group: str) -> str:
    """The table in which the file has a parameter: that of the first axis, tool or place."""
    table = f"parameters.{group}"
    return f"[[{table}]]" if group in LISTS else f"[{table}.x]" if group == AXIS else f"[{table}]"


def text_with(*changes: tuple[str, str, str], text: str | None = None) -> str:
    """The shipped text with a key's value (or a new key) in the first table of this header."""
    text = shipped_text() if text is None else text
    for header, key, value in changes:
        text = text if f"{header}\n" in text else f"{text}\n{header}\n"
        before, _, behind = text.partition(f"{header}\n")
        table, mark, others = behind.partition("\n[")
        table = re.sub(rf"^{key} = .*\n?", "", table, flags=re.M)
        text = f"{before}{header}\n{key} = {value}\n{table}{mark}{others}"
    return text


def named(row: Parameter) -> str:
    return f"{row.group}.{row.name}"


@pytest.mark.parametrize("row", NUMBERS, ids=named)
def test_a_number_at_its_bounds_is_taken_and_one_beyond_is_refused_by_name(row: Parameter) -> None:
    assert row.low is not None and row.high is not None
    whole = row.kind == "whole"
    low, high = (int(bound) if whole else bound for bound in (row.low, row.high))
    least = 1 if whole else max(abs(low), 1) * 1e-6
    assert checked(row, low) == low and checked(row, high) == high
    for beyond, word in ((low - least, f"the least is {low:.12g}"), (high + least, f"the greatest is {high:.12g}")):
        with pytest.raises(ValueError, match=rf"^{row.name} can't be .*: {word}"):
            checked(row, beyond)


@pytest.mark.parametrize("row", PARAMETERS, ids=named)
def test_what_is_no_value_of_the_kind_is_refused_by_name(row: Parameter) -> None:
    no_number = (math.nan, math.inf, -math.inf, True) if row.low is not None else ()
    for wrong in ("much", [1], {"a": 1}, 0.5j, "1e400", *no_number):
        with pytest.raises(ValueError, match=f"^{row.name} can't be "):
            checked(row, wrong)


@pytest.mark.parametrize("row", PARAMETERS, ids=named)
def test_what_is_shown_of_a_value_can_be_typed(row: Parameter) -> None:
    values: tuple[Value | None, ...] = row.choices or ((True, False) if row.low is None else (row.low, row.high))
    for value in (*values, None):
        assert parsed(row, shown(value)) == value
    assert range_of(row) and row.meaning and row.effect and row.group in GROUPS


@pytest.mark.parametrize("row", [next(row for row in NUMBERS if row.group == group) for group in GROUPS], ids=named)
def test_a_file_with_a_value_out_of_bounds_is_refused_with_its_line(row: Parameter) -> None:
    assert row.high is not None
    text = text_with((header_of(row.group), row.name, f"{row.high + 1}"))
    with pytest.raises(TableError, match=rf"parameters\.{row.group}.*: {row.name} can't be ") as refused:
        machine_of(text)
    assert text.splitlines()[(refused.value.line or 0) - 1].startswith(f"{row.name} = ")


def test_the_shipped_machine_has_all_that_must_be_entered() -> None:
    parameters = machine_of(shipped_text()).parameters
    assert parameters is not None and parameters.missing() == ()


def test_a_machine_without_parameters_has_none_and_keeps_its_digest() -> None:
    machine = LIBRARY.machine("pcb-drill")
    assert machine.parameters is None
    other = replace(machine, parameters=machine_of(shipped_text()).parameters)
    assert other.digest != machine.digest


def test_every_parameter_that_is_unset_is_missing_by_name_but_the_coordinates() -> None:
    numbered = ("number", "place")
    wanted = [row for row in PARAMETERS if row.name not in numbered]
    parameters = machine_of(text_with(*((header_of(row.group), row.name, '"unset"') for row in wanted))).parameters
    assert parameters is not None
    called = {AXIS: "axis.x", TOOL: "tool.1", MAGAZINE: "magazine.1"}
    expected = {f"{called.get(row.group, row.group)}.{row.name}" for row in wanted if row.group != COORDINATES}
    assert set(parameters.missing()) == expected


def test_a_machine_without_any_row_misses_whole_groups() -> None:
    text = shipped_text()
    text = text[: text.index("[parameters.axis.x]")] + "[parameters]\n"
    parameters = machine_of(text).parameters
    assert parameters is not None
    missing = parameters.missing()
    assert {"tool", "magazine", "axis.z6.s_share", "machining.feed_mm_min"} <= set(missing)
    assert not any("coordinates" in name for name in missing)


def test_of_an_axis_that_is_not_in_use_nothing_else_must_be_entered() -> None:
    z6 = "[parameters.axis.z6]"
    parameters = machine_of(text_with((z6, "installed", "false"), (z6, "s_share", '"unset"'))).parameters
    assert parameters is not None and parameters.missing() == ()
    assert not parameters.in_use("z6") and parameters.in_use("z5")


P = "parameters"
REFUSED = [
    (f"[{P}.machine]", "feed", "1", "parameters: unknown key 'machine'"),
    (f"[{P}.system]", "parkingx", "1", "parameters.system: unknown key 'parkingx'"),
    (f"[{P}.axis.x]", "speed", "1", "parameters.axis.x: unknown key 'speed'"),
    (f"[{P}.system]", "parking_x_mm", "600", "parking_x_mm 600 mm is out of reach: x goes from -0.55 to 598.99 mm"),
    (f"[{P}.system]", "parking_x_mm", "-0.6", "parking_x_mm -0.6 mm is out of reach"),
    (f"[{P}.system]", "change_height_mm", "60.1", "change_height_mm 60.1 mm is out of reach: z1"),
    (f"[[{P}.magazine]]", "y_mm", "1000", "parameters.magazine.1: y_mm 1000 mm is out of reach"),
    (f"[[{P}.magazine]]", "place", "2", "place 2: a second row of this number"),
    (f"[[{P}.magazine]]", "place", '"unset"', "place is missing"),
    (f"[[{P}.tool]]", "number", "2", "number 2: a second row of this number"),
    (f"[[{P}.tool]]", "magazine_place", "99", "parameters.tool.1: the magazine has no place 99"),
    (f"[[{P}.tool]]", "magazine_place", "2", "parameters.tool.2: place 2 is another tool's already"),
    (f"[[{P}.tool]]", "hits_left", "9000000", "hits_left 9000000 is more than life_hits 3000"),
    (f"[{P}.axis.x]", "home_direction", "1", "parameters.axis.x: home_direction 1, and its homing rows look at min"),
    (f"[{P}.axis.x]", "home_direction", "0", "home_direction 0, and its homing rows look at min"),
]


@pytest.mark.parametrize(("header", "key", "value", "reason"), REFUSED)
def test_what_does_not_agree_with_the_machine_is_refused(header: str, key: str, value: str, reason: str) -> None:
    with pytest.raises(TableError) as refused:
        machine_of(text_with((header, key, value)))
    assert reason in str(refused.value)
    assert refused.value.line is not None


def test_the_backlash_of_an_axis_is_that_of_its_parameter_in_whole_steps() -> None:
    changes = ("[parameters.axis.x]", "backlash_mm", "0.034")
    axes = machine_of(text_with(changes)).axes
    assert [axis.backlash_steps for axis in axes[:2]] == [3, 0]  # 0.01 mm a step
    row = ('name = "x"\n', 'name = "x"\nbacklash = 4\n')
    with pytest.raises(TableError, match=r"axis x: backlash 4, and backlash_mm is 0\.034 mm, 3 steps"):
        machine_of(text_with(changes).replace(*row, 1))
    with pytest.raises(TableError, match="axis x: backlash 4, and backlash_mm is 0 mm, 0 steps"):
        machine_of(shipped_text().replace(*row, 1))


@pytest.mark.parametrize(
    ("written", "reason"),
    [
        ("[parameters]\nsystem = 3\n", "parameters.system: a table is wanted"),
        ("[parameters]\ntool = 3\n", "rows of [[parameters.tool]] are wanted"),
        ("[[parameters.system]]\n", "parameters.system: a table is wanted"),
        ("[parameters.axis]\nx = 1\n", "parameters.axis.x: a table is wanted"),
        ("[parameters.axis.q]\n", "parameters.axis: unknown key 'q'"),
    ],
)
def test_a_group_of_the_wrong_shape_is_refused(written: str, reason: str) -> None:
    text = shipped_text()
    text = text[: text.index("[parameters.axis.x]")] + written
    with pytest.raises(TableError) as refused:
        machine_of(text)
    assert reason in str(refused.value)
