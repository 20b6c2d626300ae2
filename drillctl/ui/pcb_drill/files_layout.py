"""Where the parts of the Files screen stand: the list at the left, picture and facts at the right.

Rule: the facts have the rows that they need, the picture the rest. A large terminal has the options below the list,
each behind the key that changes it; a smaller one has them above the facts. A file that is not loaded is read for its
picture when the screen is drawn, and not before: a cursor that runs down the list reads nothing.
"""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import urwid

from drillctl.language.words import N_, _
from drillctl.ui.pcb_drill.board_facts import board_lines, glance_line, is_warning, option_lines, placing_lines
from drillctl.ui.pcb_drill.browser import Browser, preview
from drillctl.ui.screens.board_view import BoardPicture
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.panel import titled
from drillctl.ui.widgets.texts import Icon, Size, Text, boxed
from drillctl.viewmodel.console import BoardView, HolesView
from drillctl.viewmodel.job_options import JobOptions

LARGE = (140, 32)  # columns and rows of a screen that has the options below the list
LEAST_PICTURE = 3  # rows, where there is no board to be drawn
MOST_OF_FACTS = 0.6  # of the rows, beside a picture
LIST_WEIGHT, BOARD_WEIGHT = 2, 3
PLACING, SAID = N_("Placing and drilling"), N_("What the file says")
HINT = (N_("No board is loaded."), N_("Enter loads the file at the cursor."))
Glance = Callable[[str, JobOptions], HolesView | None]


class Rule(urwid.Widget):
    """A line across with a title in it."""

    _sizing = frozenset([urwid.Sizing.FLOW])

    def __init__(self, title: str):
        super().__init__()
        self._title = title

    def rows(self, size: Size, focus: bool = False) -> int:
        """How many rows the line takes."""
        return 1

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the line as long as its place is wide."""
        assert size
        return boxed([titled(_(self._title), size[0])], size[0], 1)


class FilesLayout(urwid.WidgetWrap[urwid.Widget]):
    """The parts side by side. ``keys``: the screen's, of which the options name theirs; ``glance``: the holes of a file
    that is not loaded.
    """

    def __init__(self, browser: Browser, keys: Sequence[Key], plain: bool, glance: Glance):
        self._keys, self._plain, self._glance = keys, plain, glance
        self._holes: HolesView | None = None
        self._unseen = False  # whether the file was not glanced at yet
        self._options, self._path, self._large = JobOptions(), Path(), False
        self._board: BoardView | None = None
        self._rows: urwid.SimpleFocusListWalker[urwid.AttrMap[Icon]] = urwid.SimpleFocusListWalker([])
        self._where, self._placing = Text("", wrap="ellipsis"), Text("")
        self._picture = BoardPicture(plain, HINT)
        self._facts: urwid.Frame[Any, Any, Any] = urwid.Frame(urwid.ListBox(self._rows))
        self._right = urwid.Pile([self._picture, ("given", 1, self._facts)], focus_item=1)
        self._list: urwid.Frame[Any, Any, Any] = urwid.Frame(browser, header=urwid.AttrMap(self._where, "title"))
        self._below = urwid.Pile([("pack", Rule(PLACING)), ("pack", self._placing)])
        self._left = urwid.Pile([self._list])
        self._sides = urwid.Columns(
            [("weight", LIST_WEIGHT, self._left), ("weight", BOARD_WEIGHT, self._right)], dividechars=1
        )
        super().__init__(self._sides)

    def show(self, folder: Path, path: Path, board: BoardView | None, options: JobOptions) -> None:
        """Shows a board, or the first lines of the file that the cursor is on."""
        self._where.set_text(str(folder))
        self._path, self._board, self._options = path, board, options
        self._holes, self._unseen = board, board is None
        self._picture.show(board)
        self._fill()

    def other_side(self) -> None:
        """Moves the focus from the list to the facts, or back."""
        self._sides.focus_position = 1 - self._sides.focus_position

    def to_the_list(self) -> None:
        """Moves the focus to the list."""
        self._sides.focus_position = 0

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the parts, each in the rows that it has at this size."""
        assert len(size) == 2
        if self._unseen:
            self._look()
        self._lay_out(*size)
        return super().render(size, focus)

    def _look(self) -> None:
        """Draws the file at the cursor, where it is a drill file and short."""
        self._unseen = False
        self._holes = self._glance(str(self._path), self._options)
        if self._holes is not None:
            self._picture.show(self._holes)
            self._fill()

    def _lay_out(self, columns: int, rows: int) -> None:
        large = columns >= LARGE[0] and rows >= LARGE[1]
        if large != self._large:
            self._large = large
            below = [(self._below, self._left.options("pack"))] if large else []
            self._left.contents[:] = [(self._list, self._left.options()), *below]
            self._facts.header = Rule(SAID) if large else None
            self._fill()
        wanted = self._rows_of_facts(self._sides.column_widths((columns, rows))[1])
        most = int(rows * MOST_OF_FACTS) if self._holes else rows - LEAST_PICTURE
        self._right.contents[1] = (self._facts, self._right.options("given", max(1, min(wanted, most))))

    def _rows_of_facts(self, columns: int) -> int:
        return sum(row.original_widget.rows((columns,)) for row in self._rows) + self._large

    def _fill(self) -> None:
        """Writes options and facts anew, as a large or a smaller terminal has them."""
        lines = board_lines(self._board, self._large, self._plain) if self._board else self._first_lines()
        options = [] if self._large else [*option_lines(self._options), ""]
        self._placing.set_text([f"{line}\n" for line in placing_lines(self._options, self._keys)])
        self._rows[:] = [_row(line) for line in [*options, *lines]]
        self._rows.set_focus(0)

    def _first_lines(self) -> list[str]:
        """Of a file that is not loaded: what Enter would load, and its first lines."""
        seen = [glance_line(self._path.name, self._holes), ""] if self._holes else []
        return [*seen, *preview(self._path)]


def _row(line: str) -> urwid.AttrMap[Icon]:
    """A line of the facts that can be scrolled to; a warning in its colour."""
    return urwid.AttrMap(Icon(line, 0), "warning" if is_warning(line) else "body", "focus")
