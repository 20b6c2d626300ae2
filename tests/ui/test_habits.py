"""What works everywhere: any action found by its words, the screen kept as a picture, a terminal that is too small."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.language import words
from drillctl.ui.layers import LEAST
from drillctl.ui.palette import actions
from drillctl.ui.pcb_drill.examples import boards
from drillctl.ui.pcb_drill.menus import MENUS
from drillctl.ui.widgets.finder import Found, fits, fitting
from drillctl.ui.widgets.keys import FRAME_KEYS
from drillctl.ui.widgets.menus import Item
from drillctl.ui.widgets.themes import THEMES, shades
from drillctl.viewmodel.job_options import JobOptions
from tests.ui.fake_console import BOARD, VIEW, FakeConsole, Program
from tests.ui.whole import Watched, at_home

README = Path(__file__).resolve().parents[2] / "README.md"
NAMES = ["BLINKER.drl", "a[1].drl", "notes.txt"]

pytestmark = pytest.mark.usefixtures("idle")


def leaves(items: tuple[Item, ...]) -> list[Item]:
    return [leaf for item in items for leaf in (leaves(item.items) if item.items else [item])]


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_every_action_of_menus_and_keys_is_found_by_its_own_words(language: str) -> None:
    words.use(language)
    program = Program(FakeConsole())
    top = program.app.screens[-1]
    found = actions(MENUS, top, [])
    lines = [action.found for action in found]
    assert {id(action.does) for action in found} >= {*map(id, leaves(MENUS)), *map(id, top.keys), *map(id, FRAME_KEYS)}
    for index, action in enumerate(found):
        for text in action.found.known_by:
            assert index in fitting(lines, " ".join(text.split()[-2:])), text


@pytest.mark.parametrize(
    ("language", "typed", "asked"),
    [
        ("en", "initialisation", ("initialise",)), ("pl", "inicjal", ("initialise",)),
        ("pl", "initialisation", ("initialise",)), ("en", "run dry", ("start", True)),
    ],
)  # fmt: skip
def test_an_action_is_found_in_both_languages_and_done(language: str, typed: str, asked: tuple[object, ...]) -> None:
    words.use(language)
    program = Program(FakeConsole(loaded=BOARD))
    program.press("ctrl p", *typed, "enter")
    assert program.console.asked == [asked]
    assert program.app.layers.top is None


def test_an_action_of_another_screen_opens_it() -> None:
    program = Program(FakeConsole())
    program.press("f", "esc", "ctrl p", *"order holes", "enter")
    assert type(program.app.screens[-1]).__name__ == "Files"


def test_the_finder_says_how_many_fit_and_does_nothing_where_none_does() -> None:
    program = Program(FakeConsole())
    program.press("ctrl p", *"xyzzyq")
    assert "0 of " in program.text()
    program.press("enter", "down", "esc")
    assert not program.console.asked and program.app.layers.top is None


@settings(max_examples=50, deadline=None)
@given(st.lists(st.text("abc *?[", min_size=1, max_size=6), max_size=6), st.text("abc", max_size=5))
def test_what_begins_a_word_comes_before_what_is_within_one(texts: list[str], typed: str) -> None:
    found = fitting([Found(text, (text,)) for text in texts], typed)
    assert len(set(found)) == len(found) <= len(texts)
    begins = [any(part.startswith(typed) for part in texts[index].split()) for index in found]
    assert not typed or begins == sorted(begins, reverse=True)


@pytest.mark.parametrize(
    ("pattern", "found"),
    [
        ("link", NAMES[:1]), ("*.drl", NAMES[:2]), ("[1]", NAMES[1:2]), ("b*", NAMES[:1]), ("txt 1]", NAMES[1:]),
        ("?????.txt", NAMES[2:]), ("*", NAMES), ("none", []),
    ],
)  # fmt: skip
def test_a_list_is_filtered_by_any_part_of_a_name_or_by_a_pattern(pattern: str, found: list[str]) -> None:
    assert [name for name in NAMES if fits(name, pattern)] == found


@pytest.mark.parametrize("theme", THEMES)
def test_the_screen_is_kept_as_a_picture_and_nothing_is_written_over(
    theme: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "drillctl-1.svg").write_text("mine", "utf-8")
    (tmp_path / "drillctl-2.svg").symlink_to(tmp_path / "nowhere")
    program = Program(FakeConsole(loaded=BOARD))
    program.app.set_theme(theme)
    program.press("f9")
    program.press("ctrl g")  # the open menu is in it
    assert "drillctl-3.svg" in program.text()
    assert sorted(file.name for file in tmp_path.iterdir()) == [f"drillctl-{n}.svg" for n in (1, 2, 3)]
    assert (tmp_path / "drillctl-1.svg").read_text("utf-8") == "mine"
    text = (tmp_path / "drillctl-3.svg").read_text("utf-8")
    read = "".join(ElementTree.fromstring(text).itertext())
    assert "simulated" in read and "pen..." in read
    assert set(shades(theme, "danger")) <= set(text.split('"'))


def test_a_picture_that_can_not_be_written_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "gone"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.setattr("drillctl.ui.screen_copy.write_text", lambda file, text: ("the disk is full",))
    program = Program(FakeConsole())
    program.press("ctrl g")
    assert "the disk is full" in program.text()


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("size", [(40, 12), (LEAST[0] - 1, 24), (80, LEAST[1] - 1), (20, 8)])
def test_a_terminal_that_is_too_small_says_what_it_needs(language: str, size: tuple[int, int]) -> None:
    words.use(language)
    program = Program(FakeConsole(loaded=BOARD, now=VIEW))
    program.press("s")  # a question is open
    program.paper.size = size
    program.press("window resize")
    text = " ".join(program.text().split())
    assert str(LEAST[0]) in text and str(LEAST[1]) in text and (size[0] < 40 or "F10" in text)
    program.press("y", "enter", "i", ("mouse press", 1, 3, 3))
    assert not program.console.asked
    program.press("f10")
    assert program.console.asked == [("emergency_stop",)]
    program.paper.size = (80, 24)
    program.press("window resize")
    assert "F10" in program.text()


def test_each_example_board_is_understood_without_a_doubt(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    at_home(tmp_path, monkeypatch)
    console = Watched()
    try:
        for file in boards():
            assert super(Watched, console).load(str(file), JobOptions()) == ()
            board = console.board()
            assert board is not None and not board.warnings and board.confidence == 1.0, file
            assert len(board.tools) >= 3, file
    finally:
        console.close()
    assert len(boards()) >= 4


def paths(items: tuple[Item, ...], above: str = "") -> list[str]:
    """Every entry as README writes it: ``Tests > Scope``."""
    named = [(above + item.label.replace("&", "").removesuffix("..."), item.items) for item in items]
    return [path for name, below in named for path in (name, *paths(below, f"{name} > "))]


def test_every_way_that_the_readme_names_is_in_the_menus() -> None:
    text = README.read_text("utf-8")
    ways = re.findall(r"[A-Z]\w+ > [A-Z][\w ]*\w", text.partition("## On the screen")[2].partition("\n## ")[0])
    known = paths(MENUS)
    assert len(ways) >= 10
    for way in ways:
        assert any(path == way or path.startswith(f"{way},") for path in known), way
