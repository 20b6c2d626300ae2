"""The format is found again when the file does not tell it, and never changed silently when it does."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.generation.drillfile import DrillFile, decode, read, spacing
from drillctl.generation.drillfile.model import MM_PER_UNIT
from drillctl.generation.drillfile.numbers import Evidence, read_numbers
from drillctl.generation.drillfile.recognise import parse_option
from drillctl.generation.drillfile.spacing import SAME_MM, TOUCH_MM, meetings
from drillctl.generation.drillfile.write import write

BBOX_MM = 0.06  # the coarsest format written here has a place of 0.0254 mm
DECLARATION = re.compile(
    rb"^;[^\r\n]*format[^\r\n]*|^(?:INCH|METRIC|M71|M72)\b[^\r\n]*|(?<=PLATED) (?:MILS|MM)", re.M | re.I
)
UNDECLARED = [
    *("inch,2:3,leading", "inch,2:3,trailing", "inch,2:4,leading", "inch,2:4,trailing", "inch,2:4,none"),
    *("inch,2:5,leading", "inch,2:5,none", "inch,3:3,none", "inch,3:5,none"),
    *("mm,3:2,leading", "mm,3:3,leading", "mm,3:3,trailing", "mm,3:3,none", "mm,4:2,leading", "mm,4:2,none"),
    *("mm,4:4,trailing", "mm,4:4,none"),
]


def grid(columns: int, rows: int, pitch: int, start: int = 5000) -> str:
    """Holes in 0.0001 units, written with leading zeros dropped."""
    places = [(start + pitch * (i % columns), start + pitch * (i // columns)) for i in range(columns * rows)]
    return "".join(f"X{x}Y{y}\n" for x, y in places)


def alike(one: DrillFile, other: DrillFile, mm: float = BBOX_MM) -> bool:
    return bool(np.allclose(one.bbox_mm, other.bbox_mm, atol=mm))


def announced(drill_file: DrillFile) -> bool:
    return any(remark.code == "format-guessed" for remark in drill_file.warnings)


@pytest.fixture(scope="module")
def real_boards(real_files: list[dict]) -> list[DrillFile]:
    """Boards of middling size, quick to write and read; the one of a metre fits few formats."""
    sizes = {entry["file"]: entry["truth"]["holes"] for entry in real_files}
    boards = [read(entry["path"]) for entry in real_files if 20 < sizes[entry["file"]] < 700]
    return [board for board in boards if board.bbox_mm[2] < 900]


def test_real_files_without_their_declarations(real_files: list[dict]) -> None:
    """At least 95 of 100 right with every declaration cut out, and no wrong one without a warning."""
    right, silent, tried = 0, [], 0
    for entry in (entry for entry in real_files if entry["truth"]["holes"] > 1):
        found = decode(DECLARATION.sub(b";", entry["path"].read_bytes()), name=entry["file"])
        tried += 1
        right += (same := bool(np.allclose(found.bbox_mm, entry["truth"]["bbox_mm"], atol=0.02)))
        silent += [] if same or announced(found) else [entry["file"]]
    assert right / tried >= 0.95 and not silent


@pytest.mark.parametrize("fmt", UNDECLARED)
def test_real_boards_in_formats_nothing_declares(real_boards: list[DrillFile], fmt: str) -> None:
    """At least 88 of 100 right in the rarest format (97 over all of them), and no wrong guess is silent.

    A third of the boards in each format, another third in the next, so that each is written in five formats or six.
    """
    right = 0
    boards = real_boards[UNDECLARED.index(fmt) % 3 :: 3]
    for board in boards:
        found = decode(write(board, fmt, header=False), name=board.name)
        right += (same := alike(found, board))
        assert same or announced(found), board.name
    assert right / len(boards) >= 0.88


@pytest.mark.parametrize(
    ("file", "fmt"),
    [
        ("beaglebone-bla-beaglebone-blac-logo-210401-1-6.drl", "inch 2:5, no zeros suppressed"),
        ("h34c-h34mote16.drl", "inch 3:3, leading zeros suppressed"),
        ("cheie-electron-pth.drl", "mm 4:2, leading zeros suppressed"),
        ("eagle-cityfirefly-2.0v.drd", "inch 2:5, leading zeros suppressed"),
        ("eagle-cityfirefly-3.1v.drd", "inch 2:5, leading zeros suppressed"),
        ("gerbonara-drill.drl", "inch 2:4, trailing zeros suppressed"),
    ],
)
def test_the_files_other_readers_misread(real_files: list[dict], file: str, fmt: str) -> None:
    path = next(entry["path"] for entry in real_files if entry["file"] == file)
    assert str(read(path).format) == fmt


def test_overlap_decides() -> None:
    """0.8 mm drills 2.54 mm apart in 2:3; in the usual 2:4 they would overlap."""
    text = "M48\nINCH,TZ\nT1C0.032\n%\nT1\n" + grid(20, 15, 100, start=500) + "M30\n"
    found = decode(text.encode(), name="old.drl")
    assert found.format.digits == (2, 3) and "no overlapping holes" in found.reason


def test_a_declared_format_that_overlaps_is_kept_and_doubted() -> None:
    text = "M48\n;FILE_FORMAT=2:5\nINCH,TZ\nT1C0.032\n%\nT1\n" + grid(20, 15, 1000) + "M30\n"
    found = decode(text.encode(), name="wrong.drl")
    assert found.format.digits == (2, 5) and found.confidence == 0.5
    assert found.runner_up and found.runner_up.digits == (2, 4)
    assert "overlapping-holes" in {remark.code for remark in found.warnings}


def test_zeros_that_contradict_the_declaration() -> None:
    text = "M48\nINCH,LZ\nT1C0.032\n%\nT1\n" + grid(20, 15, 1000) + "M30\n"
    found = decode(text.encode(), name="lz.drl")
    assert found.format.zeros == "leading"
    assert ("zeros-contradict-data", 2) in {(remark.code, remark.line) for remark in found.warnings}


def test_what_is_declared_is_the_reason() -> None:
    text = "M48\n;FILE_FORMAT=4:4\nMETRIC,TZ\nT1C0.8\n%\nT1\n" + grid(5, 5, 25400) + "M30\n"
    found = decode(text.encode(), name="told.drl")
    assert found.reason == "declared by METRIC,TZ and ;FILE_FORMAT=4:4"
    assert (found.confidence, found.runner_up) == (1.0, None)


@pytest.mark.parametrize("fmt", ["inch,2:4,leading", "mm,4:2,leading", "inch,2:3,trailing", "mm,decimal"])
def test_a_format_set_by_hand_settles_it(fmt: str) -> None:
    found = decode(("%\nT1C1.\n" + grid(4, 4, 50, start=100) + "M30\n").encode(), name="bare.drl", fmt=fmt)
    choice = parse_option(fmt)
    assert (found.format.units, found.format.digits, found.confidence) == (choice.units, choice.digits, 1.0)


@pytest.mark.parametrize(
    ("word", "triple"),
    [
        ("0125", (125, 0.0125, 0)),
        ("-0125", (-125, -0.0125, 0)),
        ("+5", (5, 0.5, 0)),
        ("1.25", (0, 0, 1.25)),
        ("0", (0, 0, 0)),
    ],
)
def test_a_number_is_read_three_ways(word: str, triple: tuple[float, float, float]) -> None:
    assert read_numbers([word], Evidence())[0].tolist() == pytest.approx(triple)


@pytest.mark.parametrize(
    ("fmt", "mm"),
    [
        ("inch,2:4,leading", 25.4 * 0.0125),
        ("inch,2:4,trailing", 25.4 * 1.25),
        ("mm,3:3,none", 0.125),
        ("mm,3:3,trailing", 12.5),
    ],
)
def test_one_number_in_four_formats(fmt: str, mm: float) -> None:
    choice = parse_option(fmt)
    length = read_numbers(["0125"], Evidence())[0] @ choice.weights() * MM_PER_UNIT[choice.units]
    assert length == pytest.approx(mm)


place = st.integers(0, 60).map(lambda tenths: tenths / 10)
holes = st.lists(st.tuples(place, place, st.sampled_from([0.0, 0.1, 0.35, 0.8, 3.0])), max_size=25)


@settings(max_examples=200, deadline=None)
@given(holes)
def test_the_grid_finds_the_same_holes_as_every_pair(places: list[tuple[float, float, float]]) -> None:
    array = np.array(places).reshape(-1, 3)
    xy_mm, diameter_mm = array[:, :2], array[:, 2]
    overlapping, duplicate = set(), set()
    for later in range(len(array)):
        for earlier in range(later):
            distance = float(np.hypot(*(xy_mm[later] - xy_mm[earlier])))
            if distance <= SAME_MM:
                duplicate.add(later)
            elif distance < (diameter_mm[later] + diameter_mm[earlier]) / 2 - TOUCH_MM:
                overlapping.add(later)
    found = meetings(xy_mm, diameter_mm)
    assert (set(found[0].tolist()), set(found[1].tolist())) == (overlapping, duplicate)


def test_many_overlaps_cost_no_more_pairs_than_few() -> None:
    """2,000 holes in one cell: each is found at its first neighbour, and not compared with the rest of the cell."""
    places = np.random.default_rng(3).uniform(0, 1, (2000, 2))
    found, pairs = np.zeros(2000, bool), []

    def meets(first: np.ndarray, second: np.ndarray) -> np.ndarray:
        pairs.append(len(first))
        return np.ones(len(first), bool)

    spacing._mark(found, places, np.arange(2000), 1.0, np.ones(2000, bool), meets)
    assert found.sum() >= 1999 and sum(pairs) < 4 * 2000
