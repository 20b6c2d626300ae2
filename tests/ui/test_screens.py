"""Files and Drilling on a canvas, upon a console that keeps what it was asked."""

from pathlib import Path

import numpy as np
import pytest
import urwid
from msgspec.structs import replace

from drillctl.language import words
from drillctl.language.number_text import pair_mm
from drillctl.ui.models.board_work import Work
from drillctl.ui.pcb_drill.drilling import Drilling
from drillctl.ui.pcb_drill.drilling_windows import FIRST_WORDS
from drillctl.ui.pcb_drill.files import CHOICES, Files
from drillctl.ui.pcb_drill.side_window import side_pages
from drillctl.ui.screens.board_view import BoardPicture
from drillctl.ui.screens.jog_controls import JOG_SIZES, MM, STEPS
from drillctl.ui.widgets.keys import STOP
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import MachineView, ToolWanted
from drillctl.viewmodel.job_options import JobOptions
from drillctl.viewmodel.records import Progress
from tests.ui.fake_console import BOARD, VIEW, WIRES, FakeConsole, Program

MIDDLE = Progress(2, 4, 1, 2500, 5.0, 5.0)


pytestmark = pytest.mark.usefixtures("idle")


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
OPENING = {"s": "Drill 4 holes of four.drl?", "f": "../", "g": "Number, 1 to 4:", "t": "X and Y in mm", "+": "step 120",
           "=": "step 120", "-": "step 3", "*": "jog step 1 mm", "c": "no tool is waited for",
           "e": "board blinker.drl", "z": "zoom 2", "Z": "zoom 1", "w": "the whole board", "y": "tool numbers",
           **{f"shift {way}": "the whole board is seen" for way in ("left", "right", "up", "down")}}  # fmt: skip


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
    assert {name for key in Drilling.keys for name in key.names} == {*dict(REQUESTS), *OPENING, "tab"} - {*STOP.names}


def test_drilling_without_a_board_says_how_one_is_opened() -> None:
    program = Program(FakeConsole())
    assert "F opens a drill file." in program.text()
    program.press("f")
    assert "F opens a drill file." not in program.text() and "Enter loads the file" in program.text()


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_the_first_steps_stand_whole_on_the_first_screen(language: str) -> None:
    words.use(language)
    rows = Program(FakeConsole()).text().splitlines()
    left = [row.partition("│")[0].rstrip() for row in rows]
    assert [line for line in FIRST_WORDS if line and f" {words._(line)}" not in left] == []


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
    assert program.console.asked == [("jog", "x", JOG_SIZES[STEPS][-1]), ("jog", "x", JOG_SIZES[STEPS][0])]


def test_step_sizes_in_millimetres_are_the_axis_s_steps_and_each_unit_keeps_its_size() -> None:
    program = Program(FakeConsole())
    program.press("*", "right", "-", "right", "+", "+", "up", "*", "right")
    assert program.console.asked == [("jog", "x", 47), ("jog", "x", 5), ("jog", "y", 472), ("jog", "x", 12)]
    assert JOG_SIZES[MM] == (0.1, 1, 10)


def test_the_interrupt_frequency_is_typed_under_configuration() -> None:
    program = Program(FakeConsole())
    program.press("f9", *["right"] * 3, "f", *"580", "enter")
    assert program.console.asked == [("set_tick_hz", 580)]
    assert "580 ticks a second; the position is kept" in program.text()
    program.press("f9", *["right"] * 3, "f", *"fast", "enter")
    assert "not 'fast'" in program.text() and len(program.console.asked) == 1


def test_going_to_a_hole_and_to_a_typed_place() -> None:
    program = Program(FakeConsole(loaded=BOARD))
    program.press("g", "3", "enter")  # instead of the 1 that was proposed
    program.press("t", *["backspace"] * 3, *"12,7 -3.5", "enter")
    assert program.console.asked == [("go_to", 40.0, 20.0), ("go_to", 12.7, -3.5)]
    program.press("g", "9", "enter")
    assert "there is no hole '9'" in program.text() and len(program.console.asked) == 2


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
    (page,) = side_pages(view, MIDDLE, BOARD, columns, rows)[:1]
    lines = plain_text(page)
    text = "\n".join(lines)
    assert len(lines) <= rows and max(map(len, lines)) <= columns
    for told in ("3.175", "KMD_GOTO_X_Y 1559 0", "0:05", "T1 0.800 mm", "[x_min]", " x_max ", "500 Hz", "1.5 ms"):
        assert told in text
    assert words._("Lost") in text and "+3" in text


def test_the_whole_table_stands_where_there_is_room_with_its_column_marked() -> None:
    (page,) = side_pages(VIEW, None, None, 48, 46)
    lines = plain_text(page)
    assert lines.count("   [1a]    xxxxxx[.].....") == 3 and lines.count("    1b     ......|x|xxxxx") == 3
    small = plain_text(side_pages(VIEW, None, None, 36, 18)[0])
    assert "X   7 +3 [1a] 1b [24a]" in small


@pytest.mark.parametrize(("columns", "rows"), [(36, 17), (36, 5), (36, 1), (48, 43)])
def test_eight_axes_have_all_their_lines_on_one_page_or_another(columns: int, rows: int) -> None:
    names = ("x", "y", "z1", "z2", "z3", "z4", "z5", "z6")
    sensors = tuple((f"{name}_home", name == "z5") for name in names)
    many = replace(VIEW, axes=tuple(replace(VIEW.axes[0], name=name) for name in names), sensors=sensors)
    pages = [plain_text(page) for page in side_pages(many, MIDDLE, BOARD, columns, rows)]
    assert all(0 < len(page) <= rows for page in pages)
    assert all(page[0].endswith(f"{n}/{len(pages)} Tab") for n, page in enumerate(pages, start=1))
    text = "\n".join(line for page in pages for line in page)
    assert "500 Hz" in text and "[z5_home]" in text and text.count("column 7, ramp +3 of 3") == len(names)
    assert rows < 17 or "500 Hz" in "\n".join(pages[0]), "late ticks are seen without turning a page"


def test_tab_turns_the_pages_round() -> None:
    program = Program(FakeConsole(now=replace(VIEW, axes=VIEW.axes[:1] * 8)))
    first = program.text()
    count = int(first.split("1/")[1].split(" Tab")[0])
    seen = [first]
    for _ in range(count):
        program.press("tab")
        seen.append(program.text())
    assert count > 1 and seen[-1] == first and len(set(seen)) == count


def signs_of(picture: BoardPicture, size: tuple[int, int] = (20, 6)) -> str:
    return "\n".join(row.decode() for row in picture.render(size).text)


@pytest.mark.parametrize(("plain", "signs"), [(False, "○◎+"), (True, "o@+.")])
def test_done_current_to_do_and_head_differ_without_colour(plain: bool, signs: str) -> None:
    picture = BoardPicture(plain)
    picture.show(BOARD, Work(2, current=2), head_mm=(20.0, 10.0))
    text = signs_of(picture)
    assert all(sign in text for sign in signs)
    assert text.count(signs[0]) == 2 and text.count(signs[1]) == 1 and text.count("+") == 1
    assert not plain or text.isascii()


def test_a_cell_with_holes_to_do_is_not_shown_as_done() -> None:
    crowded = replace(BOARD, xy_mm=np.array([[0.0, 0.0], [0.5, 0.0], [100.0, 0.0], [0.0, 50.0]]))
    picture = BoardPicture()
    picture.show(crowded, Work(1))
    assert "○" not in signs_of(picture)
    picture.show(crowded, Work(2))
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
    program = files_program(size=(130, 40))
    program.press("down", "down", "enter")
    assert program.console.asked == [("load", str(folder / "four.drl"), JobOptions())]
    text = program.text()
    for told in ("4 holes, 40.00 x 20.00 mm", "Excellon decimal, mm decimal (90%): the numbers carry points",
                 "else: inch decimal", "T1", "0.800 mm", "Estimate 0:10", "warning: four.drl:3: no end of program",
                 "a hole twice"):  # fmt: skip
        assert told in text


def test_placing_reads_the_file_anew_and_a_refused_one_changes_nothing(folder: Path) -> None:
    program = files_program()
    program.press("down", "down", "enter", "m", "r")
    assert program.console.asked[-1][2] == JobOptions(mirror="x", rotate_deg=90.0)
    program.console.answer = ("beyond the reach: X 400 mm",)
    program.press("v", *["backspace"] * 3, *"400 0", "enter")
    assert "beyond the reach" in program.text()
    program.console.answer = ()
    program.press("enter", "#")
    assert program.console.asked[-1][2] == JobOptions(mirror="x", rotate_deg=90.0, order="nearest")


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
        assert program.console.asked == [("load", str(folder / "four.drl"), JobOptions())]


def test_what_can_not_be_read_is_named(folder: Path) -> None:
    program = files_program(FakeConsole(answer=("four.drl:1: not a drill file",)))
    program.press("down", "down", "enter")
    assert "four.drl:1: not a drill file" in program.text()
    assert isinstance(program.app.loop.widget, urwid.WidgetPlaceholder)


def test_wires_of_the_stand_in_are_the_papers() -> None:
    assert all(len(row) == 12 and set(row) <= {"x", "."} for _name, row, _lit in WIRES)


WAITING = replace(VIEW, tool_wanted=ToolWanted(2, 1.0, 1.05))


@pytest.mark.parametrize("size", [(80, 24), (160, 50)])
@pytest.mark.parametrize("language", words.LANGUAGES)
def test_the_tool_that_is_waited_for_is_told_on_any_screen(language: str, size: tuple[int, int]) -> None:
    words.use(language)
    program = Program(FakeConsole(loaded=BOARD), size)
    program.press("f")
    program.console.now = WAITING
    program.app.turn()
    text = program.text()
    assert "T2, 1.000 mm" in text and "1.050 mm" in text and words._("It is in") in text
    assert words._("Stop") in text and words._("Hold") in text


@pytest.mark.parametrize(
    ("keys", "asked"),
    [
        (["enter"], []),
        (["esc"], []),
        (["right", "enter"], [("tool_changed",)]),
        (["c"], [("tool_changed",)]),
        (["right", "right", "enter"], [("hold",)]),
        (["right", "right", "right", "enter"], [("stop",)]),
        (["f10"], [("emergency_stop",)]),
    ],
)
def test_an_answer_to_the_tool_change_is_what_is_asked(keys: list[str], asked: list[tuple[object, ...]]) -> None:
    program = Program(FakeConsole(now=WAITING, loaded=BOARD))
    program.press(*keys)
    assert program.console.asked == asked


def test_not_yet_leaves_the_machine_at_the_keys_and_c_answers_later() -> None:
    program = Program(FakeConsole(now=WAITING, loaded=BOARD))
    program.press("enter", " ")
    assert program.console.asked == [("hold",)] and "mm is wanted: put it in, then C" in program.text()
    program.press("c", "enter", "c", "right", "enter")
    assert program.console.asked[1:] == [("tool_changed",)] and "is wanted" not in program.text()


def test_a_tool_change_settled_otherwise_takes_its_box_away() -> None:
    program = Program(FakeConsole(now=WAITING))
    assert "Not yet" in program.text()
    program.console.now = VIEW
    program.app.turn()
    assert "Not yet" not in program.text() and program.app.layers.top is None
