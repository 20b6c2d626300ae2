"""The jog keys that screens at the machine share: how far a press goes, and the bottom line that answers it.

Rule: a request that is refused says why in that line.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from drillctl.language.words import N_, _, translated
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import AxisView, Console, MachineView, Problems

STEPS, MM = N_("steps"), N_("mm")
# In steps: a column, a rest, a cycle of pcb-drill's table, a tenth and an inch.
JOG_SIZES: Mapping[str, Sequence[float]] = {STEPS: (1, 3, 12, 120, 1200), MM: (0.1, 1, 10)}
FIRST_SIZES: Mapping[str, float] = {STEPS: 12, MM: 1}


@dataclass
class JogSizes:
    """The unit of the jog step, and the size chosen in each unit."""

    unit: str = STEPS
    chosen: dict[str, float] = field(default_factory=lambda: dict(FIRST_SIZES))

    def change(self, by: int) -> None:
        """Takes the next larger or smaller size; it stops at the ends."""
        sizes = JOG_SIZES[self.unit]
        index = sizes.index(self.chosen[self.unit]) + by
        self.chosen[self.unit] = sizes[min(max(index, 0), len(sizes) - 1)]

    def other_unit(self) -> None:
        """Changes between steps and millimetres; each unit keeps its size."""
        self.unit = MM if self.unit == STEPS else STEPS

    def steps(self, axis: AxisView) -> int:
        """The jog step in steps of an axis, at least one."""
        size = self.chosen[self.unit]
        return max(1, round(size * axis.steps_per_mm if self.unit == MM else size))

    def __str__(self) -> str:
        return _("jog step {size} {unit}").format(size=self.chosen[self.unit], unit=_(self.unit))


JOG_KEYS = (
    Key(("left",), N_("Left"), "jog_back", N_("first axis back by a step size"), argument=0),
    Key(("right",), N_("Right"), "jog_on", N_("first axis on by a step size"), argument=0),
    Key(("down",), N_("Down"), "jog_back", N_("second axis back by a step size"), argument=1),
    Key(("up",), N_("Up"), "jog_on", N_("second axis on by a step size"), argument=1),
    Key(("page up",), "PgUp", "jog_back", N_("third axis back: the head up"), argument=2),
    Key(("page down",), "PgDn", "jog_on", N_("third axis on: the head down"), argument=2),
    Key(("+", "="), "+", "step_size", N_("the next step size of a jog"), argument=1),
    Key(("-",), "-", "step_size", N_("the step size before"), argument=-1),
    Key(("*",), "*", "jog_unit", N_("step sizes in millimetres, or in steps again")),
)


class JogControls:
    """A screen's part that talks to the machine; the screen has JOG_KEYS among its keys and ``refresh`` of its own."""

    def __init__(self, console: Console):
        self._console = console
        self._sizes = JogSizes()
        self._note: tuple[str, str] = ("body", "")

    def refresh(self, view: MachineView) -> None:
        """Draws what changed; every screen with jog keys has its own."""
        raise NotImplementedError  # by the screen that this is a part of

    def jog_on(self, axis: int) -> None:
        """Moves the axis of this index on by the jog step."""
        self._jog(axis, 1)

    def jog_back(self, axis: int) -> None:
        """Moves the axis of this index back by the jog step."""
        self._jog(axis, -1)

    def step_size(self, change: int) -> None:
        """Takes the next larger or smaller jog step; it stops at the ends."""
        self._sizes.change(change)
        self.refresh(self._console.view())

    def jog_unit(self) -> None:
        """Changes the unit of the jog step."""
        self._sizes.other_unit()
        self.refresh(self._console.view())

    def _bottom(self, *between: str | tuple[str, str]) -> Line:
        """The bottom line: the jog step, what stands ``between``, and the last answer."""
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
            self._say("warning", _("refused: {why}").format(why="; ".join(map(translated, problems))))
        else:
            self._say("body", done)

    def _say(self, attribute: str, text: str) -> None:
        self._note = (attribute, text)
        self.refresh(self._console.view())
