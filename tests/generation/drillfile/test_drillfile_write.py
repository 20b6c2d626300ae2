"""Holes -> any format we write -> the same holes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.generation.drillfile import DrillFile, FormatChoice, Tool, decode
from drillctl.generation.drillfile.eia import CODE, encode
from drillctl.generation.drillfile.errors import Complaint
from drillctl.generation.drillfile.model import MM_PER_UNIT
from drillctl.generation.drillfile.recognise import parse_option
from drillctl.generation.drillfile.write import number, write

DIGITS = ("2:3", "2:4", "2:5", "3:3", "3:5", "4:2", "4:4")
FORMATS = [f"{units},decimal" for units in MM_PER_UNIT] + [
    f"{units},{digits},{zeros}"
    for units in MM_PER_UNIT
    for digits in DIGITS
    for zeros in ("leading", "trailing", "none")
]


def board(holes: list, slots: list, fmt: str) -> DrillFile:
    """Holes and slots given in units of the format's last place, with two tools in turn."""
    choice = parse_option(fmt)
    place_mm = MM_PER_UNIT[choice.units] * 10.0 ** -(choice.digits[1] if choice.digits else 4)
    hole_tool = np.arange(len(holes)) % 2
    return DrillFile(
        name="board",
        tools=(Tool(1, 0.8), Tool(7, 1.1)),
        hole_xy_mm=np.array(holes, dtype=float).reshape(-1, 2) * place_mm,
        hole_tool=hole_tool,
        hole_line=np.zeros(len(holes), dtype=np.int64),
        slot_mm=np.array(slots, dtype=float).reshape(-1, 4) * place_mm,
        slot_tool=np.arange(len(slots)) % 2,
        slot_line=np.zeros(len(slots), dtype=np.int64),
        slot_at=np.sort(np.arange(len(slots)) * 3 % (len(holes) + 1)),
        routs=0,
        format=choice,
        confidence=1.0,
        runner_up=None,
        reason="",
        warnings=(),
    )


coordinate = st.integers(-19_000, 19_000)  # stays within 5 m in the coarsest format
points = st.lists(st.tuples(coordinate, coordinate), max_size=12)
slot = st.tuples(coordinate, coordinate, coordinate, coordinate).filter(lambda ends: ends[:2] != ends[2:])
lines = st.lists(slot, max_size=4)


@settings(max_examples=200, deadline=None)
@given(points, lines, st.sampled_from(FORMATS), st.booleans(), st.booleans())
def test_round_trip(holes: list, slots: list, fmt: str, header: bool, tape_code: bool) -> None:
    original = board(holes, slots, fmt)
    data = write(original, fmt, header=header, tape_code=tape_code)
    back = decode(data, name="back", fmt=None if header else fmt)
    assert np.allclose(back.hole_xy_mm, original.hole_xy_mm, atol=1e-6)
    assert np.allclose(back.slot_mm, original.slot_mm, atol=1e-6)
    assert back.slot_at.tolist() == original.slot_at.tolist()
    sizes = [original.tools[tool].diameter_mm for tool in original.hole_tool]
    assert [back.tools[tool].diameter_mm for tool in back.hole_tool] == pytest.approx(sizes, abs=1e-4)


@pytest.mark.parametrize(
    ("value", "choice", "text"),
    [
        (12.7, FormatChoice("mm"), "12.7"),
        (-5.0, FormatChoice("mm"), "-5.0"),
        (1.25, FormatChoice("inch", (2, 4), "leading"), "12500"),
        (1.25, FormatChoice("inch", (2, 4), "trailing"), "0125"),
        (1.25, FormatChoice("inch", (2, 4), "none"), "012500"),
        (-0.5, FormatChoice("mm", (3, 3), "none"), "-000500"),
        (0.0, FormatChoice("mm", (3, 3), "leading"), "0"),
        (-0.0001, FormatChoice("mm", (3, 3), "none"), "000000"),
    ],
)
def test_numbers_as_written(value: float, choice: FormatChoice, text: str) -> None:
    assert number(value, choice) == text


def test_a_number_too_large_for_the_format_is_an_error() -> None:
    with pytest.raises(ValueError, match="more than 2 places"):
        number(100.0, FormatChoice("inch", (2, 4), "leading"))


def test_tools_with_one_number_get_new_ones() -> None:
    text = "M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0\nM48\nT1C0.9\n%\nT1\nX5.0Y5.0\nM30\n"
    back = decode(write(decode(text.encode(), name="two")), name="back")
    assert back.tools == (Tool(1, 0.8), Tool(2, 0.9)) and back.hole_tool.tolist() == [0, 1]


def test_every_tape_row_has_odd_parity_and_its_own_code() -> None:
    assert all(row.bit_count() % 2 for row in CODE.values())
    assert len(set(CODE.values())) == len(CODE)


def test_tape_code_has_no_row_for_a_semicolon() -> None:
    with pytest.raises(Complaint):
        encode("; comment")
