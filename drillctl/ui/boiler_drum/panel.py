"""The Panel: the machine's own keys and display, and beside them, where there is room, the part program and the wall.

Rule: every key does what the same key of the machine does, and one that makes no sense now changes nothing and says why
in the bottom line. What the keys mean on the display is in monitor.py.
"""

import urwid

from drillctl.language import Message
from drillctl.language.words import N_, _
from drillctl.ui.boiler_drum.keypad import PanelKey
from drillctl.ui.boiler_drum.next_step import next_step
from drillctl.ui.boiler_drum.panel_windows import PanelWindows, Shown
from drillctl.ui.boiler_drum.programming import HEX_KEYS, Programming
from drillctl.ui.screens.jog_controls import STEPS, JogControls
from drillctl.ui.screens.shell import Shell
from drillctl.ui.screens.tick_rate import ask_tick_hz
from drillctl.ui.widgets.keys import Key, called
from drillctl.ui.widgets.sizes import layout
from drillctl.ui.widgets.texts import Size, Text
from drillctl.viewmodel.console import Console, MachineView


class Panel(Programming, JogControls, urwid.WidgetWrap[urwid.Widget]):
    """The screen of the boiler-drum drill; ``refresh`` is called with the newest view."""

    title = N_("Panel")
    has_windows = True
    keys = (
        Key(HEX_KEYS, "0-9 A-F", "typed_digit", N_("types a digit: of an address, a content, a workpiece's number")),
        Key(("backspace",), N_("Backspace"), "rub_out", N_("takes the last digit back")),
        Key(("m",), "M", "memory", N_("MEM: shows the cell of the address that is typed"), "MEM"),
        Key(("+", "="), "+", "next_cell", N_("ADR+: the next cell"), argument=1),
        Key(("-",), "-", "next_cell", N_("ADR-: the cell before"), argument=-1),
        Key(("p",), "P", "call_workpiece", N_("PROG: calls the workpiece whose number is typed"), "PROG"),
        Key(("l",), "L", "list_workpieces", N_("lists the workpieces of both stores, to be called"), N_("List")),
        Key(("s",), "S", "start", N_("AUTO: runs the workpiece that was called"), "AUTO"),
        Key((" ",), N_("Space"), "pause", N_("the pause switch: brakes down the ramps"), N_("Pause")),
        Key(("g",), "G", "resume", N_("CONT: goes on after a pause"), "CONT"),
        Key(("z",), "Z", "return_to_zero", N_("ZERO: the tool back to zero, then the large carriage"), "ZERO"),
        Key(("left",), N_("Left"), "jog_back", N_("X-: the large carriage back by a step"), argument=0),
        Key(("right",), N_("Right"), "jog_on", N_("X+: the large carriage on by a step"), argument=0),
        Key(("down",), N_("Down"), "jog_back", N_("Y-: the tool out by a step"), argument=1),
        Key(("up",), N_("Up"), "jog_on", N_("Y+: the tool in by a step"), argument=1),
        Key(("i",), "I", "initialise", N_("takes this place as zero; asks first"), N_("Init")),
        Key(("r",), "R", "reset", N_("RESET: as power-on; this place becomes zero; asks first"), "RESET"),
        Key(("k",), "K", "acknowledge", N_("the fault has been seen")),
    )

    def __init__(self, console: Console, shell: Shell, plain: bool = False):
        JogControls.__init__(self, console)
        Programming.__init__(self, console, shell)
        self._sizes.unit, self._sizes.chosen[STEPS] = STEPS, 1  # the panel's jog keys make one step a press
        self._windows = PanelWindows(self._click, plain)
        self._footer = Text("")
        urwid.WidgetWrap.__init__(self, urwid.Frame(self._windows, footer=self._footer))
        self.refresh(console.view())

    def selectable(self) -> bool:
        """True: the screen takes keys although no widget in it does."""
        return True

    def keypress(self, size: Size, key: str) -> str | None:
        """Clears the last answer and calls the method of a key in the table; returns any other key."""
        self._note, self._pressed = ("body", ""), key.lower()
        taken = called(self, self.keys, key)
        self._pressed = ""
        return None if taken else key

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Lays the windows out for this size."""
        assert len(size) == 2
        self._windows.lay_out(layout(*size), size[0], size[1] - self._footer.rows(size[:1]))
        return super().render(size, focus)

    def refresh(self, view: MachineView) -> None:
        """Draws what changed in machine, display and program."""
        stores = self._stores()
        part, number, done = stores.called(), stores.sentence(), stores.done()
        figures = part.sentences[number - 1].text if part and number else self._monitor.figures()
        self._windows.show(Shown(view, self._console.progress(), part, number, done, figures))
        self._footer.set_text([" ", self._note])

    def start(self) -> None:
        """Runs the workpiece that was called; asks first where this place is not zero yet, or the machine is real."""
        part = self._stores().called()
        if not self._free():
            return
        if part is None:
            self._run()  # the console says what is missing
            return
        view = self._console.view()
        real = _("A real machine is connected to {port}.").format(port=view.port)
        reasons = [real] if view.lost_steps is None else []
        if not view.position_known or any(axis.position_steps for axis in view.axes):
            reasons.append(_("This place becomes zero: the tool has to stand where it was set for the workpiece."))
        if reasons:
            self._shell.ask(" ".join([*reasons, _("Run workpiece {number:02}?").format(number=part.number)]), self._run)
        else:
            self._run()

    def pause(self) -> None:
        """Stops the pulses down the ramp; the program goes on with CONT."""
        self._answer(self._console.hold(), _("pause"))

    def resume(self) -> None:
        """Goes on after a pause."""
        self._answer(self._console.resume(), _("going on"))

    def stop(self) -> None:
        """Ends the program; the position is kept."""
        self._answer(self._console.stop(), _("stop; the position is kept"))

    def emergency_stop(self) -> None:
        """Stops the machine in the way that its file names, and ends the program."""
        self._console.emergency_stop()

    def acknowledge(self) -> None:
        """Acknowledges a fault whose cause was put right, so that keys move the machine again."""
        self._answer(self._console.acknowledge(), _("acknowledged"))

    def return_to_zero(self) -> None:
        """Returns the tool to zero, then the large carriage; acknowledges a fault that waits first."""
        if self._console.view().condition == "latched":
            self._answer(self._console.acknowledge(), _("acknowledged; ZERO once more returns the tool to zero"))
            return
        self._answer(self._stores().return_to_zero(), _("return to zero"))

    def initialise(self) -> None:
        """Takes this place as zero, after a question."""
        if self._free():
            question = _("Take this place as zero? Nothing moves; X and Y are counted from here.")
            self._shell.ask(question, lambda: self._answer(self._console.initialise(), _("this place is zero")))

    def reset(self) -> None:
        """As power-on, after a question: the prompt, no workpiece called, this place is zero."""
        if self._free():
            question = _("Reset? The workpiece that was called is forgotten, and this place becomes zero.")
            self._shell.ask(question, self._reset)

    def type_tick_hz(self) -> None:
        """Asks for the interrupt frequency, which takes effect at rest and keeps the position."""
        ask_tick_hz(self._console, self._shell, self._answer, self._say)

    def _reset(self) -> None:
        problems = self._console.initialise()
        if not problems:
            self._monitor.clear()
            self._stores().forget()
        self._answer(problems, _("reset: this place is zero"))

    def _run(self) -> None:
        self._answer(self._stores().run(), _("automatic run"))

    def _click(self, key: PanelKey) -> None:
        self._note = ("body", "")
        method = getattr(self, key.method)
        method() if key.argument is None else method(key.argument)

    def _free(self) -> bool:
        """Whether something new can be begun now; where it can't, the bottom line says why."""
        refuses = next_step(self._console, self._console.view()).refuses
        if refuses:
            self._answer((Message(refuses),))
        return not refuses
