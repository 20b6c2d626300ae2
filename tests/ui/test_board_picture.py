"""The picture of a board: which dot a hole lights, zoom and pan, rulers, signs, and the mouse on it."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from drillctl.language import words
from drillctl.ui.models.board_map import CLOSEST, BoardMap, marks_mm, round_mm
from drillctl.ui.models.board_work import BoardWork, Work
from drillctl.ui.screens.board_view import BoardPicture
from drillctl.viewmodel.console import ToolView
from drillctl.viewmodel.records import Progress
from tests.ui.fake_console import BOARD, FAULT, VIEW, FakeConsole, Program

SIZES = ((80, 24), (100, 32), (160, 50), (220, 60))
WHOLE = (78, 30)
MIDDLE = Progress(2, 4, 1, 2500, 5.0, 5.0)
TWO_TOOLS = replace(BOARD, tool=np.array([0, 0, 1, 1]), tools=(ToolView(1, 0.8, 2), ToolView(12, 3.0, 2)))

pytestmark = pytest.mark.usefixtures("idle")


def text_of(picture: BoardPicture, size: tuple[int, int] = WHOLE) -> str:
    return "\n".join(row.decode() for row in picture.render(size).text)


def shown(work: Work = Work(), board: object = BOARD, **further: object) -> BoardPicture:  # noqa: B008 - immutable
    picture = BoardPicture()
    picture.show(board, work, **further)  # type: ignore[arg-type]
    return picture


def test_a_hole_lights_the_dot_at_its_place() -> None:
    """8 x 3 cells are 16 x 12 dots: a board of 15 x 11 mm has a dot a mm, its corners in the outermost ones."""
    placed = dataclasses.replace(BoardMap.of(np.array([[0.0, 0.0], [10.0, 5.0]]), 8, 3), low_mm=np.array([0.0, 0.0]),
                     high_mm=np.array([15.0, 11.0]), centre_mm=np.array([7.5, 5.5]))  # fmt: skip
    assert placed.dots_per_mm == 1.0
    places = np.array([[0.0, 0.0], [15.0, 0.0], [0.0, 11.0], [3.0, 7.0]])
    assert placed.dots(places).tolist() == [[11, 0], [11, 15], [0, 0], [4, 3]]
    assert placed.cells(places).tolist() == [[2, 0], [2, 7], [0, 0], [1, 1]]
    assert np.argwhere(placed.grid(placed.dots(places[3:]))).tolist() == [[4, 3]]


def test_a_hole_is_drawn_as_large_as_it_is_and_at_least_one_dot() -> None:
    placed = BoardMap.of(BOARD.xy_mm, 78, 30)
    count = [len(placed.discs(np.array([[20.0, 10.0]]), np.array([mm]))) - 1 for mm in (0.0, 2 / placed.dots_per_mm)]
    assert count == [0, 5]


@settings(max_examples=60, deadline=None)
@given(
    st.floats(0.5, 8), st.floats(-5, 50), st.floats(-5, 30), st.integers(1, 150), st.integers(1, 50),
    st.integers(-40, 40),
)  # fmt: skip
def test_zoom_keeps_what_is_under_the_pointer_and_pan_ends_at_the_edges(
    factor: float, x_mm: float, y_mm: float, columns: int, rows: int, by: int
) -> None:
    whole = BoardMap.of(BOARD.xy_mm, columns, rows)
    middle = (whole.low_mm + whole.high_mm) / 2
    at = np.array([x_mm, y_mm])
    close = whole.zoomed(8.0)
    further = close.zoomed(factor, close.centre_mm)
    assert np.allclose(further.centre_mm, close.centre_mm) and 1 <= further.zoom <= CLOSEST
    moved = close.zoomed(factor, at).panned(by, by)
    assert (moved.centre_mm >= whole.low_mm - 1e-9).all() and (moved.centre_mm <= whole.high_mm + 1e-9).all()
    assert np.allclose(moved.zoomed(0.0).centre_mm, middle)


def test_zoom_leaves_the_place_under_the_pointer_where_it_is() -> None:
    placed = BoardMap.of(BOARD.xy_mm, 60, 20)
    at = placed.place_mm(40, 12)
    assert placed.zoomed(2.0, at).cells(at[None, :]).tolist() == [[12, 40]]


@pytest.mark.parametrize(("least", "length"), [(0.05, 0.1), (0.3, 0.5), (5, 5), (5.1, 10), (9999, 1000)])
def test_lengths_of_scales_are_round(least: float, length: float) -> None:
    assert round_mm(least) == length


def test_marks_of_a_ruler_are_multiples_of_its_step() -> None:
    assert marks_mm(-7, 21, 10) == [0, 10, 20] and marks_mm(-10, -10, 5) == [-10]


def test_rulers_scale_and_origin_stand_around_a_large_picture_and_the_scale_alone_around_a_small_one() -> None:
    large, small = text_of(shown()), text_of(shown(), (43, 17))
    assert large.splitlines()[-3].count("┴") >= 3 and "mm" in large.splitlines()[-2]
    assert "├" in large.splitlines()[-1] and "├" in small.splitlines()[-1]
    assert "⊕" not in large, "a hole lies on the base"
    moved = replace(BOARD, xy_mm=BOARD.xy_mm - 5.0)
    assert "⊕" in text_of(shown(board=moved)) and "┴" not in small


def test_a_mark_of_the_ruler_stands_above_its_number_and_in_the_column_of_its_place() -> None:
    picture = shown(Work(4))
    rows = text_of(picture).splitlines()
    column = rows[-2].index("20") + 1
    assert rows[-3][column] == "┴"
    picture.show(BOARD, Work(4), head_mm=(20.0, 10.0))
    assert "+" in {row[column] for row in text_of(picture).splitlines()[:-3]}


def test_every_state_of_a_hole_has_its_sign() -> None:
    text = text_of(shown(Work(1, current=1, failed=2), head_mm=(20.0, 10.0), real_mm=(30.0, 10.0)))
    assert all(text.count(sign) == 1 for sign in "○◎×+◇")


def test_the_head_leaves_a_trail_and_draws_only_its_own_rows() -> None:
    picture = shown()
    before = text_of(picture).splitlines()
    for x_mm in (10.0, 15.0, 20.0):
        picture.show(BOARD, head_mm=(x_mm, 10.0))
    after = text_of(picture).splitlines()
    changed = [row for row, (old, new) in enumerate(zip(before, after, strict=True)) if old != new]
    trail = sum(0x2800 < ord(sign) < 0x2900 for sign in after[changed[0]])
    picture.show(BOARD, head_mm=(20.0, 10.0), moving=False)
    at_rest = sum(0x2800 < ord(sign) < 0x2900 for sign in text_of(picture).splitlines()[changed[0]])
    assert len(changed) == 1 and at_rest + 5 < trail


def test_the_way_to_go_is_dotted_and_gets_shorter() -> None:
    def dots(work: Work) -> int:
        return sum(bin(ord(sign) - 0x2800).count("1") for sign in text_of(shown(work)) if 0x2800 < ord(sign) < 0x2900)

    assert dots(Work(0)) > dots(Work(1)) > dots(Work(2)) > dots(Work(3))


def test_tool_numbers_stand_in_place_of_the_dots() -> None:
    picture = shown(board=TWO_TOOLS)
    before = "\n".join(text_of(picture).splitlines()[:-3])
    assert picture.turn_numbers()
    after = "\n".join(text_of(picture).splitlines()[:-3])
    assert (after.count("1"), after.count("2")) == (before.count("1") + 2, before.count("2") + 2)
    assert not picture.turn_numbers()


def test_the_mouse_zooms_pans_and_tells_of_a_hole() -> None:
    picture = shown(board=TWO_TOOLS)
    rows = text_of(shown(Work(4), TWO_TOOLS)).splitlines()
    row, column = next((r, line.rindex("○")) for r, line in enumerate(rows) if "○" in line)
    picture.render(WHOLE)
    assert picture.mouse_event(WHOLE, "mouse press", 1, column, row, True)
    assert "hole 3, T12 3.000 mm, X 40.000, Y 20.000" in text_of(picture).splitlines()[-1]
    assert picture.render((23, 10)).text[-1].decode().strip() == "hole 3, T12", "the rest has no room"
    picture.mouse_event(WHOLE, "mouse press", 4, column, row, True)
    assert "zoom 2" in text_of(picture)
    close = text_of(picture)
    picture.mouse_event(WHOLE, "mouse press", 1, 40, 10, True)
    picture.mouse_event(WHOLE, "mouse drag", 1, 50, 5, True)
    assert text_of(picture) != close and "hole" not in text_of(picture).splitlines()[-1]
    picture.mouse_event(WHOLE, "mouse press", 5, 40, 10, True)
    assert "zoom" not in text_of(picture)


def test_a_click_on_the_screen_reaches_the_board() -> None:
    program = Program(FakeConsole(loaded=BOARD, job=replace(MIDDLE, holes_done=4)), (160, 50))
    rows = program.text().splitlines()
    row, column = next((r, line.index("○")) for r, line in enumerate(rows) if "○" in line)
    program.press(("mouse press", 1, column, row))
    assert "hole 4, T1 0.800 mm, X 0.000, Y 20.000" in program.text()


def test_a_hole_has_failed_where_a_fault_came_over_it_until_it_is_drilled_or_begun_anew() -> None:
    followed = BoardWork()
    running = replace(VIEW, command="KMD_WIERTLO_DOL")
    assert followed.see(running, BOARD, MIDDLE) == Work(2, current=2)
    latched = replace(VIEW, condition="latched", fault=FAULT)
    assert followed.see(latched, BOARD, MIDDLE) == followed.see(VIEW, BOARD, MIDDLE) == Work(2, failed=2)
    assert followed.see(running, BOARD, replace(MIDDLE, holes_done=0)) == Work(0, current=0)


def test_a_job_that_is_not_the_board_s_marks_no_hole() -> None:
    assert BoardWork().see(replace(VIEW, command="KMD_RUCHd"), BOARD, replace(MIDDLE, holes_total=3)) == Work()


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("size", SIZES)
def test_the_whole_picture_stands_at_every_size(language: str, size: tuple[int, int]) -> None:
    words.use(language)
    console = FakeConsole(now=replace(VIEW, command="KMD_WIERTLO_DOL"), loaded=TWO_TOOLS, job=MIDDLE)
    text = Program(console, size).text()
    assert text.count("○") == 2 and text.count("◎") == 1 and " mm" in text
    assert ("┴" in text) == (size[0] >= 100)


def test_a_point_or_a_line_of_holes_is_drawn_too() -> None:
    for xy in ([[5.0, 5.0]], [[0.0, 0.0], [40.0, 0.0]]):
        xy_mm = np.array(xy)
        board = replace(BOARD, xy_mm=xy_mm, tool=np.zeros(len(xy), np.int64))
        for size in ((1, 1), (3, 2), (48, 16), WHOLE):
            assert len(text_of(shown(board=board), size).splitlines()) == size[1]
