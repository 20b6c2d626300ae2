"""What a person asks of a machine that drills boards: start, hold, stop, tool, base, places, and the board's picture.

Rule: every motion is one key of the screen's table or one entry of the menu, and a refused one says why in the bottom
line. Drilling itself asks first. A part of the screens on which boards are drilled.
"""

from typing import Protocol

from drillctl.language import Message
from drillctl.language.number_text import clock, pair_mm
from drillctl.language.words import N_, _, ngettext
from drillctl.ui.screens.board_steps import next_step
from drillctl.ui.screens.board_view import STEP, BoardPicture
from drillctl.ui.screens.jog_controls import JogControls
from drillctl.ui.screens.machine_lines import tool_name
from drillctl.ui.screens.shell import Shell
from drillctl.ui.screens.tick_rate import ask_tick_hz
from drillctl.ui.screens.unfinished import offer_job
from drillctl.ui.widgets.keys import Key, called
from drillctl.ui.widgets.texts import Size, Text
from drillctl.viewmodel.console import BoardView, Console, MachineView
from drillctl.viewmodel.jobs import UnfinishedJob
from drillctl.viewmodel.records import Progress

BOARD_KEYS = (
    Key(("z",), "Z", "zoom_board", N_("the board closer; so does the mouse wheel"), argument="closer"),
    Key(("Z",), "Shift Z", "zoom_board", N_("the board from further away"), argument="further"),
    Key(("w",), "W", "whole_board", N_("the whole board")),
    Key(("shift left",), N_("Shift Left"), "pan_board", N_("the board further to the left"), argument="left"),
    Key(("shift right",), N_("Shift Right"), "pan_board", N_("the board further to the right"), argument="right"),
    Key(("shift up",), N_("Shift Up"), "pan_board", N_("the board further up"), argument="up"),
    Key(("shift down",), N_("Shift Down"), "pan_board", N_("the board further down"), argument="down"),
    Key(("y",), "Y", "tool_numbers", N_("holes to do as numbers of their tools, or as dots")),
)
ZOOMS = {"closer": STEP, "further": 1 / STEP}
PANS = {"left": (-0.25, 0), "right": (0.25, 0), "up": (0, -0.25), "down": (0, 0.25)}  # parts of what is seen


class BoardWindows(Protocol):
    """The windows of a screen on which boards are drilled; ``picture`` is that of the board."""

    picture: BoardPicture

    def show(self, view: MachineView, board: BoardView | None, progress: Progress | None) -> None:
        """Draws what changed in machine, board and job."""

    def turn_page(self) -> None:
        """Shows the next page of what has several."""


class BoardControls(JogControls):
    """The part of a screen that carries the requests out; the screen has the ``keys`` and lays the windows out."""

    keys: tuple[Key, ...] = ()

    def __init__(self, console: Console, shell: Shell, windows: BoardWindows):
        super().__init__(console)
        self._shell, self._windows = shell, windows
        self._was_at_work = False
        self._footer = Text("")

    def selectable(self) -> bool:
        """True: the screen takes keys although no widget in it does."""
        return True

    def keypress(self, size: Size, key: str) -> str | None:
        """Clears the last answer and calls the method of a key in the table; returns any other key."""
        self._note = ("body", "")
        return None if called(self, self.keys, key) else key

    def refresh(self, view: MachineView) -> None:
        """Draws what changed in machine, board and job."""
        board, progress = self._console.board(), self._console.progress()
        self._windows.show(view, board, progress)
        of_board = progress if board and progress and progress.holes_total == len(board.xy_mm) else None
        if self._was_at_work and not view.at_work and of_board:
            self._note = ("body", _ended(of_board, self._cut_off() is not None))
        self._was_at_work = view.at_work
        self._footer.set_text(self._bottom())

    def start(self) -> None:
        """Asks, then drills the board; offers to resume first if the job was interrupted."""
        board = self._console.board()
        if self._refused():
            return
        if board is None:
            self._answer(self._console.start(dry=False))
            return
        if (cut_off := self._cut_off()) is not None:
            offer_job(cut_off, self._console, self._shell, anew=self._drill)
            return
        count = len(board.xy_mm)
        question = ngettext("Drill {count} hole of {name}?", "Drill {count} holes of {name}?", count).format(
            count=count, name=board.name
        )
        self._shell.ask(question, self._drill)

    def _cut_off(self) -> UnfinishedJob | None:
        """The job of the loaded board that was interrupted."""
        board = self._console.board()
        jobs = self._console.unfinished() if board else ()
        return next((job for job in jobs if board and job.file == board.file), None)

    def _refused(self) -> bool:
        """Whether no motion can be begun just now; then the bottom line says why, and nothing is asked."""
        refuses = next_step(self._console, self._console.view()).refuses
        if refuses:
            self._answer((Message(refuses),))
        return bool(refuses)

    def _drill(self) -> None:
        self._answer(self._console.start(dry=False), _("drilling"))

    def dry_run(self) -> None:
        """Runs the board with the drill raised."""
        if not self._refused():
            self._answer(self._console.start(dry=True), _("dry run"))

    def hold_or_resume(self) -> None:
        """Holds the job, or resumes it if it is held."""
        if self._console.view().condition in ("holding", "held"):
            self._answer(self._console.resume(), _("going on"))
        else:
            self._answer(self._console.hold(), _("hold"))

    def stop(self) -> None:
        """Ends the job; the position is kept."""
        self._answer(self._console.stop(), _("stop; the position is kept"))

    def tool_changed(self) -> None:
        """Asks whether the tool is in, then resumes: the drill comes down next."""
        tool = self._console.view().tool_wanted
        if tool is None:
            self._say("warning", _("no tool is waited for"))
            return
        question = _("Is the tool in? {tool}").format(tool=tool_name(tool))
        self._shell.ask(question, lambda: self._answer(self._console.tool_changed(), _("going on")))

    def initialise(self) -> None:
        """Moves the axes to the limit sensors, which makes the position known."""
        self._answer(self._console.initialise(), _("initialisation"))

    def return_to_zero(self) -> None:
        """Goes back to machine zero by the count of steps, the head first."""
        self._answer(self._console.return_to_zero(), _("return to zero"))

    def set_base(self) -> None:
        """Takes the position as the working base."""
        self._answer(self._console.set_base(), _("this place is the working base"))

    def acknowledge(self) -> None:
        """Acknowledges a fault, so that the machine can be used again."""
        self._answer(self._console.acknowledge(), _("acknowledged"))

    def files(self) -> None:
        """Opens the Files screen on top."""
        self._shell.show("files")

    def turn_page(self) -> None:
        """Shows the next page of the windows at the right."""
        self._windows.turn_page()

    def zoom_board(self, way: str) -> None:
        """Shows the board closer or from further away."""
        self._say("body", _("zoom {zoom:g}").format(zoom=round(self._windows.picture.zoom(ZOOMS[way]), 1)))

    def whole_board(self) -> None:
        """Zooms out until the whole board is seen."""
        self._windows.picture.whole()
        self._say("body", _("the whole board"))

    def pan_board(self, way: str) -> None:
        """Shows another part of the board; of the whole board there is none."""
        whole = self._windows.picture.pan(*PANS[way]) == 1
        self._say("body", _("the whole board is seen; Z shows it closer") if whole else "")

    def tool_numbers(self) -> None:
        """Shows holes to do by the numbers of their tools, or as dots again."""
        self._say("body", _("tool numbers") if self._windows.picture.turn_numbers() else _("holes as dots"))

    def go_to_hole(self) -> None:
        """Asks for the number of a hole, in drilling order, and goes over it."""
        board = self._console.board()
        if board is None:
            self._say("warning", _("no board is loaded: open a drill file first"))
            return
        prompt = _("Number, 1 to {last}:").format(last=len(board.xy_mm))
        self._shell.ask_text(_("Go to a hole"), prompt, "1", self._go_to_numbered)

    def type_place(self) -> None:
        """Asks for X and Y in mm from the working base, and goes there."""
        self._shell.ask_text(_("Go to X and Y"), _("X and Y in mm from the base:"), "0 0", self._go_to_typed)

    def type_tick_hz(self) -> None:
        """Asks for the interrupt frequency, which takes effect at rest and keeps the position."""
        ask_tick_hz(self._console, self._shell, self._answer, self._say)

    def _go_to_numbered(self, text: str) -> None:
        board = self._console.board()
        if board is None or not text.strip().isdecimal() or not 1 <= int(text) <= len(board.xy_mm):
            self._say("warning", _("there is no hole {text!r}").format(text=text))
            return
        x_mm, y_mm = board.xy_mm[int(text) - 1].tolist()
        self._go_to(x_mm, y_mm)

    def _go_to_typed(self, text: str) -> None:
        place = pair_mm(text)
        if place is None:
            self._say("warning", _("two numbers are wanted, such as 12.7 25.4, not {text!r}").format(text=text))
        else:
            self._go_to(*place)

    def _go_to(self, x_mm: float, y_mm: float) -> None:
        where = _("to X {x:.3f}, Y {y:.3f} mm").format(x=x_mm, y=y_mm)
        self._answer(self._console.go_to(x_mm, y_mm), where)


def _ended(of_board: Progress, resumable: bool) -> str:
    """How far a board was drilled when its job ended, and how the rest can be drilled where that is kept."""
    total = of_board.holes_total
    text = ngettext("ended: {done} of {count} hole in {time}", "ended: {done} of {count} holes in {time}", total)
    summary = text.format(done=of_board.holes_done, count=total, time=clock(of_board.machine_seconds))
    return f"{summary}; {_('S offers to drill the rest')}" if resumable else summary
