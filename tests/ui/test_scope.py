"""The scope on a canvas, upon the run of a real queue."""

from pathlib import Path
from threading import Event

import pytest

from drillctl.cli import main
from drillctl.console.scope_runs import TraceFile
from drillctl.language import Message, words
from drillctl.machine import Library, shipped_tables
from drillctl.ui import background
from drillctl.ui.app import App
from drillctl.ui.screens.scope import Scope
from drillctl.ui.screens.scope_keys import SCOPE_KEYS, SEARCHES
from drillctl.ui.screens.scope_view import LACKS
from drillctl.viewmodel.console import Problems, Watch
from drillctl.viewmodel.scope import ScopeSource
from tests.ui.fake_console import FakeConsole, Program

SQUARE = Path(__file__).resolve().parents[2] / "examples" / "square.kmd"
SIZES = [(80, 24), (160, 50)]
FIRST_STEP = 6  # the tick after which the first column of a move from rest is out


pytestmark = pytest.mark.usefixtures("idle")


@pytest.fixture(scope="module")
def square(tmp_path_factory: pytest.TempPathFactory) -> TraceFile:
    file = tmp_path_factory.mktemp("traces") / "square.trace"
    assert main(["run", str(SQUARE), "--trace", str(file)]) == 0
    source = TraceFile(file, Library.standard())
    while source.notices():
        source.turn()
    return source


class Runs:
    """A RunReading with one run, and a file that can be opened."""

    def __init__(self, source: TraceFile, answer: Problems = ()):
        self.source, self.answer, self.opened = source, answer, [""]

    def running(self) -> ScopeSource:
        return self.source

    def open_trace(self, file: str, watch: Watch) -> tuple[ScopeSource | None, Problems]:
        watch(Message("reading {name}", name=file))
        self.opened.append(file)
        return (None, self.answer) if self.answer else (self.source, ())


class Scoped(Program):
    """The program with the scope in front."""

    def __init__(self, source: TraceFile, size: tuple[int, int] = (80, 24), plain: bool = False, live: bool = False):
        super().__init__(FakeConsole(), size, plain)
        self.runs = Runs(source)
        makers = {"scope": lambda console, shell: Scope(console, shell, self.runs, plain, None if live else source)}
        self.app = App(self.console, plain=plain, terminal=self.paper, makers=makers)
        scope = self.app.show("scope")
        assert isinstance(scope, Scope)
        self.scope = scope
        self.canvas()  # the first frame tells it its size

    def row(self, name: str) -> str:
        lines = [line.strip("│") for line in self.text().splitlines()]  # without the frame of a large terminal
        return next(line for line in lines if line[1:].startswith(f"{name} "))

    def cursor(self) -> int:
        line = next(line for line in self.text().splitlines() if line.startswith(("tick ", "takt ")))
        return int(line.split()[1].rstrip(","))


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("language", words.LANGUAGES)
def test_a_frame_has_names_waves_values_and_the_machine_at_the_cursor(
    square: TraceFile, size: tuple[int, int], language: str
) -> None:
    words.use(language)
    program = Scoped(square, size)
    rows = program.text().splitlines()
    assert len(rows) == size[1] and all(len(row) == size[0] for row in rows)
    text = program.text()
    for told in ("square.trace (pcb-drill)", "500 Hz", "|20", "1 KMD_INICJALIZACJA", words._("at cursor")):
        assert told in text
    assert words._("A and B: not set") in text and "▼" in rows[3] + rows[4]


def test_the_first_wave_of_the_homing_is_drawn_from_the_tick_in_which_it_came(square: TraceFile) -> None:
    program = Scoped(square)
    wave = program.row("x.2a")[12:]
    assert wave.startswith("▁" * (FIRST_STEP + 1) + "▔")
    assert Scoped(square, plain=True).row("x.2a")[12:].startswith("_" * (FIRST_STEP + 1) + "-")


def test_numbers_stand_in_lanes_and_the_values_at_the_right_follow_the_cursor(square: TraceFile) -> None:
    program = Scoped(square)
    assert "0      │-1 │" in program.row("x.state") and program.row("x.state").endswith(" 0")
    program.press(*["right"] * 7)
    assert program.cursor() == 7 and program.row("x.state").endswith("-1")
    assert "X -1, column 11, -1" in program.text()


def test_a_place_is_a_curve_from_far_away_too_and_a_column_is_not(square: TraceFile) -> None:
    program = Scoped(square)
    program.press("w")
    place, column = program.row("x.position")[12:72], program.row("x.column")[12:72]
    assert len(set(place) & set("▁▂▃▄▅▆▇█")) > 4 and "▒" not in place
    assert "▒▒▒" in column and not set(column) & set("▂▃▄▅▆▇")


def test_the_phase_table_stands_beside_with_the_column_of_that_tick(square: TraceFile) -> None:
    program = Scoped(square, (160, 50))
    program.press(*["right"] * 7)
    text = program.text()
    assert "X  column 11, ramp -1 of 3" in text and "xxx......x[x]x" in text and "[2a]" in text


def test_a_plain_terminal_gets_ascii(square: TraceFile) -> None:
    program = Scoped(square, plain=True)
    program.press("w")
    assert program.text().isascii() and "#" in program.row("x.1a") and "v" in program.text().splitlines()[3]


@pytest.mark.parametrize("size", SIZES)
def test_the_whole_run_shows_where_something_moved_and_where_not(square: TraceFile, size: tuple[int, int]) -> None:
    program = Scoped(square, size)
    program.press("w")
    busy, still = program.row("x.1a"), program.row("y.1a")
    assert "▒▒▒" in busy and "▔▔▔" in busy + still and f"ticks 0..{square.last_tick}" in program.text()


def test_every_search_goes_to_its_event_and_back_or_says_that_there_is_none(square: TraceFile) -> None:
    program = Scoped(square)
    for turns, search in enumerate(SEARCHES):
        program.press(*["tab"] * min(turns, 1))
        assert not turns or f"N: {search.on}" in program.text()
        program.press("home", "n")
        found = square.find(search.what, 0, 1, 0)
        assert program.cursor() == (found or 0)
        assert (search.none in program.text()) == (found is None)
        program.press("end", "N")
        assert program.cursor() == (square.find(search.what, square.last_tick, -1, 0) or square.last_tick)
    assert square.find("command", 0, 1, 0) and square.find("sensor", 0, 1, 0)


def test_every_word_is_asked_for_a_tick_that_has_it(square: TraceFile, monkeypatch: pytest.MonkeyPatch) -> None:
    """What a command is called may depend on the job, so on when it was."""
    asked, shown = [], square.shown
    monkeypatch.setattr(square, "shown", lambda *words: (asked.append(words), shown(*words))[1])
    program = Scoped(square, (160, 50))
    for key in ("w", "tab", "tab", "n", *["+"] * 12):
        program.press(key)
        program.canvas()
    assert len(asked) > 1000
    assert all(square.at(tick).values[signal] == value for signal, value, tick in asked)


def test_what_is_not_found_yet_is_a_question_mark(square: TraceFile, monkeypatch: pytest.MonkeyPatch) -> None:
    derived = [row for row, signal in enumerate(square.signals()) if signal.name in ("column", "position", "state")]
    monkeypatch.setattr(square, "known_to", lambda row: 30 if row in derived else square.last_tick + 1)
    program = Scoped(square)
    wave = program.row("x.column")[12:70]
    assert wave.rstrip().lstrip("?") and wave.index("?") == 30 and set(wave[30:]) == {"?"}
    program.press("end")
    assert set(program.row("x.column")[12:70]) == {"?"} and program.row("x.column").endswith("?")
    assert "?" not in program.row("x.1a")


def test_two_marks_tell_ticks_milliseconds_and_hertz_between(square: TraceFile) -> None:
    program = Scoped(square)
    program.press(*["right"] * 10, "[", *["right"] * 25, "]")
    assert "A 10 B 35: 25 ticks, 50 ms, 20 Hz" in program.text()
    ruler = program.text().splitlines()[3]
    assert ruler[12 + 10] == "A" and "▼" in ruler  # B stands under the cursor
    program.press("left")
    assert program.text().splitlines()[3][12 + 35] == "B"
    program.press("right", "]", "[")
    assert "A 35" in program.text() and "B 35" not in program.text()


def test_zooming_by_keys_and_wheel_keeps_what_is_pointed_at(square: TraceFile) -> None:
    program = Scoped(square)
    program.press(*["right"] * 20, "-", "-")
    assert program.cursor() == 20 and "a cell: 5 ticks, 10 ms" in program.text()
    program.press("w", ("mouse press", 1, 40, 8))
    there = program.cursor()
    assert there > 1000
    program.press(("mouse press", 4, 40, 8))
    assert program.cursor() == there and program.text().splitlines()[3][40] == "▼"


def test_a_click_moves_the_bar_too_and_one_on_a_name_does_nothing(square: TraceFile) -> None:
    program = Scoped(square)
    program.press(("mouse press", 1, 30, 9))
    assert program.text().splitlines()[9].startswith(">x.24a") and program.cursor() == 18
    program.press(("mouse press", 1, 3, 12))
    assert program.cursor() == 18


def test_rows_are_hidden_isolated_scrolled_and_shown_again(square: TraceFile) -> None:
    program = Scoped(square)
    program.press("down", "delete")
    assert "x.1a" not in program.text() and ">x.1b" in program.text()
    program.press("enter")
    assert "y.1a" not in program.text() and "x.state" in program.text() and "x.1a" in program.text()
    program.press("insert", *["page down"] * 9)
    assert ">fault" in program.text() and "command" not in program.row("fault")


def test_a_fault_is_named_whole_at_the_foot_wherever_its_row_is(tmp_path: Path) -> None:
    queue, file = tmp_path / "q.kmd", tmp_path / "q.trace"
    queue.write_text("KMD_CZEKAJ 5\nKMD_GOTO_X_Y 10 10\n")
    assert main(["run", str(queue), "--trace", str(file)]) == 1
    program = Scoped(TraceFile(file, Library((shipped_tables(),))))
    assert "HOMING_REQUIRED" not in program.text()
    program.press(*["tab"] * 6, "n")
    assert "HOMING_REQUIRED" in program.text() and "run.fault" not in program.text()


def test_going_to_a_typed_tick_and_to_one_that_is_none(square: TraceFile) -> None:
    program = Scoped(square)
    program.press("g", "backspace", *"5000", "enter")
    assert program.cursor() == 5000
    program.press("g", *["backspace"] * 9, *"soon", "enter")
    assert "a tick is a whole number, not 'soon'" in program.text() and program.cursor() == 5000


def test_a_live_run_is_followed_until_the_cursor_is_moved(square: TraceFile, monkeypatch: pytest.MonkeyPatch) -> None:
    end = square.last_tick
    monkeypatch.setattr(square, "last_tick", 1000)
    program = Scoped(square, live=True)
    assert program.cursor() == 1000 and "following" in program.text()
    square.last_tick = 1500
    program.app.turn()
    assert program.cursor() == 1500
    program.press("left")
    square.last_tick = end
    program.app.turn()
    assert program.cursor() == 1499 and "following" not in program.text()
    program.press(" ")
    assert program.cursor() == end and "following" in program.text()


def test_a_run_out_of_a_file_does_not_go_on_and_is_not_followed(square: TraceFile) -> None:
    program = Scoped(square)
    program.press(" ")
    assert program.cursor() == square.last_tick and "following" not in program.text()


def test_a_run_without_a_tick_says_so_and_takes_every_key(square: TraceFile, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(square, "last_tick", -1)
    program = Scoped(square, live=True)
    assert "Nothing was run yet." in program.text()
    for name in (name for key in SCOPE_KEYS for name in key.names if name not in ("g", "ctrl o")):
        program.press(name)
    assert "Nothing was run yet." in program.text()


def test_a_run_is_opened_at_the_tick_that_was_asked_for(square: TraceFile, monkeypatch: pytest.MonkeyPatch) -> None:
    assert Scoped(square).cursor() == 0
    monkeypatch.setattr(square, "opening_tick", 4321)
    program = Scoped(square)
    assert program.cursor() == 4321


PATIENCE_S = 60.0


def test_another_file_is_opened_or_refused_with_its_reason(square: TraceFile, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "SHOWN_AFTER_S", PATIENCE_S)
    program = Scoped(square, live=True)
    program.press("ctrl o", *"a.trace", "enter")
    assert program.runs.opened[-1] == "a.trace" and "following" not in program.text() and program.cursor() == 0
    program.runs.answer = ("a.trace:3: torn",)
    program.press("right", "ctrl o", "enter")
    assert "a.trace:3: torn" in program.text()
    program.press("enter")
    assert program.cursor() == 1
    program.press("f6")
    assert "1   the machine's own run" in program.text()
    program.press("1")
    assert "following" in program.text()
    program.press("f6")
    assert "1 * the machine's own run" in program.text()
    program.press("2", *"b.trace", "enter")
    assert program.runs.opened[-1].endswith("b.trace")


@pytest.mark.parametrize("wanted", [True, False], ids=["waited for", "given up"])
def test_a_long_file_is_read_beside_the_screen(
    square: TraceFile, monkeypatch: pytest.MonkeyPatch, wanted: bool
) -> None:
    """Until it is read, and where it is given up, the scope shows the run of before."""
    monkeypatch.setattr(background, "SHOWN_AFTER_S", 0.0)
    program, half, go_on = Scoped(square, live=True), Event(), Event()

    def read(file: str, watch: Watch) -> tuple[ScopeSource | None, Problems]:
        advance = watch(Message("reading {name}", name=file))
        advance(1, 2)
        half.set()
        assert go_on.wait(PATIENCE_S)
        advance(2, 2)
        return square, ()

    monkeypatch.setattr(program.runs, "open_trace", read)
    program.press("ctrl o", *"long.trace", "enter")
    assert half.wait(PATIENCE_S)
    program.app.turn()
    assert "reading long.trace: 50%" in program.text()
    if not wanted:
        program.press("esc")
    go_on.set()
    task = program.app._background._task
    assert task is not None
    task.join(PATIENCE_S)
    program.app.turn()
    assert "reading" not in program.text() and ("following" in program.text()) is not wanted


def test_it_is_opened_from_the_menu(square: TraceFile) -> None:
    program = Scoped(square)
    program.app.back()
    program.press("meta t", "c", "t")
    assert "square.trace" in program.text()
    program.press("meta t", "c", "o")
    assert "Open a trace" in program.text()


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_the_help_tells_of_every_key_and_no_key_is_told_twice(square: TraceFile, language: str) -> None:
    words.use(language)
    program = Scoped(square, (80, 70))
    program.press("f1")
    text = program.text()
    for key in SCOPE_KEYS:
        assert f"{words._(key.printed):<12}{words._(key.help)}"[:66] in text
    names = [name for key in SCOPE_KEYS for name in key.names]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_what_a_run_lacks_is_said_in_the_operators_language(
    square: TraceFile, monkeypatch: pytest.MonkeyPatch, language: str
) -> None:
    from drillctl.viewmodel.scope import Notice

    words.use(language)
    monkeypatch.setattr(square, "notices", lambda: tuple(Notice(lack, 7) for lack in LACKS))
    text = Scoped(square, (160, 50)).text()
    assert all(words._(told).format(value=7) in text for told in LACKS.values())


def test_a_row_of_numbers_becomes_a_curve_with_its_speed_and_numbers_again(square: TraceFile) -> None:
    program = Scoped(square)
    places = [(signal.group, signal.name) for signal in square.signals()]
    program.press("w", *["down"] * places.index(("x", "position")), "y")
    assert "steps/s" in program.text() and "x.position" in program.text()
    program.press("y")
    assert "steps/s" not in program.text()
    program.press("up", *["up"] * 9, "y")
    assert "steps/s" not in program.text()


def test_a_large_window_draws_positions_as_curves_from_the_beginning(square: TraceFile) -> None:
    assert "steps/s" in Scoped(square, (220, 60)).text() and "steps/s" not in Scoped(square, (160, 50)).text()


def test_a_command_is_searched_by_its_text_and_a_missing_one_is_said(square: TraceFile) -> None:
    program = Scoped(square)
    program.press("home", "/", *"inicj", "enter")
    assert "KMD_INICJALIZACJA" in program.text()
    program.press("/", *["backspace"] * 5, *"nothing", "enter")
    assert "no further command with 'nothing' in it" in program.text()
