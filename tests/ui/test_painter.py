"""What the painter writes, read by a terminal: after each frame its cells are those that urwid's own drawing gives."""

import io
from collections.abc import Iterator

import pytest
import urwid
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.ui.painter import Painter
from drillctl.ui.widgets.texts import Line, boxed

pyte = pytest.importorskip("pyte", reason="pyte (the dev extra) is the terminal")

COLUMNS, ROWS = 12, 3
PALETTE = [("title", "yellow", "dark blue"), ("good", "light green", "black")]
WORDS = st.text("ab ⡏│ó", max_size=COLUMNS + 2)
PARTS = st.one_of(WORDS, st.tuples(st.sampled_from(["title", "good"]), WORDS))
Cells = list[list[tuple[str, str, str]]]  # row by row: the character, its colour, that behind it
FRAMES = st.lists(st.lists(st.lists(PARTS, max_size=4), max_size=ROWS), min_size=1, max_size=5)


@pytest.fixture(autouse=True)
def utf8() -> Iterator[None]:
    before = urwid.util.get_encoding()
    urwid.set_encoding("utf-8")
    yield
    urwid.set_encoding(before)


class Pipe(io.StringIO):
    """A stream that a screen can be started on; what was written since the last ``taken`` is kept."""

    def taken(self) -> str:
        text = self.getvalue()
        self.seek(0)
        self.truncate()
        return text


def screen_of(kind: type[urwid.display.raw.Screen]) -> tuple[urwid.display.raw.Screen, Pipe]:
    pipe = Pipe()
    screen = kind(output=pipe)
    screen.register_palette(PALETTE)
    screen._started, screen._rows_used = True, None  # as after start(), which wants a terminal
    return screen, pipe


def cells(terminal: "pyte.Screen") -> Cells:
    rows = [terminal.buffer[y] for y in range(ROWS)]
    return [[(row[x].data, row[x].fg, row[x].bg) for x in range(COLUMNS)] for row in rows]


def drawn_with(kind: type[urwid.display.raw.Screen], frames: list[list[Line]]) -> list[Cells]:
    screen, pipe = screen_of(kind)
    terminal = pyte.Screen(COLUMNS, ROWS)
    stream = pyte.Stream(terminal)
    seen = []
    for lines in frames:
        screen.draw_screen((COLUMNS, ROWS), boxed(lines, COLUMNS, ROWS))
        stream.feed(pipe.taken())
        seen.append(cells(terminal))
    return seen


@settings(max_examples=60)
@given(frames=FRAMES)
def test_each_frame_is_what_urwid_draws(frames: list[list[Line]]) -> None:
    assert drawn_with(Painter, frames) == drawn_with(urwid.display.raw.Screen, frames)


def test_only_the_changed_run_is_written_and_nothing_where_nothing_changed() -> None:
    screen, pipe = screen_of(Painter)
    size = (COLUMNS, ROWS)
    line: Line = [("title", "ab"), "⡏⡏", ("good", "12"), "rest"]
    screen.draw_screen(size, boxed([line], *size))
    assert "rest" in pipe.taken()
    screen.draw_screen(size, boxed([line], *size))
    assert pipe.taken() == ""
    screen.draw_screen(size, boxed([[*line[:2], ("good", "13"), "rest"]], *size))
    written = pipe.taken()
    assert "13" in written and "\x1b[1;5H" in written
    assert "ab" not in written and "⡏" not in written and "rest" not in written
    screen.clear()
    screen.draw_screen(size, boxed([line], *size))
    assert "rest" in pipe.taken()


def test_what_a_terminal_would_obey_is_never_written() -> None:
    screen, pipe = screen_of(Painter)
    canvas = urwid.TextCanvas(["a\x07b\x9bc".encode()], maxcol=5, check_width=False)
    screen.draw_screen((5, 1), canvas)
    assert "a?b?c" in pipe.taken()
