"""The machine under a person's hands, from the desk: signals, outputs, single ticks; and the way to a real port."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.console.port import MachinePort
from drillctl.console.signals import MachineSignals
from drillctl.machine import Library, shipped_tables
from drillctl.machine.edit import set_state_row, set_value
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.signals import SignalView
from tests.support.operator import until

pytestmark = [
    pytest.mark.paced,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux"),
]
BY_SIMULATED_CLOCK = RunSettings(pace="real", sliced=True)
QUEUE = "KMD_RUCHd x=30\n"
REAL_CARD = "firmata:/dev/no-such-line"


@pytest.fixture
def library(tmp_path: Path) -> Library:
    return Library((tmp_path, shipped_tables()))


@pytest.fixture
def console(library: Library) -> Iterator[MachineConsole]:
    made = MachineConsole(library, library.machine("cnc-shield").at_rate(1000), BY_SIMULATED_CLOCK, tick_hz=1000)
    yield made
    made.close()


def signal(hands: MachineSignals, name: str) -> SignalView:
    return next(each for each in hands.signals() if each.name == name)


def test_every_wire_is_there_and_an_output_is_switched(console: MachineConsole) -> None:
    hands, machine = MachineSignals(console), console.machine
    names = [each.name for each in hands.signals()]
    assert len(set(names)) == len(names)
    wires = sum(len(axis.wire_bits) for axis in machine.axes)
    assert len(names) == len(machine.sensors) + len(machine.outputs) + wires
    spindle = signal(hands, "spindle")
    assert not spindle.on and hands.set_output(spindle.bit, True) == ()
    until(console, lambda: signal(hands, "spindle").on)
    assert hands.set_output(99, True) == ("bit 99 is no output of this machine",)


def test_a_coil_by_hand_loses_the_position(console: MachineConsole) -> None:
    hands = MachineSignals(console)
    console.initialise()
    until(console, lambda: not console.at_work)
    assert console.view().position_known
    coil = next(each for each in hands.signals() if each.kind == "coil")
    assert hands.set_output(coil.bit, not coil.on) == ()
    until(console, lambda: not console.view().position_known)
    assert signal(hands, coil.name).on != coil.on and console.view().fault is None


def test_ticks_are_let_through_one_by_one_then_all(console: MachineConsole) -> None:
    hands = MachineSignals(console)
    assert hands.tick(1) == ("nothing runs that could be let on by ticks",)
    assert hands.go() == ("the clock is not stopped",)
    assert hands.run_paused("KMD_NONSENSE\n") and not console.view().paused
    assert hands.run_paused(QUEUE) == ()
    first = console.view().tick
    for ticks in (1, 1, 5):
        assert hands.tick(ticks) == ()
        first += ticks
        until(console, lambda: console.view().tick == first)  # noqa: B023  # called at once
    for _ in range(5):
        console.turn()
    view = console.view()
    assert view.tick == first and view.paused and view.command == "KMD_RUCHd x=30"
    assert hands.set_output(0, True) == ("the machine is at work; hold or stop it first",)
    assert hands.run_paused(QUEUE) != () and hands.tick(0) != ()
    assert hands.go() == ()
    until(console, lambda: not console.at_work)
    assert console.view().axes[0].position_steps == 30 and not console.view().paused


@pytest.mark.parametrize("way_out", ["stop", "emergency_stop", "resume"])
def test_a_stopped_clock_keeps_nobody_from_stopping_or_going_on(way_out: str, console: MachineConsole) -> None:
    hands = MachineSignals(console)
    hands.run_paused("KMD_RUCHd x=300\n")
    hands.tick(60)
    until(console, lambda: console.link.gate.left == 0)
    assert getattr(console, way_out)() == ()
    until(console, lambda: not console.at_work)
    assert not console.view().paused
    assert (console.view().axes[0].position_steps == 300) == (way_out == "resume")


def real_machine(library: Library, card: str) -> None:
    """The user's own copy of a machine, in mode REAL."""
    text = (shipped_tables() / "machines" / "cnc-shield.toml").read_text("utf-8")
    text = set_value(set_value(text, ("configuration", "mode"), "REAL"), ("configuration", "card"), card)
    own = library.folders[0] / "machines"
    own.mkdir(exist_ok=True)
    (own / "cnc-shield.toml").write_text(text)


def test_mode_real_asks_for_the_cards_port_and_a_port_that_fails_changes_nothing_but_the_position(
    console: MachineConsole, library: Library
) -> None:
    ports = MachinePort(console)
    assert console.view().real_wanted == "" and ports.port().configured == "firmata-uno"
    real_machine(library, REAL_CARD)
    assert console.choose_machine("cnc-shield") == ()
    assert console.view().real_wanted == REAL_CARD and not ports.port().real
    (problem,) = ports.go_real()
    assert problem.startswith(REAL_CARD) and "can't be opened" in problem
    assert not ports.port().real and console.view().port == "simulated"
    assert console.jog("x", 5) == ()
    until(console, lambda: not console.at_work)
    assert console.view().axes[0].position_steps == 5


def test_a_port_given_by_option_wins(library: Library) -> None:
    real_machine(library, REAL_CARD)
    console = MachineConsole(library, library.machine("cnc-shield"), RunSettings(pace="real"), port_won=True)
    try:
        assert console.view().real_wanted == "" and MachinePort(console).port().overridden
    finally:
        console.close()


def test_the_test_of_a_port_says_what_is_wrong_and_moves_nothing(console: MachineConsole, library: Library) -> None:
    real_machine(library, REAL_CARD)
    console.choose_machine("cnc-shield")
    tick = console.view().tick
    report = MachinePort(console).test()
    assert report.port == REAL_CARD and "can't be opened" in report.problem and report.inputs == ()
    assert console.view().tick == tick


def test_a_card_that_no_port_drives_is_told(console: MachineConsole) -> None:
    assert console.choose_machine("boiler-drum") == ()
    ports = MachinePort(console)
    assert ports.port().configured == ""
    assert "no port drives the card '8255-B'" in ports.test().problem
    assert "no port drives the card '8255-B'" in ports.go_real()[0]


def test_an_edited_table_is_taken_while_the_machine_runs(console: MachineConsole, library: Library) -> None:
    """The same process goes on, where it stands; the very same machine once more is started anew."""
    console.run_queue("KMD_RUCHd x=25\n")
    until(console, lambda: not console.at_work)
    link, ramp = console.link, console.machine.axes[0].ramp.name
    text = (shipped_tables() / "ramp" / f"{ramp}.toml").read_text("utf-8")
    (library.folders[0] / "ramp").mkdir()
    (library.folders[0] / "ramp" / f"{ramp}.toml").write_text(set_state_row(text, 0, "interval", 40))
    assert console.choose_machine("cnc-shield") == ()
    assert console.link is link and console.machine.axes[0].ramp.interval[0] == 40
    assert console.view().axes[0].position_steps == 25 and not console.view().position_known
    assert console.choose_machine("cnc-shield") == ()
    assert console.link is not link and console.view().axes[0].position_steps == 0
