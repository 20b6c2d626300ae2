"""The queue editor (Tests): lines of KMD commands, completed by Tab, checked as they are typed, run whole or in part.

Rule: what runs is the text on the screen; it is checked before it is handed on, and a refusal says line and column.
"""

from collections.abc import Callable, Sequence

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.models.editing import History, Undoable, completed, usage
from drillctl.ui.screens.own_steps import QUEUE_STEPS
from drillctl.ui.screens.queue_lines import finding_lines, reference_lines, stopped_lines
from drillctl.ui.screens.shell import Shell, asked_if_real, asked_to_leave
from drillctl.ui.screens.table_editor import Size
from drillctl.ui.screens.tick_log import TickLog, port_line
from drillctl.ui.widgets.keys import UNDO_KEYS, Key, called
from drillctl.ui.widgets.panel import BORDER_COLUMNS, panel_columns, with_panel
from drillctl.ui.widgets.texts import Edit, Line, Text
from drillctl.viewmodel.console import AxisView, Console, MachineView, Problems
from drillctl.viewmodel.signals import ManualControl
from drillctl.viewmodel.tables import QueueEditing, TextFinding

Draft = tuple[str, int]  # a text, and where the cursor stands in it


class QueueEditor(Undoable[Draft], urwid.WidgetWrap[urwid.Widget]):
    """A queue as text. ``file`` is where it was opened or saved last; empty for a new one."""

    title = N_("Queue of commands")
    own_steps = QUEUE_STEPS
    keys = (
        Key(("tab",), "Tab", "complete", N_("completes the word before the cursor"), N_("Complete")),
        Key(("f5",), "F5", "run_all", N_("runs the whole queue; goes on where the clock was stopped"), N_("Run")),
        Key(("ctrl d",), "Ctrl-D", "run_to_cursor",
            N_("runs down to the cursor's line, this one too"), N_("To cursor")),
        Key(("ctrl n",), "Ctrl-N", "run_line", N_("runs the cursor's line alone and goes to the next"), N_("One")),
        Key(("ctrl t",), "Ctrl-T", "tick", N_("one tick of the queue, then the clock waits"), N_("Tick")),
        *UNDO_KEYS,
        Key(("f2",), "F2", "save", N_("saves the queue to a file"), N_("Save")),
        Key(("ctrl o",), "Ctrl-O", "open", N_("opens a file"), N_("Open")),
    )

    def __init__(
        self, console: Console, shell: Shell, queues: QueueEditing, control: ManualControl, plain: bool = False
    ):
        self._log, self._plain = TickLog(), plain
        self._axes: Sequence[AxisView] = ()
        self._console, self._shell, self._queues, self._control = console, shell, queues, control
        self._stopped: list[Line] = []
        self._commands = queues.commands()
        self.file = ""
        self._edit = Edit(multiline=True)
        self._heading, self._below = Text(""), Text("")
        body = urwid.ListBox(urwid.SimpleFocusListWalker([self._edit]))
        header = urwid.AttrMap(self._heading, "title")
        super().__init__(urwid.Frame(urwid.AttrMap(body, "field"), header=header, footer=self._below))
        self._put("", "")

    @property
    def text(self) -> str:
        """The queue as it stands on the screen."""
        return str(self._edit.edit_text)

    @property
    def changed(self) -> bool:
        """Whether the queue differs from its file."""
        return self.text != self._saved

    def keypress(self, size: Size, key: str) -> str | None:
        """The table's keys, then the text's own; Esc asks first where something would be lost."""
        if asked_to_leave(self, self._shell, key, self._give_up) or called(self, self.keys, key):
            return None
        left = super().keypress(self._left(size), key)
        self._keep()
        self._look()
        return left

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the queue, and beside it the single ticks, or the commands that there are."""
        left, rows = self._left(size)
        assert len(size) == 2
        beside = size[0] - left
        title = _("Single ticks") if self._stopped else _("Commands")
        lines = self._beside(beside - BORDER_COLUMNS, rows - 1) if beside else []
        return with_panel(super().render((left, rows), focus), title, lines, beside, rows)

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool | None:
        """Hands an event to the text, unless it is on the panel."""
        left = self._left(size)
        return super().mouse_event(left, event, button, col, row, focus) if col < left[0] else False

    def get_cursor_coords(self, size: Size) -> tuple[int, int] | None:
        """Where the text has the terminal's cursor."""
        return super().get_cursor_coords(self._left(size))

    def complete(self) -> None:
        """Completes the word before the cursor; lists the possible words where there are several."""
        before, after = self.text[: self._edit.edit_pos], self.text[self._edit.edit_pos :]
        start = before.rfind("\n") + 1
        line, fits = completed(before[start:], self._commands, self._queues.words())
        self._edit.set_edit_text(f"{before[:start]}{line}{after}")
        self._edit.set_edit_pos(start + len(line))
        self._keep()
        self._look(fits)

    def refresh(self, view: MachineView) -> None:
        """Shows where the clock stopped, while it is stopped."""
        stopped: list[Line] = []
        if view.paused:
            self._log.add(view.tick, self._control.signals())
            self._axes = view.axes
            stopped = [*stopped_lines(view), port_line(self._control.signals())]
        if stopped != self._stopped:
            self._stopped = stopped
            self._look()
            self._invalidate()

    def run_all(self) -> None:
        """Runs the queue from its first line; goes on where the clock was stopped."""
        if self._console.view().paused:
            self._answer(self._control.go())
        else:
            self._run(self.text)

    def tick(self) -> None:
        """Runs one tick of the queue, from its beginning or from where the clock stopped."""
        if self._console.view().paused:
            self._answer(self._control.tick(1))
        else:
            self._ask(self.text, self._control.run_paused, self._first_tick)

    def run_to_cursor(self) -> None:
        """Runs the lines down to the one of the cursor."""
        self._run("\n".join(self.text.split("\n")[: self._line + 1]))

    def run_line(self) -> None:
        """Runs the cursor's line alone, with its line number, and goes to the next line."""
        lines = self.text.split("\n")
        after = min(len("\n".join(lines[: self._line + 1])) + 1, len(self.text))

        def next_line() -> None:
            self._edit.set_edit_pos(after)
            self._look()

        self._run("\n" * self._line + lines[self._line], next_line)

    def _left(self, size: Size) -> tuple[int, int]:
        """The size of the text beside its panel."""
        assert len(size) == 2
        return size[0] - panel_columns(size[0]), size[1]

    def _beside(self, columns: int, rows: int) -> list[Line]:
        """The lines of the panel: single ticks while the clock is stopped, else the reference of the commands."""
        if self._stopped:
            return self._log.lines(self._axes, (columns, rows), self._plain)
        return reference_lines(self._commands, columns)

    def _first_tick(self) -> None:
        self._answer(self._control.tick(1))

    def save(self) -> None:
        """Asks for a file, then saves the queue to it."""
        self._shell.ask_text(_("Save"), _("File:"), self.file or "queue.kmd", self._save)

    def open(self) -> None:
        """Asks for a file, then opens it; asks first where something is not saved."""
        if self.changed:
            self._shell.ask(_("Open another queue without saving this one?"), self._ask_file)
        else:
            self._ask_file()

    @property
    def _line(self) -> int:
        """The cursor's line, from 0."""
        return self.text.count("\n", 0, self._edit.edit_pos)

    def _put(self, file: str, text: str) -> None:
        """Replaces the queue by another text, with a history of its own."""
        self.file, self._saved = file, text
        self._history = History((text, 0))
        self._restore()

    def _give_up(self) -> None:
        """Discards the edits and closes the screen."""
        self._put(self.file, self._saved)
        self._shell.back()

    def _keep(self) -> None:
        """Adds a changed text to the history; a moved cursor alone is no change."""
        if self.text != self._history.now[0]:
            self._history.do((self.text, self._edit.edit_pos))

    def _restore(self) -> None:
        text, cursor = self._history.now
        self._edit.set_edit_text(text)
        self._edit.set_edit_pos(cursor)
        self._look()

    def _run(self, text: str, then: Callable[[], None] = lambda: None) -> None:
        self._ask(text, self._console.run_queue, then)

    def _ask(self, text: str, run: Callable[[str], Problems], then: Callable[[], None]) -> None:
        """A sound queue is run, on a real machine after a question; ``then`` follows where it was begun."""

        def begin() -> None:
            if self._answer(run(text)):
                then()

        if self._answer(tuple(found.message for found in self._queues.check_queue(text))):
            asked_if_real(self._control, self._shell, _("Run the queue on it?"), begin)

    def _answer(self, problems: Problems) -> bool:
        if problems:
            self._shell.message(_("Not run"), [translated(problem) for problem in problems])
        return not problems

    def _save(self, file: str) -> None:
        if problems := self._queues.save_queue(file, self.text):
            self._shell.message(_("Not saved"), [translated(problem) for problem in problems])
            return
        self.file, self._saved = file, self.text
        self._look()

    def _ask_file(self) -> None:
        self._shell.ask_text(_("Open"), _("File:"), self.file, self._open)

    def _open(self, file: str) -> None:
        text, problems = self._queues.open_queue(file)
        if problems:
            self._shell.message(_("Not opened"), [translated(problem) for problem in problems])
        else:
            self._put(file, text)

    def _look(self, fits: tuple[str, ...] = ()) -> None:
        """Draws heading and findings anew."""
        changed = _(", changed") if self.changed else ""
        self._heading.set_text(f"{_(self.title)}: {self.file or _('new')}{changed}")
        lines = self._lines(fits)
        self._below.set_text([part for line in lines for part in [*line, "\n"]][:-1])

    def _lines(self, fits: tuple[str, ...]) -> list[Line]:
        line = self.text.split("\n")[self._line]
        column = self._edit.edit_pos - (self.text.rfind("\n", 0, self._edit.edit_pos) + 1)
        place = _("line {line}, column {column}").format(line=self._line + 1, column=column + 1)
        hint = "  ".join(fits) or usage(line, self._commands)
        found = self._queues.check_queue(self.text) if self.text.strip() else ()
        return [[("key", place)], [hint], *self._verdict(found), *self._stopped]

    def _verdict(self, found: tuple[TextFinding, ...]) -> list[Line]:
        """The findings: problems; where there are none, moves that will end in a fault, as warnings."""
        too_far = () if found else self._queues.too_far(self.text)
        return finding_lines(found, "danger") or finding_lines(too_far, "warning") or [[("good", _("sound"))]]
