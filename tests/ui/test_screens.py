"""Files and Drilling on a canvas, upon a console that keeps what it was asked."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import urwid

from drillctl.panel.console import Asked, MachineView
from drillctl.panel.records import Progress
from drillctl.ui import app, words
from drillctl.ui.dialogs import pair_mm
from drillctl.ui.lines import Line
from drillctl.ui.screens.board_view import BoardPicture
from drillctl.ui.screens.drilling import STEP_SIZES, Drilling
from drillctl.ui.screens.files import CHOICES, Files
from drillctl.ui.screens.side_window import side_lines
from tests.ui.desk import BOARD, VIEW, WIRES, FakeConsole, Program

MIDDLE = Progress(2, 4, 1, 2500, 5.0, 5.0)


@pytest.fixture(autouse=True)
def english(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    words.use("en")
    monkeypatch.setattr(app, "TURNING_S", 0.0)
    yield
    words.use("en")


def plain_text(lines: list[Line]) -> list[str]:
    return ["".join(part if isinstance(part, str) else part[1] for part in line) for line in lines]


REQUESTS = [
    ("d", ("start", True)),
    (" ", ("hold",)),
    ("x", ("stop",)),
    ("i", ("initialise",)),
    ("b", ("set_base",)),
    ("a", ("acknowledge",)),
    ("left", ("jog", "x", -12)),
    ("right", ("jog", "x", 12)),
    ("up", ("jog", "y", 12)),
    ("down", ("jog", "y", -12)),
    ("page up", ("jog", "z", -12)),
    ("page down", ("jog", "z", 12)),
]
OPENING = {"s": "Drill 4 holes of four.drl?", "f": "../", "h": "Number, 1 to 4:", "t": "X and Y in mm", "+": "step 120",
           "=": "step 120", "-": "step 3"}  # fmt: skip


@pytest.mark.parametrize(("key", "request_"), REQUESTS)
def test_a_key_of_drilling_asks_for_what_the_help_says(key: str, request_: tuple[object, ...]) -> None:
    program = Program(FakeConsole(loaded=BOARD))
    program.press(key)
    assert program.console.asked == [request_]


@pytest.mark.parametrize(("key", "shown"), OPENING.items())
def test_the_other_keys_of_drilling_show_something(key: str, shown: str) -> None:
    program = Program(FakeConsole(loaded=BOARD))
    program.press(key)
    assert shown in program.text() and not program.console.asked


def test_every_key_of_drilling_is_tried() -> None:
    assert {name for key in Drilling.keys for name in key.names} == {*dict(REQUESTS), *OPENING}


def test_drilling_begins_only_after_a_yes() -> None:
    program = Program(FakeConsole(loaded=BOARD))
    program.press("s", "enter")
    program.press("s", "esc")
    assert not program.console.asked
    program.press("s", "right", "enter")
    assert program.console.asked == [("start", False)]


def test_a_refusal_stands_in_the_bottom_line() -> None:
    program = Program(FakeConsole(answer=("the machine is at work",)))
    program.press("right")
    assert "refused: the machine is at work" in program.text()


def test_step_sizes_end_at_both_ends() -> None:
    program = Program(FakeConsole())
    program.press(*["+"] * 10, "right", *["-"] * 10, "right")
    assert program.console.asked == [("jog", "x", STEP_SIZES[-1]), ("jog", "x", STEP_SIZES[0])]


def test_going_to_a_hole_and_to_a_typed_place() -> None:
    program = Program(FakeConsole(loaded=BOARD))
    program.press("h", "backspace", "3", "enter")
    program.press("t", *["backspace"] * 3, *"12,7 -3.5", "enter")
    assert program.console.asked == [("go_to", 40.0, 20.0), ("go_to", 12.7, -3.5)]
    program.press("h", "9", "enter")
    assert "there is no hole '19'" in program.text() and len(program.console.asked) == 2


def test_space_resumes_what_is_held() -> None:
    program = Program(FakeConsole(now=replace(VIEW, condition="held")))
    program.press(" ")
    assert program.console.asked == [("resume",)] and "HELD" in program.text()


@pytest.mark.parametrize(
    ("text", "pair"),
    [("12.7 25.4", (12.7, 25.4)), ("1,5;-2", (1.5, -2.0)), ("1", None), ("1 2 3", None), ("a b", None), ("nan 1", None),
     ("inf 0", None), ("", None)],
)  # fmt: skip
def test_a_typed_pair(text: str, pair: tuple[float, float] | None) -> None:
    assert pair_mm(text) == pair


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize(("columns", "rows"), [(36, 18), (48, 46)])
def test_the_side_window_fits_and_tells_all(language: str, columns: int, rows: int) -> None:
    words.use(language)
    view = replace(VIEW, command="KMD_GOTO_X_Y 1559 0", queued=7, moving=True, late=3, late_worst_ms=1.5)
    lines = plain_text(side_lines(view, MIDDLE, BOARD, columns, rows))
    text = "\n".join(lines)
    assert len(lines) <= rows and max(map(len, lines)) <= columns
    for told in ("3.175", "KMD_GOTO_X_Y 1559 0", "0:05", "T1 0.800 mm", "[x_min]", " x_max ", "500 Hz", "1.5 ms"):
        assert told in text
    assert words._("Lost") in text and "+3" in text


def test_the_whole_table_stands_where_there_is_room_with_its_column_marked() -> None:
    lines = plain_text(side_lines(VIEW, None, None, 48, 46))
    assert lines.count("   [1a]    xxxxxx[.].....") == 3 and lines.count("    1b     ......[x]xxxxx") == 3
    small = plain_text(side_lines(VIEW, None, None, 36, 18))
    assert "X   7 +3 [1a] 1b [24a]" in small


def test_where_rows_are_few_the_phases_give_way_to_ticks_and_sensors() -> None:
    many = replace(VIEW, axes=VIEW.axes[:1] * 8)
    text = "\n".join(plain_text(side_lines(many, None, None, 36, 19)))
    assert "500 Hz" in text and "[x_min]" in text and text.count("\n") == 18


def signs_of(picture: BoardPicture, size: tuple[int, int] = (20, 6)) -> str:
    return "\n".join(row.decode() for row in picture.render(size).text)


@pytest.mark.parametrize(("plain", "signs"), [(False, "○◎+"), (True, "o@+.")])
def test_done_current_to_do_and_head_differ_without_colour(plain: bool, signs: str) -> None:
    picture = BoardPicture(plain)
    picture.show(BOARD, done=2, running=True, head_mm=(20.0, 10.0))
    text = signs_of(picture)
    assert all(sign in text for sign in signs)
    assert text.count(signs[0]) == 2 and text.count(signs[1]) == 1 and text.count("+") == 1
    assert not plain or text.isascii()


def test_a_cell_with_holes_to_do_is_not_shown_as_done() -> None:
    crowded = replace(BOARD, xy_mm=np.array([[0.0, 0.0], [0.5, 0.0], [100.0, 0.0], [0.0, 50.0]]))
    picture = BoardPicture()
    picture.show(crowded, done=1)
    assert "○" not in signs_of(picture)
    picture.show(crowded, done=2)
    assert signs_of(picture).count("○") == 1


def test_a_narrow_terminal_keeps_the_window_and_drops_the_board() -> None:
    program = Program(FakeConsole(loaded=BOARD), (50, 24))
    assert "Command" in program.text() and "⠁" not in program.text()


@pytest.mark.parametrize("size", [(80, 24), (160, 50)])
def test_the_screen_is_a_function_of_the_view(size: tuple[int, int]) -> None:
    def seen(view: MachineView) -> str:
        return Program(FakeConsole(now=view, loaded=BOARD, job=MIDDLE), size).text()

    later = replace(VIEW, queued=9, command="KMD_WIERTLO_DOL", axes=(replace(VIEW.axes[0], column=8), *VIEW.axes[1:]))
    assert seen(VIEW) == seen(replace(VIEW)) != seen(later)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "four.drl").write_text("M48\nT1C0.8\n\x07\n")
    (tmp_path / "notes.odt").write_text("no drill file")
    (tmp_path / "older").mkdir()
    (tmp_path / "older" / "five.xln").write_text("M48\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def files_program(console: FakeConsole | None = None, size: tuple[int, int] = (80, 24)) -> Program:
    program = Program(console or FakeConsole(), size)
    program.press("f")
    return program


def test_the_browser_lists_filters_and_previews(folder: Path) -> None:
    program = files_program()
    assert "older/" in program.text() and "four.drl" in program.text() and "notes.odt" not in program.text()
    program.press("down", "down")
    assert "T1C0.8" in program.text()
    program.press("/", *["backspace"] * 80, *"*.odt", "enter")
    assert "notes.odt" in program.text() and "four.drl" not in program.text()


def test_folders_are_entered_and_left(folder: Path) -> None:
    program = files_program()
    program.press("down", "enter")
    assert "five.xln" in program.text()
    program.press("home", "enter")
    assert "four.drl" in program.text()


def test_loading_tells_format_reason_tools_size_estimate_and_warnings(folder: Path) -> None:
    program = files_program(size=(100, 40))
    program.press("down", "down", "enter")
    assert program.console.asked == [("load", str(folder / "four.drl"), Asked())]
    text = program.text()
    for told in ("4 holes, 40.00 x 20.00 mm", "mm decimal (90%): the numbers carry points", "else: inch decimal", "T1",
                 "0.800 mm", "Estimate 0:10", "warning: four.drl:3: no end of program", "a hole twice"):  # fmt: skip
        assert told in text


def test_placing_reads_the_file_anew_and_a_refused_one_changes_nothing(folder: Path) -> None:
    program = files_program()
    program.press("down", "down", "enter", "m", "t")
    assert program.console.asked[-1][2] == Asked(mirror="x", rotate_deg=90.0)
    program.console.answer = ("beyond the reach: X 400 mm",)
    program.press("v", *["backspace"] * 3, *"400 0", "enter")
    assert "beyond the reach" in program.text()
    program.console.answer = ()
    program.press("enter", "r")
    assert program.console.asked[-1][2] == Asked(mirror="x", rotate_deg=90.0, order="nearest")


def test_every_key_of_files_does_something(folder: Path) -> None:
    for name in (name for key in Files.keys for name in key.names):
        program = files_program()
        program.press("down", "down", "enter")
        before, asked = program.canvas(), len(program.console.asked)
        program.press(name)
        after = program.canvas()
        redrawn = list(map(list, after.content())) != list(map(list, before.content()))
        assert redrawn or len(program.console.asked) > asked


def test_every_choice_comes_back_to_its_first_value(folder: Path) -> None:
    for choice in CHOICES:
        program = files_program()
        keys = {key.argument: key.names[0] for key in Files.keys if key.method == "cycle"}
        program.press(*[keys[choice.field]] * len(choice.values), "down", "down", "enter")
        assert program.console.asked == [("load", str(folder / "four.drl"), Asked())]


def test_what_can_not_be_read_is_named(folder: Path) -> None:
    program = files_program(FakeConsole(answer=("four.drl:1: not a drill file",)))
    program.press("down", "down", "enter")
    assert "four.drl:1: not a drill file" in program.text()
    assert isinstance(program.app.loop.widget, urwid.WidgetPlaceholder)


def test_wires_of_the_stand_in_are_the_papers() -> None:
    assert all(len(row) == 12 and set(row) <= {"x", "."} for _name, row, _lit in WIRES)
