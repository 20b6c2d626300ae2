"""Placing a board by holes measured on it: go or jog to each, say that this is the hole, see how well they agree.

Rule: nothing is placed before F2, and not at all by holes that contradict each other; Esc leaves everything as it was.
What is shown counts from the working base, as the operator does; what is kept counts from machine zero.
"""

from collections.abc import Callable, Sequence
from textwrap import wrap

import urwid

from drillctl.language import Message
from drillctl.language.number_text import pair_mm
from drillctl.language.words import N_, _, translated
from drillctl.ui.pcb_drill.measuring import LEAST_HOLES, Measuring, PlaceMm
from drillctl.ui.screens.jog_controls import JOG_KEYS, JogControls
from drillctl.ui.screens.shell import Shell
from drillctl.ui.widgets.dialogs import Answered
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import UNDO_KEYS, Key, called
from drillctl.ui.widgets.texts import Line, Size, boxed, width_of
from drillctl.viewmodel.console import AxisView, BoardView, Console, MachineView
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole

WIDTH = 78
NONE_TO_SPARE = 3  # holes that fix shift, turn, scale and shear just so: their residuals are 0, whatever was measured


class AlignmentScreen(JogControls, urwid.WidgetWrap[urwid.Widget]):
    """``accept`` places the board by the holes measured, by none of them: as it was asked before. It is called with the
    holes, and with what is to be called with the problems.
    """

    title = N_("Measured holes")
    keys = (
        Key(("tab",), "Tab", "go", N_("the next hole of the list"), N_("Next"), 1),
        Key(("shift tab",), "Shift-Tab", "go", N_("the hole before"), argument=-1),
        Key(("g",), "G", "go_there", N_("goes over the hole, where it should be"), N_("Go there")),
        Key(("enter",), "Enter", "found", N_("the drill stands over the hole: this is its place"), N_("Found")),
        Key(("t",), "T", "type_place", N_("types the X and Y of the hole in mm"), N_("Type")),
        Key(("insert",), "Ins", "add", N_("measures another hole, by its number"), N_("Add")),
        Key(("delete",), "Del", "remove", N_("takes the hole off the list"), N_("Off")),
        Key(("f2",), "F2", "use", N_("places the board by these holes; with none, as before"), N_("Use")),
        *UNDO_KEYS,
        *JOG_KEYS,
    )

    def __init__(
        self, console: Console, shell: Shell, board: BoardView, options: JobOptions,
        accept: Callable[[tuple[MeasuredHole, ...], Answered], object],
    ):  # fmt: skip
        JogControls.__init__(self, console)
        self._shell, self._accept = shell, accept
        self.measuring = Measuring(board, options.measured, options.mirror is not None, console.align)
        self._at = 0
        self._paper = _Paper()
        urwid.WidgetWrap.__init__(self, self._paper)
        self.refresh(console.view())

    def selectable(self) -> bool:
        """True: the screen takes keys although no widget in it does."""
        return True

    def keypress(self, size: Size, key: str) -> str | None:
        """Calls the method of a key in the table; returns any other key for the frame."""
        return None if called(self, self.keys, key) else key

    def refresh(self, view: MachineView) -> None:
        """Draws the holes, the verdict and the position anew."""
        wide, narrow = (
            [*measuring_lines(self.measuring, self._at, base_mm(view.axes), with_file), [], _here(view), self._bottom()]
            for with_file in (True, False)
        )
        self._paper.show(wide, narrow)

    def go(self, by: int) -> None:
        """Moves the cursor by so many holes; after the last comes the first."""
        if self.measuring.spots:
            self._at = (self._at + by) % len(self.measuring.spots)
        self._say("body", "")

    def go_there(self) -> None:
        """Moves the drill, raised first, over the place where the hole should be."""
        if not self.measuring.spots:
            return
        base = base_mm(self._console.view().axes)
        x_mm, y_mm = self.measuring.expected_mm(self._at, base)
        x_mm, y_mm = x_mm - base[0], y_mm - base[1]
        way = _("to X {x:.3f}, Y {y:.3f} mm").format(x=x_mm, y=y_mm)
        self._answer(self._console.go_to(x_mm, y_mm), way)

    def found(self) -> None:
        """Takes the drill's position as the place of the hole, if it is known and the machine at rest."""
        view = self._console.view()
        if not view.position_known:
            self._say("warning", _("the position is not known: initialise first"))
        elif view.moving:
            self._say("warning", _("the machine is moving"))
        else:
            x_mm, y_mm = (axis.position_steps / axis.steps_per_mm for axis in view.axes[:2])
            self._find((x_mm, y_mm))

    def type_place(self) -> None:
        """Asks for the place of the hole, measured by other means."""
        if self.measuring.spots:
            prompt = _("X and Y in mm from the base:")
            self._shell.ask_text(_("Measured holes"), prompt, "", self._find_typed)

    def add(self) -> None:
        """Asks for the number, in drilling order, of another hole to be measured."""
        self._shell.ask_text(_("Measured holes"), _("Number of the hole:"), "", self._add_numbered)

    def remove(self) -> None:
        """Takes the hole under the cursor off the list."""
        if self.measuring.spots:
            self.measuring.remove(self._at)
            self._at = max(0, min(self._at, len(self.measuring.spots) - 1))
        self._say("body", "")

    def undo(self) -> None:
        """Takes the last change of the list back."""
        self.measuring.undo()
        self._changed_back()

    def redo(self) -> None:
        """Makes the change again that was undone last."""
        self.measuring.redo()
        self._changed_back()

    def _changed_back(self) -> None:
        self._at = max(0, min(self._at, len(self.measuring.spots) - 1))
        self._say("body", "")

    def use(self) -> None:
        """Places the board by the holes found, and goes back to the Files screen."""
        if self.measuring.measured and not self.measuring.sound:
            self._say("warning", _("these holes can't place the board: see above"))
        else:
            self._accept(self.measuring.measured, self._placed)

    def _placed(self, problems: Sequence[Message]) -> None:
        """Leaves the screen if the board could be placed, else says why not."""
        if problems:
            self._shell.message(_("Refused"), [translated(problem) for problem in problems])
        else:
            self._shell.back()

    def _add_numbered(self, text: str) -> None:
        if text.strip().isdecimal() and self.measuring.add(int(text)):
            self._at = len(self.measuring.spots) - 1
            self._say("body", "")
        else:
            self._say("warning", _("hole {text!r} can't be added").format(text=text))

    def _find_typed(self, text: str) -> None:
        pair = pair_mm(text)
        if pair is None:
            self._say("warning", _("two numbers are wanted, such as 12.7 25.4, not {text!r}").format(text=text))
        else:
            base = base_mm(self._console.view().axes)
            self._find((pair[0] + base[0], pair[1] + base[1]))

    def _find(self, place_mm: PlaceMm) -> None:
        if self.measuring.spots:
            self.measuring.find(self._at, place_mm)
        self._say("body", "")


class _Paper(urwid.Widget):
    """A box of lines that is redrawn when they change: wide ones, or narrow ones where those have no room."""

    _sizing = frozenset([urwid.Sizing.BOX])
    _wide: list[Line] = []
    _narrow: list[Line] = []

    def show(self, wide: list[Line], narrow: list[Line]) -> None:
        if wide != self._wide:
            self._wide, self._narrow = wide, narrow
            self._invalidate()

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        assert len(size) == 2
        columns, _rows = size
        lines = self._wide if columns >= WIDTH else self._narrow
        fitting = [row for line in lines for row in ([line] if width_of(line) <= columns else folded([line], columns))]
        return boxed(fitting, *size)


def base_mm(axes: tuple[AxisView, ...]) -> PlaceMm:
    """The working base, X and Y in mm from machine zero."""
    x, y = (axis.position_steps / axis.steps_per_mm - axis.position_mm for axis in axes[:2])
    return x, y


def measuring_lines(measuring: Measuring, at: int, base: PlaceMm, with_file: bool) -> list[Line]:
    """A line for each hole, that of index ``at`` marked; then what they say together. ``with_file``: with the places
    that the file has.
    """
    in_file = f"{_('in the file, mm'):>21}  " if with_file else ""
    header = f"  {_('hole'):>6}  {in_file}{_('found, mm'):>21}  {_('off by'):>9}"
    rows = [_row(measuring, index, index == at, base, with_file) for index in range(len(measuring.spots))]
    return [[("title", header)], *rows, [], *_verdict(measuring)]


def _row(measuring: Measuring, index: int, marked: bool, base: PlaceMm, with_file: bool) -> Line:
    spot, off_mm = measuring.spots[index], measuring.residual_mm(index)
    found = "-" if spot.found_mm is None else f"X{spot.found_mm[0] - base[0]:.3f} Y{spot.found_mm[1] - base[1]:.3f}"
    place = f"X{spot.file_mm[0]:.3f} Y{spot.file_mm[1]:.3f}"
    in_file = f"{place:>21}  " if with_file else ""
    off = "" if off_mm is None else f"{off_mm:.3f} mm"
    line = f"{'>' if marked else ' '} {spot.number:>6}  {in_file}{found:>21}  {off:>9}"
    return [("focus" if marked else "body", line)]


def _verdict(measuring: Measuring) -> list[Line]:
    found = measuring.alignment
    problems: list[Line] = [
        [("danger", line)]
        for problem in measuring.problems
        for line in wrap(_("problem: ") + translated(problem), WIDTH)
    ]
    if found is None:
        wanted = _("{count} holes at least are to be found; three tell scale and shear too").format(count=LEAST_HOLES)
        return problems or [[wanted]]
    (x, y), turn = found.scale, found.turn_deg
    lies = _("turned {turn:.3f}°, scale {x:.4f} {y:.4f}").format(turn=turn, x=x, y=y)
    hints: list[Line] = [
        [("danger" if text in found.rejected else "warning", line)]
        for text in found.warnings
        for line in wrap(f"- {translated(text)}", WIDTH, subsequent_indent="  ")
    ]
    if found.kind == "affine" and len(found.residual_mm) == NONE_TO_SPARE:
        hints.append([_("three holes fit exactly, so nothing checks them; a fourth would")])
    rejected = ("danger", _("REJECTED: this is not how the board lies"))
    return [[lies], *hints, [rejected if found.rejected else ("good", _("accepted: F2"))]]


def _here(view: MachineView) -> Line:
    places = (f"{axis.name.upper()} {axis.position_mm:.3f} mm ({axis.position_steps})" for axis in view.axes[:3])
    state = _("moving") if view.moving else _("at rest")
    return [("title", f"{_('Drill')}: "), f"{'  '.join(places)}  {state}"]
