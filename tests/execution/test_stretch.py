"""The dynamic plant in stretches against the law: trace, holes, currents, and all that is remembered, to the bit.

Programs hold every command; faults, scatter and tick rates vary; holds, stops, gaps and looks come at any tick.
"""

from dataclasses import fields

import pytest
from hypothesis import given, seed, settings
from hypothesis import strategies as st

from drillctl.execution.fastforward.stretch import Images
from drillctl.generation.job import names_of
from drillctl.kmd import Fault, Op, Queue, parse_program
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.plant import PlantChoice
from drillctl.plant.dynamic import law, motors
from drillctl.plant.dynamic.coefficients import Coefficients
from drillctl.plant.dynamic.kernel import KERNEL
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ticker.stretch_ticker import StretchTicker
from drillctl.ticker.ticker import Ticker
from drillctl.trace import first_difference, render
from tests.execution.test_fastforward import commands, disturbances
from tests.support.twins import Disturbances, ran, remembered, trace

LIBRARY = Library((shipped_tables(),))
DYNAMIC = [
    machine.name
    for machine in map(LIBRARY.machine, ["pcb-drill", "pcb-drill-ramp-lab", "eight-axis", "boiler-drum", "cnc-shield"])
    if all(axis.dynamics for axis in machine.axes)
]
FAULTS = [
    "blunt=3", "broken=1", "loose.x=0.4", "jammed.y=3", "bouncing.z_top=7", "bouncing.x_min=40", "dirty.z_bottom=1",
    "stuck.x_min=1", "stuck.z_top=0", "worn.z3=7.999", "breaks.z2=1",
]  # fmt: skip
FINE_HZ = 10_000  # ticks from here on belong to the ramps of their machine
TICKS = 9000 if KERNEL.compiled else 3000
BOARD = "KMD_INICJALIZACJA\n" + "KMD_GOTO_X_Y {} {}\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\n" * 3


def twins(machine: Machine, choice: PlantChoice, text: str, asked: Disturbances, ticks: int) -> tuple[Ticker, Ticker]:
    program = parse_program(text, names_of(machine))
    program["tag"] = range(len(program))
    slow = Ticker.simulated(machine, traced=True, plant_choice=choice)
    plant = choice.build(machine)
    fast = StretchTicker(machine, SimulatedCard(plant), plant, traced=True, queue=Queue())
    return ran(slow, program, asked, ticks), ran(fast, program, asked, ticks)


def physics(ticker: Ticker) -> list[object]:
    assert isinstance(ticker.plant, DynamicPlant)
    rows, wear = list(ticker.plant._rows), list(ticker.plant._bits.columns)
    for axis in range(len(ticker.plant.motors)):
        rows[axis * law.ROW + law.MOVED] = 0.0  # of the last tick, which may have been left out
    return [rows, wear[law.FIRST :]]


def forgotten(told: dict[str, object]) -> dict[str, object]:
    """Without the objects that are compared by ``physics``."""
    return {name: value for name, value in told.items() if not name.endswith((".rotor", ".sensors"))} | {
        name: [{k: v for k, v in each.items() if k != "_random"} for each in value]  # type: ignore[attr-defined]
        for name, value in told.items()
        if name.endswith(".sensors")
    }


def check(machine: Machine, choice: PlantChoice, text: str, asked: Disturbances, ticks: int) -> Ticker:
    slow, fast = twins(machine, choice, text, asked, ticks)
    difference = first_difference(trace(slow), trace(fast))
    assert difference is None, render(difference)
    assert trace(slow) == trace(fast)
    assert forgotten(remembered(slow)) == forgotten(remembered(fast))
    assert physics(slow) == physics(fast)
    return fast


def whatever_is_asked(name: str, data: st.DataObject) -> None:
    machine = LIBRARY.machine(name)
    if machine.tick_hz < FINE_HZ:
        machine = machine.at_rate(data.draw(st.sampled_from([500, 500, 560, 640])))
    named = {axis.name for axis in machine.axes} | {sensor.name for sensor in machine.sensors}
    known_faults = [fault for fault in FAULTS if "." not in fault or fault.partition("=")[0].split(".")[1] in named]
    faults = tuple(data.draw(st.lists(st.sampled_from(known_faults), max_size=2, unique_by=lambda f: f.split("=")[0])))
    known = data.draw(st.sampled_from(["KMD_INICJALIZACJA\n", ""]))
    text = known + "\n".join(data.draw(st.lists(commands(machine), min_size=1, max_size=8)))
    asked = data.draw(st.one_of(st.just({}), disturbances))
    choice = PlantChoice("dynamic", faults, data.draw(st.integers(0, 99)))
    check(machine, choice, text, asked, data.draw(st.integers(TICKS // 2, TICKS)))


@pytest.mark.parametrize("name", DYNAMIC)
@seed(720)
@settings(max_examples=6)
@given(data=st.data())
def test_whatever_is_asked_of_it_a_stretch_is_its_ticks(name: str, data: st.DataObject) -> None:
    whatever_is_asked(name, data)


@pytest.mark.long
@pytest.mark.parametrize("name", DYNAMIC)
@seed(721)
@settings(max_examples=300)
@given(data=st.data())
def test_a_long_campaign_of_stretches_against_their_ticks(name: str, data: st.DataObject) -> None:
    whatever_is_asked(name, data)


@pytest.mark.parametrize("faults", [(), ("blunt=3",), ("bouncing.z_top=7", "loose.x=0.4")])
def test_a_board_goes_in_stretches(faults: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    """So that the test above compares two ways, and not tick with itself."""
    passed = []
    run = DynamicPlant.run
    monkeypatch.setattr(DynamicPlant, "run", lambda self, images: passed.append(run(self, images)) or passed[-1])
    machine = LIBRARY.machine("pcb-drill")
    ticks = 12000 if KERNEL.compiled else 3000
    text = BOARD.format(120, 90, 10, 150, 60, 60)
    fast = check(machine, PlantChoice("dynamic", faults, 4), text, {}, ticks)
    assert sum(passed) > (0.65 if faults else 0.95) * fast.controller.tick


def test_a_ramp_is_within_a_stretch(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ramps up and down, turns of a fed head, and an axis that rests before the other, all ticked but for a few."""
    ticked = []
    run = StretchTicker.run
    monkeypatch.setattr(StretchTicker, "run", lambda self, *what: ticked.append(run(self, *what)) or ticked[-1])
    text = "KMD_INICJALIZACJA\nKMD_PREDKOSC 9\nKMD_GOTO_X_Y 40 3\nKMD_PREDKOSC 1\nKMD_GOTO_X_Y 400 90\nKMD_CZEKAJ 300"
    fast = check(LIBRARY.machine("pcb-drill"), PlantChoice("dynamic"), text, {}, 6000)
    assert fast.controller.done == 7
    assert sum(ticked) < 100


def test_a_sensor_that_nothing_acts_on_ends_no_stretch(monkeypatch: pytest.MonkeyPatch) -> None:
    """A stroke down leaves the upper sensor, and meets the board: one stretch up to the lower sensor."""
    passed = []

    def noted(self: StretchTicker, shown: Images) -> None:
        passed.append(self.controller.command.opcode)
        run(self, shown)

    run = StretchTicker._pass
    monkeypatch.setattr(StretchTicker, "_pass", noted)
    check(LIBRARY.machine("pcb-drill"), PlantChoice("dynamic"), "KMD_INICJALIZACJA\nKMD_WIERTLO_DOL", {}, 2600)
    assert passed.count(Op.WIERTLO_DOL) == 1


def test_drilling_ends_in_time_within_a_stretch() -> None:
    """At 100 Hz and 3 ticks a step the way down takes longer than a hole may."""
    text = "KMD_INICJALIZACJA\nKMD_PREDKOSC 3\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA"
    fast = check(LIBRARY.machine("pcb-drill").at_rate(100), PlantChoice("dynamic"), text, {}, 14000)
    assert fast.controller.fault == Fault.DRILLING_TIME


def test_a_bit_breaks_in_the_same_tick_of_a_stretch() -> None:
    text = "KMD_INICJALIZACJA\n" + "KMD_RUCHd z2=3860 z3=3860\nKMD_RUCHd z2=-3860 z3=-3860\nKMD_RUCHd x=200\n" * 2
    fast = check(LIBRARY.machine("eight-axis"), PlantChoice("dynamic", ("worn.z3=7.999",)), text, {}, 60_000)
    assert fast.controller.fault == Fault.NONE
    broken = fast.plant.chucks.of(4) if fast.plant is not None else None
    assert broken is not None and broken.short_steps > 0


def test_the_rows_hold_every_coefficient() -> None:
    assert all(hasattr(motors, field.name.upper()) for field in fields(Coefficients))
