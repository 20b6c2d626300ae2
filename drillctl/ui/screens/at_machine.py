"""What the screens at the machine have in common: the jog keys, and the bottom line that answers what was asked.

Rule: a request that is refused says why in that line. Drilling and the alignment screen are made of this.
"""

from drillctl.language.sentences import told
from drillctl.language.words import N_, _
from drillctl.ui.models.jog_sizes import JogSizes
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.lines import Line
from drillctl.viewmodel.console import Console, MachineView, Problems

JOG_KEYS = (
    Key(("left",), N_("Left"), "jog_back", N_("first axis back by a step size"), argument=0),
    Key(("right",), N_("Right"), "jog_on", N_("first axis on by a step size"), argument=0),
    Key(("down",), N_("Down"), "jog_back", N_("second axis back by a step size"), argument=1),
    Key(("up",), N_("Up"), "jog_on", N_("second axis on by a step size"), argument=1),
    Key(("page up",), "PgUp", "jog_back", N_("third axis back: the head up"), argument=2),
    Key(("page down",), "PgDn", "jog_on", N_("third axis on: the head down"), argument=2),
    Key(("+", "="), "+", "step_size", N_("the next step size of a jog"), argument=1),
    Key(("-",), "-", "step_size", N_("the step size before"), argument=-1),
    Key(("m",), "M", "jog_unit", N_("step sizes in millimetres, or in steps again")),
)


class AtMachine:
    """A screen's part that talks to the machine; the screen has JOG_KEYS among its keys and ``refresh`` of its own."""

    def __init__(self, console: Console):
        self._console = console
        self._sizes = JogSizes()
        self._note: tuple[str, str] = ("body", "")

    def refresh(self, view: MachineView) -> None:
        """Draws what changed."""
        raise NotImplementedError  # by the screen that this is a part of

    def jog_on(self, axis: int) -> None:
        """By the step size."""
        self._jog(axis, 1)

    def jog_back(self, axis: int) -> None:
        """By the step size."""
        self._jog(axis, -1)

    def step_size(self, change: int) -> None:
        """The next or the one before; the ends stay."""
        self._sizes.change(change)
        self.refresh(self._console.view())

    def jog_unit(self) -> None:
        """Each unit keeps its size."""
        self._sizes.other_unit()
        self.refresh(self._console.view())

    def _bottom(self, *between: str | tuple[str, str]) -> Line:
        """The step size, what else there is to say, and the last answer."""
        return [("field", f" {self._sizes} "), " ", *between, self._note]

    def _jog(self, index: int, sign: int) -> None:
        axes = self._console.view().axes
        if index >= len(axes):
            self._say("warning", _("this machine has no such axis"))
            return
        steps = sign * self._sizes.steps(axes[index])
        name = axes[index].name
        self._answer(self._console.jog(name, steps), f"{name.upper()} {steps:+d}")

    def _answer(self, problems: Problems, done: str = "") -> None:
        if problems:
            self._say("warning", _("refused: {why}").format(why="; ".join(map(told, problems))))
        else:
            self._say("body", done)

    def _say(self, attribute: str, text: str) -> None:
        self._note = (attribute, text)
        self.refresh(self._console.view())
