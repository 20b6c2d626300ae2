"""The Plant screen (Tests): what stands behind the simulated machine, ideal or dynamic motors, its faults, its seed.

Rule: one fault of the list is under the cursor. What it does stands below the list, or beside it where there is room;
there it is told of all faults at once, if there are rows enough.
"""

from collections.abc import Sequence

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.models.fault_effects import PLANTS_IN_WORDS, effect_lines, effect_words
from drillctl.ui.screens.folded_screen import FoldedScreen
from drillctl.ui.screens.own_steps import PLANT_STEPS
from drillctl.ui.screens.shell import Shell, choose_another
from drillctl.ui.widgets.dialogs import Answered, Field
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.panel import BORDER_COLUMNS, panel_columns, with_panel
from drillctl.ui.widgets.texts import Line, Size, boxed, width_of
from drillctl.viewmodel.console import Console, MachineView, Problems
from drillctl.viewmodel.plant import FaultWord, PlantControl, PlantView

LABEL_COLUMNS, USAGE_COLUMNS, RANGE_COLUMNS = 14, 19, 10
FACT_ROWS = 5  # above the list of faults
LIST_COLUMNS = 78  # of the list of faults, in any language
KINDS = {"ideal": N_("ideal"), "dynamic": N_("dynamic")}


class PlantScreen(FoldedScreen):
    """Shows the plant of the machine in use, and the faults that a dynamic one can have."""

    title = N_("Plant and faults")
    own_steps = PLANT_STEPS
    keys = (
        Key(("f6",), "F6", "choose_plant", N_("ideal or dynamic motors; the machine starts anew"), N_("Plant")),
        Key(
            ("enter",),
            "Enter",
            "ask",
            N_("faults and seed of the dynamic plant; the machine starts anew"),
            N_("Faults"),
        ),
        Key(("up",), N_("Up"), "go", N_("a line up"), argument=-1),
        Key(("down",), N_("Down"), "go", N_("a line down"), argument=1),
    )

    def __init__(self, console: Console, shell: Shell, control: PlantControl, plain: bool = False):
        self._shell, self._control, self._plain = shell, control, plain
        self._plant = control.plant()
        self._at = 0  # the fault under the cursor

    def refresh(self, view: MachineView) -> None:
        """Redraws if the plant is another one."""
        plant = self._control.plant()
        if plant != self._plant:
            self._plant = plant
            self._invalidate()

    def lines(self) -> Sequence[Line]:
        """The plant, then the faults that it can have."""
        return plant_lines(self._plant, self._at, LIST_COLUMNS)

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws plant and faults; what faults do below them or, with a drawing, beside them."""
        assert len(size) == 2
        columns, rows = size
        beside = panel_columns(columns, LIST_COLUMNS)
        left = columns - beside
        lines = folded(plant_lines(self._plant, self._at, left), left)
        if beside >= LIST_COLUMNS - BORDER_COLUMNS:
            lines += [[], *folded(_in_words(), left)]
            panel = _effects(self._plant.words, self._at, (beside - BORDER_COLUMNS, rows - 1), self._plain)
            return with_panel(boxed(lines, left, rows), _("What a fault does"), panel, beside, rows)
        drawn = [[], *effect_lines(self._fault, columns, self._plain)]
        about = drawn if len(lines) + len(drawn) <= rows else effect_words(self._fault, columns)
        return boxed([*lines[: max(rows - len(about), 0)], *about], columns, rows)

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Sets the cursor on the fault that is clicked."""
        at = row - FACT_ROWS
        if event != "mouse press" or button != 1 or not 0 <= at < len(self._plant.words):
            return False
        self.go(at - self._at)
        return True

    @property
    def _fault(self) -> str:
        """How the fault under the cursor is written."""
        return self._plant.words[self._at].usage

    def go(self, by: int) -> None:
        """Moves the cursor by so many faults; it stops at the ends."""
        self._at = max(0, min(self._at + by, len(self._plant.words) - 1))
        self._invalidate()

    def choose_plant(self) -> None:
        """Offers the ideal and the dynamic plant."""
        now = None if self._plant.real_port else [*KINDS].index(self._plant.kind)
        lines = [_("ideal: motors go where they are sent"), _("dynamic: motors have inertia, and can lose steps")]
        choose_another(self._shell, _("Plant"), lines, now, lambda index: self._swap())

    def _swap(self) -> None:
        """Changes to the other plant; a refusal is told."""
        problems = self._changed(self._control.swap())
        if problems:
            self._shell.message(_("Nothing changed"), [translated(problem) for problem in problems])

    def ask(self) -> None:
        """Asks for faults and seed; the box stays open, and says why, while they can't be had."""
        fields = [Field(_("Faults"), " ".join(self._plant.faults)), Field(_("Seed"), str(self._plant.seed))]
        self._shell.ask_fields(_("Faults of the dynamic plant"), fields, self._accept)

    def _accept(self, texts: list[str], answered: Answered) -> None:
        faults, seed = texts
        answered(self._changed(self._control.choose(faults, seed)))

    def _changed(self, problems: Problems) -> Problems:
        self._plant = self._control.plant()
        self._invalidate()
        return problems


def plant_lines(plant: PlantView, at: int, columns: int) -> list[Line]:
    """The plant in use, a line for each fact; then the faults with their ranges, and the names that they take. What
    the faults are is left out where there are too few columns for one of them.
    """
    faults = [_fault_line(word, number == at) for number, word in enumerate(plant.words)]
    if max(map(width_of, faults), default=0) > columns:
        faults = [fault[:-1] for fault in faults]
    in_use = _("{port}, a real machine").format(port=plant.real_port) if plant.real_port else _(KINDS[plant.kind])
    return [
        _labelled(_("In use"), in_use),
        _labelled(_("Faults"), " ".join(plant.faults) or _("none")),
        _labelled(_("Seed"), str(plant.seed)),
        [""],
        [("title", _("Faults of the dynamic plant"))],
        *faults,
        [_("SENSOR: {names}").format(names=", ".join(plant.sensors))],
        [_("AXIS: {names}").format(names=", ".join(plant.axes))],
        [""],
        [_("Any change starts the machine anew: position and board are forgotten.")],
    ]


def _fault_line(word: FaultWord, chosen: bool) -> Line:
    usage = f"{'>' if chosen else ' '}{word.usage:{USAGE_COLUMNS}}"
    bounds = f"{word.least:g}..{word.most:g}"
    return [("key" if chosen else "title", usage), f"{bounds:{RANGE_COLUMNS}}", translated(word.meaning)]


def _in_words() -> list[Line]:
    """What the help says of plants and of trying a fault, for where there is room."""
    return [[("dark", _(line))] for line in PLANTS_IN_WORDS]


def _effects(words: Sequence[FaultWord], at: int, size: tuple[int, int], plain: bool) -> list[Line]:
    """What the faults do: of all, drawn or in words, where there are rows for it; else of the one under the cursor."""
    columns, rows = size
    heads: list[Line] = [[("key" if number == at else "title", word.usage)] for number, word in enumerate(words)]
    drawn = [[head, *effect_lines(word.usage, columns, plain), []] for head, word in zip(heads, words, strict=True)]
    told = [[head, *effect_words(word.usage, columns)] for head, word in zip(heads, words, strict=True)]
    for parts in (drawn, [*told[:at], drawn[at][:-1], *told[at + 1 :]]):
        if sum(map(len, parts)) <= rows:
            return [line for part in parts for line in part]
    return drawn[at]


def _labelled(label: str, text: str) -> Line:
    return [("title", f"{label:{LABEL_COLUMNS}}"), text]
