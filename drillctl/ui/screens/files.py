"""The Files screen: find a drill file, see what it says and how it was understood, place it on the bed.

Rule: every change of placing, order or format reads the file anew; a refused one changes nothing and says why. What is
shown of a board comes from its BoardView alone. Opened by the frame and by the Drilling screen.
"""

from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import urwid

from drillctl.panel.console import Asked, BoardView, Console
from drillctl.ui.dialogs import pair_mm
from drillctl.ui.keys import Key, called
from drillctl.ui.lines import Size
from drillctl.ui.progress import clock
from drillctl.ui.screens.board_view import BoardPicture
from drillctl.ui.screens.browser import Browser, preview
from drillctl.ui.shell import Shell
from drillctl.ui.words import N_, _


class Choice(NamedTuple):
    """A way to place or drill a board: a field of Asked, its label, its values with the word for each."""

    field: str
    label: str
    values: tuple[tuple[str | float | None, str], ...]


CHOICES = (
    Choice("mirror", N_("Mirror"), ((None, N_("no")), ("x", N_("in X")), ("y", N_("in Y")))),
    Choice("rotate_deg", N_("Turn"), ((0.0, "0°"), (90.0, "90°"), (180.0, "180°"), (270.0, "270°"))),
    Choice("origin", N_("Origin"), (("base", N_("lowest hole")), ("file", N_("file zero")))),
    Choice(
        "order", N_("Order"),
        (("file", N_("as in the file")), ("nearest", N_("nearest")), ("optimised", N_("best"))),
    ),
)
BY_FIELD = {choice.field: choice for choice in CHOICES}


class Files(urwid.WidgetWrap[urwid.Widget]):
    """Browser at the left; at the right what the cursor stands on: the first lines of a file, or the board loaded."""

    title = N_("Files")
    keys = (
        Key(("enter",), "Enter", "choose", N_("opens a folder, or loads a file"), N_("Load")),
        Key(("/",), "/", "filter", N_("which files are listed"), N_("Filter")),
        Key(("tab",), "Tab", "other_side", N_("between the list and the facts"), N_("Side")),
        Key(("m",), "M", "cycle", N_("mirrors the board"), N_("Mirror"), "mirror"),
        Key(("t",), "T", "cycle", N_("turns the board by a quarter"), N_("Turn"), "rotate_deg"),
        Key(("o",), "O", "cycle", N_("what comes to lie at the base"), N_("Origin"), "origin"),
        Key(("v",), "V", "offset", N_("moves the board by X and Y")),
        Key(("r",), "R", "cycle", N_("the order of the holes"), N_("Order"), "order"),
        Key(("g",), "G", "set_format", N_("lets the format be recognised again"), argument=""),
    )

    def __init__(self, console: Console, shell: Shell, plain: bool = False, folder: Path | None = None):
        self._console, self._shell = console, shell
        self._asked, self._loaded = Asked(), Path()
        self._picture = BoardPicture(plain)
        self._rows: urwid.SimpleFocusListWalker[urwid.AttrMap[urwid.SelectableIcon]] = urwid.SimpleFocusListWalker([])
        facts = urwid.ListBox(self._rows)
        self._browser = Browser(folder or Path.cwd(), self.load, self._look_at)
        self._where = urwid.Text("", wrap="ellipsis")
        self._right = urwid.Pile([("weight", 2, self._picture), ("weight", 3, facts)])
        left: urwid.Widget = urwid.Frame(self._browser, header=urwid.AttrMap(self._where, "title"))
        self._sides = urwid.Columns([("weight", 2, left), ("weight", 3, self._right)], dividechars=1)
        super().__init__(self._sides)
        self._look_at(self._browser.current)

    def keypress(self, size: Size, key: str) -> str | None:
        """The list's keys first: Enter is its own."""
        left = super().keypress(size, key)
        return None if left is None or called(self, self.keys, left) else left

    def choose(self) -> None:
        """Enter beside the list: what the list's cursor stands on."""
        self._sides.focus_position = 0

    def other_side(self) -> None:
        """List or facts."""
        self._sides.focus_position = 1 - self._sides.focus_position
        self._right.focus_position = 1

    def filter(self) -> None:
        """Patterns such as ``*.drl``."""
        self._shell.ask_text(_("Filter"), _("Files:"), self._browser.pattern, self._browser.filter)

    def load(self, file: Path) -> None:
        """A file that was chosen."""
        self._try(file, self._asked)

    def cycle(self, field: str) -> None:
        """The next value of a choice."""
        values = [value for value, _word in BY_FIELD[field].values]
        following = values[(values.index(getattr(self._asked, field)) + 1) % len(values)]
        changed: dict[str, Any] = {field: following}
        self._try(self._loaded, replace(self._asked, **changed))

    def set_format(self, name: str) -> None:
        """Settled by hand; empty: recognised."""
        self._try(self._loaded, replace(self._asked, format=name or None))

    def offset(self) -> None:
        """Typed."""
        now = "{:g} {:g}".format(*self._asked.offset_mm)
        self._shell.ask_text(_("Offset"), _("X and Y in mm from the base:"), now, self._set_offset)

    def _set_offset(self, text: str) -> None:
        pair = pair_mm(text)
        if pair is None:
            told = _("two numbers are wanted, such as 12.7 25.4, not {text!r}").format(text=text)
            self._shell.message(_("Offset"), [told])
        else:
            self._try(self._loaded, replace(self._asked, offset_mm=pair))

    def _try(self, file: Path, asked: Asked) -> None:
        """With a file: read as asked. Without one yet the wish is kept for it."""
        problems = self._console.load(str(file), asked) if file.name else ()
        if problems:
            self._shell.message(_("Refused"), [_(problem) for problem in problems])
            return
        self._asked, self._loaded = asked, file
        self._look_at(file if file.name else self._browser.current)

    def _look_at(self, path: Path) -> None:
        self._where.set_text(str(self._browser.folder))
        board = self._console.board() if path == self._loaded else None
        self._picture.show(board)
        lines = board_lines(board) if board else preview(path)
        self._rows[:] = [_row(line) for line in [*self._wishes(), "", *lines]]
        self._rows.set_focus(0)

    def _wishes(self) -> list[str]:
        """Two a line."""
        words = [(choice.label, dict(choice.values)[getattr(self._asked, choice.field)]) for choice in CHOICES]
        offset = "{:g} {:g} mm".format(*self._asked.offset_mm)
        told = [f"{_(label)}: {_(word)}" for label, word in words] + [f"{_('Offset')}: {offset}"]
        told.insert(0, f"{_('Format')}: {self._asked.format or _('recognised')}")
        return [f"{left:24} {right}" for left, right in zip(told[::2], told[1::2], strict=True)]


def board_lines(board: BoardView) -> list[str]:
    """A board in words: size, format and why, tools with their time, the whole time, warnings."""
    width_mm, height_mm = np.ptp(board.xy_mm, axis=0).tolist() if len(board.xy_mm) else (0.0, 0.0)
    size = _("{name}: {holes} holes, {width:.2f} x {height:.2f} mm").format(
        name=board.name, holes=len(board.xy_mm), width=width_mm, height=height_mm
    )
    sure = f"{board.format} ({board.confidence:.0%}): {board.reason}"
    runner_up = [_("else: {format}").format(format=board.runner_up)] if board.runner_up else []
    warnings = [_("warning: {text}").format(text=text) for text in board.warnings]
    return [size, sure, *runner_up, *_tool_lines(board), _whole_time(board), *warnings]


def _tool_lines(board: BoardView) -> list[str]:
    return [
        f"T{tool.number:<3} {_diameter(tool.diameter_mm):>9} "
        + _("{holes:6} holes  {time}").format(holes=tool.holes, time=clock(tool.ticks / board.estimate.tick_hz))
        for tool in board.estimate.tools
    ]


def _diameter(mm: float | None) -> str:
    return "? mm" if mm is None else f"{mm:.3f} mm"


def _whole_time(board: BoardView) -> str:
    told = board.estimate
    about = "" if told.exact else _("about ")
    line = _("Estimate {about}{time}").format(about=about, time=clock(told.ticks / told.tick_hz))
    return line if told.fault is None else f"{line}; {_('it would end in')} {told.fault.name}: {_(told.fault.cause)}"


def _row(line: str) -> urwid.AttrMap[urwid.SelectableIcon]:
    """A line that can be scrolled to; a warning is marked."""
    marked = "warning" if line.startswith(_("warning: {text}").partition("{")[0]) else "body"
    return urwid.AttrMap(urwid.SelectableIcon(line, 0), marked, "focus")


