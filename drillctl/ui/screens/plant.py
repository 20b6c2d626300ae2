"""The Plant screen (Tests): what stands behind the simulated machine, ideal or dynamic motors, its faults, its seed."""

from collections.abc import Sequence

from drillctl.language.words import N_, _, translated
from drillctl.ui.screens.folded_screen import FoldedScreen
from drillctl.ui.screens.shell import Shell
from drillctl.ui.widgets.dialogs import Answered, Field
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import Console, MachineView, Problems
from drillctl.viewmodel.plant import FaultWord, PlantControl, PlantView

LABEL_COLUMNS, USAGE_COLUMNS, RANGE_COLUMNS = 14, 19, 10
KINDS = {"ideal": N_("ideal"), "dynamic": N_("dynamic")}


class PlantScreen(FoldedScreen):
    """Shows the plant of the machine in use, and the faults that a dynamic one can have."""

    title = N_("Plant and faults")
    keys = (
        Key(("f6",), "F6", "swap", N_("ideal or dynamic motors, in turn; the machine starts anew"), N_("Plant")),
        Key(
            ("enter",),
            "Enter",
            "ask",
            N_("faults and seed of the dynamic plant; the machine starts anew"),
            N_("Faults"),
        ),
    )

    def __init__(self, console: Console, shell: Shell, control: PlantControl):
        self._shell, self._control = shell, control
        self._plant = control.plant()

    def refresh(self, view: MachineView) -> None:
        """Redraws if the plant is another one."""
        plant = self._control.plant()
        if plant != self._plant:
            self._plant = plant
            self._invalidate()

    def lines(self) -> Sequence[Line]:
        """The plant, then the faults that it can have."""
        return plant_lines(self._plant)

    def swap(self) -> None:
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


def plant_lines(plant: PlantView) -> list[Line]:
    """The plant in use, a line for each fact; then the faults with their ranges, and the names that they take."""
    in_use = _("{port}, a real machine").format(port=plant.real_port) if plant.real_port else _(KINDS[plant.kind])
    return [
        _labelled(_("In use"), in_use),
        _labelled(_("Faults"), " ".join(plant.faults) or _("none")),
        _labelled(_("Seed"), str(plant.seed)),
        [""],
        [("title", _("Faults of the dynamic plant"))],
        *map(_fault_line, plant.words),
        [""],
        [_("SENSOR: {names}").format(names=", ".join(plant.sensors))],
        [_("AXIS: {names}").format(names=", ".join(plant.axes))],
        [""],
        [_("Any change starts the machine anew: position and board are forgotten.")],
    ]


def _fault_line(word: FaultWord) -> Line:
    bounds = f"{word.least:g}..{word.most:g}"
    return [("title", f"{word.usage:{USAGE_COLUMNS}}"), f"{bounds:{RANGE_COLUMNS}}", translated(word.meaning)]


def _labelled(label: str, text: str) -> Line:
    return [("title", f"{label:{LABEL_COLUMNS}}"), text]
