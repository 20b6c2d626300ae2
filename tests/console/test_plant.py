"""The plant is chosen at the desk: the machine starts anew on it; what can't be had is refused, and nothing changes."""

from collections.abc import Iterator

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.console.plant import MachinePlant
from drillctl.machine import Library, shipped_tables
from drillctl.plant import IDEAL_PLANT, PlantChoice
from drillctl.ticker.launch import RunSettings, on_port
from tests.support.operator import settle


@pytest.fixture
def console() -> Iterator[MachineConsole]:
    library = Library((shipped_tables(),))
    made = MachineConsole(library, library.machine("pcb-drill"), RunSettings("simulated", "free"))
    yield made
    made.close()


def test_the_dynamic_plant_with_faults_and_seed_and_back(console: MachineConsole) -> None:
    plants = MachinePlant(console)
    assert console.initialise() == ()
    settle(console)
    assert plants.choose("blunt=3, loose.x=0.4", "7") == ()
    now, view = plants.plant(), console.view()
    assert (now.kind, now.faults, now.seed) == ("dynamic", ("blunt=3", "loose.x=0.4"), 7)
    assert view.plant == "dynamic blunt=3 loose.x=0.4" and not view.position_known
    assert (console.used.site.plant, console.used.site.seed) == ("dynamic blunt=3 loose.x=0.4", 7)
    assert plants.swap() == ()
    assert (plants.plant().kind, plants.plant().faults, console.view().plant) == ("ideal", (), "")


def test_the_machines_chosen_later_have_the_plant_too(console: MachineConsole) -> None:
    assert MachinePlant(console).choose("jammed.x=2", "") == ()
    assert console.choose_machine("pcb-drill-ramp-lab") == ()
    assert console.view().plant == "dynamic jammed.x=2"


@pytest.mark.parametrize(
    ("faults", "seed", "reason"),
    [
        ("blnt=3", "0", "did you mean blunt=N, N from 0 to 1000?"),
        ("blunt=1001", "0", "from 0 to 1000"),
        ("stuck.x_mim=1", "0", "did you mean stuck.x_min=N?"),
        ("loose=1", "0", "written loose.AXIS=N"),
        ("blunt=1 blunt=2", "0", "given twice"),
        ("", "-1", "the seed is a whole number from 0 to 2147483647"),
        ("", "2147483648", "the seed"),
        ("", "9" * 5000, "the seed"),
        ("", "²", "the seed"),
    ],
)
def test_what_cannot_be_had_is_refused_and_nothing_changes(
    console: MachineConsole, faults: str, seed: str, reason: str
) -> None:
    before, link = MachinePlant(console).plant(), console.link
    problems = MachinePlant(console).choose(faults, seed)
    assert len(problems) == 1 and reason in problems[0]
    assert console.link is link and MachinePlant(console).plant() == before


def test_it_is_refused_while_at_work(console: MachineConsole) -> None:
    assert console.initialise() == ()
    link = console.link
    assert MachinePlant(console).swap() == ("the machine is at work; hold or stop it first",)
    assert console.link is link


def test_a_machine_without_dynamics_says_so(console: MachineConsole) -> None:
    assert console.choose_machine("cnc-shield") == ()
    problems = MachinePlant(console).swap()
    assert "has no dynamics" in problems[0] and console.view().plant == ""


def test_a_real_machine_has_no_plant(console: MachineConsole, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(console.link), "measured", False)  # which says that a real port is in use
    link = console.link
    problems = MachinePlant(console).choose("blunt=3", "0")
    assert "has no plant; go back to the simulated one first" in problems[0] and console.link is link
    assert MachinePlant(console).plant().real_port == "simulated"


def test_the_dynamic_plant_stays_behind_on_the_way_to_a_real_port() -> None:
    running = on_port(RunSettings(plant=PlantChoice("dynamic", ("blunt=3",))), "gpio")
    assert running.port == "gpio" and running.plant == IDEAL_PLANT
