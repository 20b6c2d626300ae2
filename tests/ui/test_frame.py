"""The frame: bar, menus, dialogs, keys, and the emergency stop that nothing hides."""

from pathlib import Path

import pytest
import urwid
from msgspec.structs import replace

from drillctl.language import words
from drillctl.ui import preferences
from drillctl.ui.app import BEAT_S, REST_BEAT_S
from drillctl.ui.pcb_drill.drilling import Drilling
from drillctl.ui.pcb_drill.files import Files
from drillctl.ui.pcb_drill.menus import MENUS
from drillctl.ui.widgets.keys import FRAME_KEYS, Key, called
from drillctl.ui.widgets.menus import Item, hot_letter, plain_label
from drillctl.ui.widgets.themes import ATTRIBUTES, DEFAULT_THEME, THEMES, depth_of, palette
from drillctl.ui.widgets.windows import Window
from tests.ui.fake_console import BOARD, FAULT, VIEW, FakeConsole, Program

SIZES = [(80, 24), (160, 50), (50, 15)]


pytestmark = pytest.mark.usefixtures("idle")


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("size", SIZES)
def test_the_first_frame_fills_the_terminal(language: str, size: tuple[int, int]) -> None:
    words.use(language)
    program = Program(FakeConsole(loaded=BOARD), size)
    rows = program.text().splitlines()
    assert len(rows) == size[1] and all(len(row) == size[0] for row in rows)
    assert all(plain_label(menu) in rows[0] for menu in MENUS)
    assert "pcb-drill" in rows[1] and "F10" in "".join(rows[-5:])


def test_polish_labels_are_the_papers() -> None:
    words.use("pl")
    program = Program(FakeConsole())
    assert program.text().splitlines()[0].split()[:4] == ["Zbiory", "Wiercenie", "Testy", "Konfiguracja"]
    program.press("f9", "right")
    assert all(label in program.text() for label in ("Start", "Bazowanie", "Inicjalizacja"))


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_hot_letters_differ_within_a_menu(language: str) -> None:
    words.use(language)

    def check(items: tuple[Item, ...]) -> None:
        letters = [hot_letter(item) for item in items]
        assert all(letters) and len(set(letters)) == len(letters), letters
        for item in items:
            if item.items:
                check(item.items)

    check(MENUS)


def leaves(items: tuple[Item, ...], path: tuple[Item, ...] = ()) -> list[tuple[Item, ...]]:
    return [leaf for item in items for leaf in (leaves(item.items, (*path, item)) if item.items else [(*path, item)])]


@pytest.mark.parametrize("path", leaves(MENUS), ids=lambda path: "/".join(plain_label(item) for item in path))
def test_every_entry_of_the_menus_answers(
    path: tuple[Item, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By its hot letters; what a screen is not there for says so. One of them keeps a picture in this folder."""
    monkeypatch.chdir(tmp_path)
    program = Program(FakeConsole(loaded=BOARD))
    before = program.text()
    if path[-1].method == "leave":
        with pytest.raises(urwid.ExitMainLoop):
            program.press(f"meta {hot_letter(path[0])}", *map(hot_letter, path[1:]))
        return
    program.press(f"meta {hot_letter(path[0])}", *map(hot_letter, path[1:]))
    if path[-1].method != "set_theme":
        assert program.text() != before or program.console.asked
    assert "Not here" in program.text() or path[-1].screen in ("", "files", "drilling")


def test_a_click_opens_a_menu_and_one_beside_closes_it() -> None:
    program = Program(FakeConsole())
    program.press(("mouse press", 1, 10, 0))
    assert "Initialisation" in program.text()
    program.press(("mouse press", 1, 70, 20))
    assert "Initialisation" not in program.text()
    program.press(("mouse press", 1, 10, 0), ("mouse press", 1, 12, 8))
    assert program.console.asked == [("initialise",)] and "Acknowledge" not in program.text()


@pytest.mark.parametrize("key", ["f10", "!"])
@pytest.mark.parametrize("first", [[], ["f9"], ["f9", "down", "enter"], ["f1"], ["t"], ["f", "/"], ["f4"]])
def test_the_emergency_stop_is_live_everywhere(key: str, first: list[str]) -> None:
    program = Program(FakeConsole(now=replace(VIEW, moving=True), loaded=BOARD))
    program.press(*first)
    program.press(key)
    assert program.console.asked[-1] == ("emergency_stop",)
    assert "EMERGENCY_STOP" in program.text()


def test_a_position_that_was_not_known_is_not_told_as_lost() -> None:
    program = Program(FakeConsole(now=replace(VIEW, position_known=False)))
    program.console.now = replace(VIEW, position_known=False, condition="latched", fault=FAULT)
    program.app.turn()
    assert "position not known: initialise" in program.text() and "position lost" not in program.text()


@pytest.mark.parametrize(("said", "rows"), [("short", 1), ("a word that is longer than what is left of the line", 2)])
def test_a_word_that_is_said_leaves_the_next_step_where_it_can_be_read(said: str, rows: int) -> None:
    program = Program(FakeConsole(now=replace(VIEW, position_known=False)), (80, 24))
    program.app.say(said)
    found = [row for row in program.text().splitlines() if said in row or " Next " in row]
    assert len(found) == rows and said in found[0] and "open" in found[-1]


def test_a_line_on_the_machine_that_is_cut_says_so() -> None:
    view = replace(VIEW, machine="a-machine-with-a-name-of-sixty-characters-as-nobody-has-it")
    program = Program(FakeConsole(now=view), (80, 24))
    line = program.text().splitlines()[1]
    assert "a-machine" in line and "… | " in line and "position known" in line


def test_a_fault_is_told_once_and_acknowledged() -> None:
    program = Program(FakeConsole(now=replace(VIEW, condition="latched", fault=FAULT)))
    program.app.turn()
    text = program.text()
    assert all(part in text for part in ("somebody pressed it", "look why", "position lost"))
    program.press("enter")
    assert program.console.asked == [("acknowledge",)] and "look why" not in program.text()


def test_nothing_typed_with_an_emergency_stop_reaches_the_machine() -> None:
    """An Enter in the same breath would acknowledge it."""
    program = Program(FakeConsole(now=replace(VIEW, condition="latched", fault=FAULT)))
    program.app.turn()
    program.press("enter", "f10", "i")
    assert program.console.asked == [("emergency_stop",)]


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("screen", [Drilling, Files])
def test_the_help_tells_of_every_key(screen: type[Drilling | Files], language: str) -> None:
    words.use(language)
    program = Program(FakeConsole(), (80, 80))
    program.press(*(["f"] if screen is Files else []), "f1")
    text = program.text()
    for key in (*screen.keys, *FRAME_KEYS):
        assert f"{words._(key.printed):<12}{words._(key.help)}" in text


@pytest.mark.parametrize("state", [{"moving": True}, {"at_work": True}], ids=["moves", "held, or waiting for a tool"])
def test_leaving_asks_only_while_the_machine_is_at_work(state: dict[str, bool]) -> None:
    with pytest.raises(urwid.ExitMainLoop):
        Program(FakeConsole()).press("f4")
    program = Program(FakeConsole(now=replace(VIEW, **state)))
    program.press("f4")
    assert "at work. Stop it" in program.text()
    program.press("enter")
    assert "at work. Stop it" not in program.text()
    with pytest.raises(urwid.ExitMainLoop):
        program.press("f4", "right", "enter")


class Draft(urwid.SolidFill):
    """A screen with something in it that is not saved."""

    title, changed = "A draft", True


@pytest.mark.parametrize("buried", [False, True])
def test_leaving_asks_about_what_is_not_saved(buried: bool) -> None:
    program = Program(FakeConsole())
    draft = Draft()
    program.app.open(draft)
    if buried:
        program.app.show("drilling")
    program.press("f4", "enter")
    program.press("f4")
    assert "Not saved: A draft" in program.text()
    with pytest.raises(urwid.ExitMainLoop):
        program.press("right", "enter")
    draft.changed = False
    with pytest.raises(urwid.ExitMainLoop):
        program.press("f4")


def test_a_smaller_terminal_keeps_dialogs_within() -> None:
    program = Program(FakeConsole(), (160, 50))
    program.press("f1")
    program.paper.size = (60, 16)
    program.press("window resize")
    rows = program.text().splitlines()
    assert len(rows) == 16 and all(len(row) == 60 for row in rows) and "PgDn" in program.text()


def test_another_machine_is_chosen_from_a_list() -> None:
    program = Program(FakeConsole())
    program.press("meta c", "m", "down", "enter")
    assert program.console.asked == [("choose_machine", "boiler-drum")]
    program.console.answer = ("the machine is at work",)
    program.press("meta c", "m", "enter")
    assert "the machine is at work" in program.text()


@pytest.mark.parametrize("theme", THEMES)
def test_a_theme_has_every_attribute(theme: str) -> None:
    entries = palette(theme)
    assert [name for name, *_ in entries] == [None, *ATTRIBUTES]  # None: what has no role
    screen = urwid.display.raw.Screen()
    screen.register_palette(entries)  # raises for a colour that there is not
    for depth in (1, 16, 256, 2**24):
        screen.set_terminal_properties(depth)


ENVIRONMENTS = [
    ({}, 16), ({"TERM": "xterm"}, 16), ({"TERM": "linux"}, 16), ({"TERM": "screen-256color"}, 256),
    ({"TERM": "xterm", "COLORTERM": "truecolor"}, 2**24), ({"TERM": "tmux-256color", "COLORTERM": "24bit"}, 2**24),
    ({"TERM": "vt100"}, 1), ({"TERM": "xterm", "COLORTERM": "truecolor", "NO_COLOR": "1"}, 1),
    ({"TERM": "xterm-256color", "NO_COLOR": ""}, 256),
]  # fmt: skip


@pytest.mark.parametrize(("environment", "depth"), ENVIRONMENTS, ids=str)
def test_a_terminal_has_the_colours_that_it_says(environment: dict[str, str], depth: int) -> None:
    assert depth_of(environment) == depth


def test_a_theme_is_kept_for_the_next_start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert preferences.chosen_theme({}) == DEFAULT_THEME
    preferences.keep_theme("dark")
    assert preferences.chosen_theme({}) == "dark" and preferences.chosen_theme({"NO_COLOR": "1"}) == "mono"
    for damaged in ("theme = 'puce'", "theme = [1]", "theme", "\xff"):
        preferences.file().write_text(damaged, "latin-1")
        assert preferences.chosen_theme({}) == DEFAULT_THEME


def test_a_theme_chosen_on_the_menu_is_in_force_and_kept() -> None:
    kept: list[str] = []
    program = Program(FakeConsole())
    program.app._keep_theme = kept.append
    program.press("meta c", "c", "h")
    assert kept == ["contrast"] and "FAULT" not in program.text()


@pytest.mark.parametrize(("plain", "lines"), [(False, "┌─┐│└┘"), (True, "+-|")], ids=["UTF-8", "ASCII"])
@pytest.mark.parametrize("size", [(100, 32), (160, 50), (220, 60)], ids=str)
def test_windows_have_borders_that_the_terminal_can_show(size: tuple[int, int], plain: bool, lines: str) -> None:
    text = Program(FakeConsole(loaded=BOARD), size, plain).text()
    assert all(sign in text for sign in lines)
    assert not plain or text.isascii()
    Program(FakeConsole())  # sets the lines of light again


def test_a_small_terminal_gives_no_row_to_a_border() -> None:
    rows = Program(FakeConsole(loaded=BOARD), (80, 24)).text().splitlines()
    assert rows[1].startswith(" Drilling") and rows[1].endswith("──") and "Hole" in rows[2]


@pytest.mark.parametrize(
    ("size", "windows"),
    [((80, 24), 0), ((100, 32), 2), ((160, 50), 5), ((220, 60), 5)], ids=str,
)  # fmt: skip
def test_each_size_of_terminal_has_its_windows(size: tuple[int, int], windows: int) -> None:
    assert Program(FakeConsole(loaded=BOARD), size).text().count("┌ ") == windows


def test_the_first_screen_stays_the_lowest() -> None:
    program = Program(FakeConsole(loaded=BOARD))
    assert "Esc Back" not in program.text()
    program.press("f", "meta d", "a")
    assert isinstance(program.app.screens[-1], Drilling) and "Esc Back" in program.text()
    program.press("esc")
    assert isinstance(program.app.screens[-1], Files) and "Esc Back" in program.text()
    program.press("esc")
    assert program.app.screens == [program.app.frame.screen] and isinstance(program.app.frame.screen, Drilling)


class Hands:
    def __init__(self) -> None:
        self.done: list[str] = []

    def stop(self) -> None:
        self.done.append("stop")

    def search(self, way: str) -> None:
        self.done.append(way)


@pytest.mark.parametrize(
    ("pressed", "done"), [("x", ["stop"]), ("X", ["stop"]), ("n", ["on"]), ("N", ["back"]), ("Q", [])]
)
def test_a_capital_is_its_letter_unless_it_has_a_row(pressed: str, done: list[str]) -> None:
    """With Caps Lock on, X must stop the machine all the same."""
    hands = Hands()
    keys = (
        Key(("x",), "X", "stop", ""),
        Key(("n",), "N", "search", "", "", "on"),
        Key(("N",), "", "search", "", "", "back"),
    )
    assert called(hands, keys, pressed) is bool(done)
    assert hands.done == done


def test_a_screen_on_which_nothing_changes_is_not_drawn_again() -> None:
    """The terminal is sent what differs from the canvas before: nothing for the same one."""
    program = Program(FakeConsole(loaded=BOARD), (160, 50))
    program.app.turn()
    before = program.canvas()
    program.app.turn()
    assert program.canvas() is before
    program.console.now = replace(VIEW, moving=True)
    program.app.turn()
    assert program.canvas() is not before


def test_a_click_in_a_window_counts_from_inside_its_border() -> None:
    clicks: list[tuple[int, int]] = []

    class Inside(urwid.SolidFill):
        def mouse_event(self, size: object, event: str, button: int, col: int, row: int, focus: bool) -> bool:
            clicks.append((col, row))
            return True

    window = Window(Inside(), "title")
    window.mouse_event((10, 5), "mouse press", 1, 9, 4, True)
    window.show(framed=True)
    for place in ((0, 0), (9, 4), (1, 1), (8, 3)):
        window.mouse_event((10, 5), "mouse press", 1, *place, True)
    assert clicks == [(9, 4), (0, 0), (7, 2)]


@pytest.mark.parametrize("title", ["", "short", "longer than the window is wide"])
@pytest.mark.parametrize("size", [(1, 1), (2, 9), (3, 3), (12, 4)])
def test_a_window_has_exactly_the_size_it_is_given(size: tuple[int, int], title: str) -> None:
    window = Window(urwid.SolidFill("x"), title)
    window.show(framed=True)
    canvas = window.render(size)
    assert (canvas.cols(), canvas.rows()) == size
    assert "x" in "".join(row.decode() for row in canvas.text)


def test_the_beat_after_a_start_is_one_of_a_machine_at_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """A desk that is silent for a beat at rest would nearly be taken for lost by a machine that has begun to move."""
    program = Program(FakeConsole())
    app, waits = program.app, list[float]()
    app._interrupts = ()
    monkeypatch.setattr(app.loop, "set_alarm_in", lambda seconds, _beat: waits.append(seconds) or len(waits))
    monkeypatch.setattr(app.loop, "remove_alarm", lambda _handle: waits.pop())
    app._beat(app.loop)
    assert waits == [REST_BEAT_S]
    program.console.now = replace(VIEW, moving=True)
    app._beat(app.loop)
    app._beat(app.loop)
    assert waits == [REST_BEAT_S, BEAT_S, BEAT_S]
