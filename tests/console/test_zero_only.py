"""After an emergency stop of the boiler drum's drill the console lets it return to zero, and refuses all else."""

import sys
from collections.abc import Callable

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.console.readiness import ZERO_ONLY
from drillctl.console.signals import MachineSignals
from drillctl.machine import Library
from drillctl.ticker.launch import RunSettings
from tests.support.operator import settle, until

REFUSED: dict[str, Callable[[MachineConsole], object]] = {
    "initialise": MachineConsole.initialise,
    "jog": lambda console: console.jog("x", 5),
    "base": MachineConsole.set_base,
    "queue": lambda console: console.run_queue("KMD_RUCHd x=5\n"),
    "rate": lambda console: console.set_tick_hz(90_000),
    "output": lambda console: MachineSignals(console).set_output(0, True),
}

BY_SIMULATED_CLOCK = RunSettings(pace="real", sliced=True)


def press(console: MachineConsole, name: str, on: bool) -> object:
    hands = MachineSignals(console)
    return hands.press_input(next(signal.bit for signal in hands.signals() if signal.name == name), on)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux")
def test_the_switches_of_the_simulated_machine_are_pressed_by_hand() -> None:
    library = Library.standard()
    console = MachineConsole(library, library.machine("boiler-drum"), BY_SIMULATED_CLOCK)
    try:
        assert press(console, "pause", True) == ()
        assert console.run_queue("KMD_INICJALIZACJA\nKMD_RUCHd x=60\n") == ()
        until(console, lambda: console.view().condition == "held")
        assert press(console, "pause", False) == ()
        settle(console)
        assert [axis.position_steps for axis in console.view().axes] == [60, 0]
        assert press(console, "emergency_stop", True) == ()
        assert console.run_queue("KMD_RUCHd x=60\n") == ()
        until(console, lambda: console.view().condition == "latched")
        assert press(console, "emergency_stop", False) == ()
        until(console, lambda: not MachineSignals(console).signals()[1].on)
        console.acknowledge()
        until(console, lambda: console.view().condition == "zero_only")
        settle(console)
        assert console.return_to_zero() == ()
        settle(console)
        assert [axis.position_steps for axis in console.view().axes] == [0, 0]
        assert MachineSignals(console).press_input(31, True) == ("bit 31 is no input of this machine",)
    finally:
        console.close()


def test_a_machine_that_runs_free_has_no_switches_to_press() -> None:
    library = Library.standard()
    console = MachineConsole(library, library.machine("boiler-drum"), RunSettings("simulated", "free"))
    try:
        assert "only a simulated machine at real pace" in str(press(console, "pause", True))
    finally:
        console.close()


@pytest.mark.parametrize("back", [MachineConsole.return_to_zero, lambda console: console.run_queue("KMD_POWROT\n")])
def test_only_the_return_to_zero_is_granted(back: Callable[[MachineConsole], object]) -> None:
    library = Library.standard()
    console = MachineConsole(library, library.machine("boiler-drum"), RunSettings("simulated", "free"))
    try:
        assert console.run_queue("KMD_INICJALIZACJA\nKMD_RUCHd x=60 y=9\n") == ()
        settle(console)
        console.emergency_stop()
        until(console, lambda: console.view().condition == "latched")
        assert console.view().position_known and console.acknowledge() == ()
        until(console, lambda: console.view().condition == "zero_only")
        assert {name: ask(console) for name, ask in REFUSED.items()} == dict.fromkeys(REFUSED, (ZERO_ONLY,))
        assert back(console) == ()
        settle(console)
        view = console.view()
        assert (view.condition, [axis.position_steps for axis in view.axes]) == ("ready", [0, 0])
    finally:
        console.close()
