"""The plant of the simulated machine, chosen at the desk: ideal or dynamic, its faults, its seed.

Rule: a change starts the machine anew, as the change to another machine does; what can't be had changes nothing.
"""

from drillctl.console.machine_console import MachineConsole
from drillctl.language import Message
from drillctl.plant import IDEAL_PLANT, PlantChoice
from drillctl.plant.choice import DYNAMIC, GREATEST_SEED, IDEAL
from drillctl.plant.faults import FAULT_KINDS, usage
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.plant import FaultWord, PlantView

WORDS = tuple(FaultWord(usage(name), kind.least, kind.most, kind.meaning) for name, kind in FAULT_KINDS.items())


class MachinePlant:
    """A PlantControl (viewmodel/plant.py) over the machine in use."""

    def __init__(self, console: MachineConsole):
        self._console = console

    def plant(self) -> PlantView:
        """The plant in use, and the faults that there are."""
        used = self._console.used
        choice, machine = used.running.plant, used.machine
        sensors = tuple(sensor.name for sensor in machine.sensors)
        port = used.port
        return PlantView(
            choice.kind, choice.faults, choice.seed, WORDS, sensors, tuple(machine.axis_names),
            port.in_use if port.real else "",
        )  # fmt: skip

    def swap(self) -> Problems:
        """From the ideal plant to the dynamic one without faults, and back; the seed is kept."""
        now = self._console.used.running.plant
        return self._change(PlantChoice(DYNAMIC if now.kind == IDEAL else IDEAL, (), now.seed))

    def choose(self, faults: str, seed: str) -> Problems:
        """The dynamic plant with these faults and this seed; an empty seed is 0."""
        number = seed.strip() or str(IDEAL_PLANT.seed)
        if not (number.isascii() and number.isdecimal()) or int(number[:20]) > GREATEST_SEED:
            return (
                Message(
                    "the seed is a whole number from 0 to {most}, not {seed!r}", most=GREATEST_SEED, seed=seed[:20]
                ),
            )
        return self._change(PlantChoice(DYNAMIC, tuple(faults.replace(",", " ").split()), int(number)))

    def _change(self, choice: PlantChoice) -> Problems:
        return self._console.change(lambda used: used.choose_plant(choice))
