"""The Files screen: find a drill file, see what it says and how it was understood, place it on the bed.

Rule: every change of placing, order or format reads the file anew; a refused one changes nothing and says why. What is
shown of a board comes from its BoardView alone.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import urwid
from msgspec.structs import replace

from drillctl.files.inputs import real_path
from drillctl.language import Message
from drillctl.language.words import N_, _, translated
from drillctl.ui.models.editing import History, Undoable
from drillctl.ui.pcb_drill.alignment import AlignmentScreen
from drillctl.ui.pcb_drill.board_facts import CHOICES, loaded_line, recent_line
from drillctl.ui.pcb_drill.browser import Browser
from drillctl.ui.pcb_drill.examples import offer_examples
from drillctl.ui.pcb_drill.files_layout import FilesLayout
from drillctl.ui.pcb_drill.job_forms import ask_how_to_drill, ask_offset, ask_panel, choose_format, type_format
from drillctl.ui.screens.shell import Shell
from drillctl.ui.screens.unfinished import offer_unfinished
from drillctl.ui.widgets.dialogs import Answered
from drillctl.ui.widgets.keys import UNDO_KEYS, Key, called
from drillctl.ui.widgets.texts import Size
from drillctl.viewmodel.console import Console, Problems, Watch
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole
from drillctl.viewmodel.jobs import RecentJob

BY_FIELD = {choice.field: choice for choice in CHOICES}


class Files(Undoable[JobOptions], urwid.WidgetWrap[urwid.Widget]):
    """Browser at the left; at the right what the cursor stands on: the first lines of a file, or the board loaded."""

    title = N_("Files")
    keys_here = {"files": "choose"}  # who is to open a board, and is here already, presses Enter
    keys = (
        Key(("enter",), "Enter", "choose", N_("opens a folder, or loads a file"), N_("Load")),
        Key(("/",), "/", "filter", N_("which files are listed: part of a name, or with *"), N_("Filter")),
        Key(("e",), "E", "examples", N_("the example boards and the lab sheets")),
        Key(("l",), "L", "recent", N_("the files opened last, as they were placed"), N_("Last")),
        Key(("u",), "U", "unfinished", N_("jobs that were cut off, to be gone on with")),
        Key(("tab",), "Tab", "other_side", N_("between the list and the facts")),
        Key(("f6",), "F6", "choose_format", N_("the format of the numbers, or to recognise it"), N_("Format")),
        Key(("m",), "M", "cycle", N_("mirrors the board"), N_("Mirror"), "mirror"),
        Key(("r",), "R", "cycle", N_("turns the board by a quarter"), N_("Turn"), "rotate_deg"),
        Key(("o",), "O", "cycle", N_("what comes to lie at the base"), argument="origin"),
        Key(("v",), "V", "offset", N_("moves the board by X and Y")),
        Key(("j",), "J", "align", N_("places the board by holes measured on it"), N_("Align")),
        Key(("p",), "P", "panel", N_("repeats the board in columns and rows"), N_("Panel")),
        Key(("#",), "#", "cycle", N_("the order of the holes"), N_("Order"), "order"),
        Key((">",), ">", "cycle", N_("what becomes of holes behind the end, M30 (--after-end)"), argument="after_end"),
        Key(("h",), "H", "how_to_drill", N_("pecks, spots, tools left out, drills, pins, milling")),
        *UNDO_KEYS,
    )

    def __init__(self, console: Console, shell: Shell, plain: bool = False, folder: Path | None = None):
        self._console, self._shell = console, shell
        self._options, self._loaded = JobOptions(), Path()
        self._history = History(self._options)  # of the options of the file at hand
        self._browser = Browser(folder or Path.cwd(), self.load, self._look_at)
        self._layout = FilesLayout(self._browser, self.keys, plain, console.glance)
        super().__init__(self._layout)
        self._look_at(self._browser.current)

    def keypress(self, size: Size, key: str) -> str | None:
        """Offers a key to the list first, which needs Enter; then calls the method of the key in the table."""
        left = super().keypress(size, key)
        return None if left is None or called(self, self.keys, left) else left

    def choose(self) -> None:
        """Moves the focus to the list: Enter was pressed beside it."""
        self._layout.to_the_list()

    def other_side(self) -> None:
        """Moves the focus from the list to the facts, or back."""
        self._layout.other_side()

    def filter(self) -> None:
        """Asks for parts of the names of the files to be listed, or patterns such as ``*.drl``."""
        self._shell.ask_text(_("Filter"), _("Files:"), self._browser.pattern, self._browser.filter)

    def recent(self) -> None:
        """Offers the files opened last, each with the options that it was opened with."""
        jobs = self._console.recent()
        if not jobs:
            self._shell.message(_("Recent"), [_("No file has been opened yet.")])
            return
        lines = [recent_line(job.file, job.options) for job in jobs]
        self._shell.choose(_("Recent"), lines, lambda index: self._open_again(jobs[index]))

    def examples(self) -> None:
        """Offers the example boards and the lab sheets; a board that is chosen is loaded, ready to be drilled."""
        offer_examples(self._shell, self.open_example)

    def open_example(self, file: Path) -> None:
        """Loads an example as if it were chosen in the list, then shows the machine with it."""
        self._browser.stand_on(file)

        def opened(problems: Sequence[Message]) -> None:
            self._tell(problems)
            if not problems:
                self._shell.show("drilling")

        self._read(file, replace(self._options, align=None, skip_tools=()), opened)

    def unfinished(self) -> None:
        """Offers to resume the jobs that were interrupted."""
        if not offer_unfinished(self._console, self._shell):
            self._shell.message(_("Interrupted jobs"), [_("No job was cut off.")])

    def load(self, file: Path) -> None:
        """Loads a file. Holes measured on another board, and its tools left out, do not apply to it."""
        same = file == self._loaded
        self._read(file, self._options if same else replace(self._options, align=None, skip_tools=()), self._tell)

    def cycle(self, field: str) -> None:
        """The next value of a choice; the first one after a value that can't be chosen."""
        values = [value for value, _word in BY_FIELD[field].values]
        now = getattr(self._options, field)
        following = values[(values.index(now) + 1) % len(values)] if now in values else values[0]
        self._change(self._tell, **{field: following})

    def choose_format(self) -> None:
        """Offers the formats by name, and to type one."""
        choose_format(self._shell, self._options, self.set_format)

    def type_format(self) -> None:
        """Asks for a format as it is written on the command line."""
        type_format(self._shell, self._options, self.set_format)

    def set_format(self, name: str) -> None:
        """Reads the file by this format; recognises the format for an empty text."""
        self._change(self._tell, format=name.strip() or None)

    def _restore(self) -> None:
        """Reads the file at hand with the options that were gone back to."""
        self._read(self._loaded, self._history.now, self._tell)

    def offset(self) -> None:
        """Asks for the offset from the base."""
        ask_offset(self._shell, self._options, lambda pair: self._change(self._tell, offset_mm=pair))

    def panel(self) -> None:
        """Asks for columns and rows of a panel of the same board."""
        ask_panel(self._shell, self._options, self._change_all)

    def how_to_drill(self) -> None:
        """Asks for peck depth, spot depth, tools to leave out and the file of the drills at hand."""
        ask_how_to_drill(self._shell, self._options, self._change_all)

    def align(self) -> None:
        """Opens the screen that places the loaded board by holes measured on it."""
        board = self._console.board()
        if board is None or not self._loaded.name or Path(board.file) != real_path(self._loaded):
            self._shell.message(_("Measured holes"), [_("no board is loaded: open a drill file first")])
        elif self._options.panel:
            self._shell.message(_("Measured holes"), [_("Measure a single board first, then repeat it in a panel.")])
        else:
            self._shell.open(AlignmentScreen(self._console, self._shell, board, self._options, self._place_by))

    def _change_all(self, changes: dict[str, Any], answered: Answered) -> None:
        self._change(answered, **changes)

    def _place_by(self, measured: tuple[MeasuredHole, ...], answered: Answered) -> None:
        """The holes say where the board lies; of the other options only a mirror, the board's side, is kept."""
        usual = JobOptions()
        placed = {"origin": usual.origin, "rotate_deg": usual.rotate_deg, "offset_mm": usual.offset_mm}
        self._change(answered, align=measured or None, **(placed if measured else {}))

    def _open_again(self, job: RecentJob) -> None:
        file = Path(job.file)

        def opened(problems: Sequence[Message]) -> None:
            self._tell(problems)
            if not problems:
                self._browser.stand_on(file)

        self._read(file, job.options, opened)

    def _change(self, answered: Answered, **changed: Any) -> None:
        """Reads the loaded file with other options; ``answered`` is called with what is wrong with them."""
        self._read(self._loaded, replace(self._options, **changed), answered)

    def _tell(self, problems: Sequence[Message]) -> None:
        if problems:
            self._shell.message(_("Refused"), [translated(problem) for problem in problems])

    def _read(self, file: Path, options: JobOptions, then: Answered) -> None:
        """Reads the file with these options beside the screen; without a file yet they are kept for the first one."""

        self._shell.work(
            lambda watch: self._load(file, options, watch), lambda problems: then(self._taken(file, options, problems))
        )

    def _load(self, file: Path, options: JobOptions, watch: Watch) -> Problems:
        return self._console.load(str(file), options, watch) if file.name else ()

    def _taken(self, file: Path, options: JobOptions, problems: Problems) -> Problems:
        """Shows a board that was read without problems; returns these."""
        if not problems:
            if file == self._loaded:
                self._history.do(options)
            else:
                self._history = History(options)
            self._options, self._loaded = options, file
            self._look_at(file if file.name else self._browser.current)
            if file.name and (board := self._console.board()):
                self._shell.say(loaded_line(board))
        return problems

    def _look_at(self, path: Path) -> None:
        board = self._console.board() if path == self._loaded else None
        self._layout.show(self._browser.folder, path, board, self._options)
