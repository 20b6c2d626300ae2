"""What a plant's carriages act on: a thing that is named in the table is told every place, in both plants."""

from collections.abc import Callable

import pytest

from drillctl.machine import Machine
from drillctl.plant import IdealPlant, Plant
from drillctl.plant.carriage import Line
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.plant.effects import EFFECTS
from tests.support.bench import Bench, shipped

SLOT = 15  # steps


class Magazine:
    """A slot for a tool on the first axis; ``state`` is whether the carriage is beyond it."""

    def __init__(self) -> None:
        self.axis, self.state, self.line = 0, False, Line()
        self.places: list[float] = []

    def moved_to(self, steps: float) -> bool:
        self.places.append(steps)
        self.state = steps >= SLOT
        return False

    def changes_at(self) -> tuple[float, float]:
        return (SLOT, 1e9) if self.state else (-1e9, SLOT)


@pytest.mark.parametrize("plant_of", [IdealPlant, DynamicPlant])
def test_a_thing_of_the_table_is_told_where_its_axis_is(
    plant_of: Callable[[Machine], Plant], monkeypatch: pytest.MonkeyPatch
) -> None:
    magazine, machine = Magazine(), shipped("pcb-drill")
    monkeypatch.setitem(EFFECTS, "magazine", lambda _machine, _chucks: magazine)
    plant = plant_of(machine)
    b = Bench(machine, plant=plant).ready()
    assert plant.quiet_steps(0)[1] == SLOT
    b.queue("KMD_RUCH x=25").finish()
    assert magazine.state and plant.quiet_steps(0)[0] == SLOT
    assert max(magazine.places) >= SLOT
    assert set(plant.effects) == {"board", "magazine"}


def test_the_first_head_meets_the_board_once_a_stroke() -> None:
    machine = shipped("pcb-drill")
    plant = IdealPlant(machine)
    Bench(machine, plant=plant).ready().queue("KMD_WIERTLO_DOL; KMD_WIERTLO_GORA; KMD_WIERTLO_DOL").finish()
    assert plant.touches == 2
    assert plant.effects["board"].state, "the bit is down"
