"""Jogging: taps are steps, one more waits, a key held down is one move that ends when the key goes."""

import time
from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.console.jogging import HELD_PRESSES, REPEAT_S, SILENT_S, Jogging
from drillctl.console.machine_console import MachineConsole
from drillctl.machine import Library
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.console import Problems
from tests.support.operator import settle

pytestmark = pytest.mark.paced

BY_SIMULATED_CLOCK = RunSettings(pace="real", sliced=True)
WAY = 5000
REPEATED_S = 0.03


class Bench:
    """A Jogging over an axis that takes a second for a step, a minute for all its way; ``did``: what was asked."""

    def __init__(self, way: int | None = WAY):
        self.did: list[tuple[str, int]] = []
        self.until_s, self.way = 0.0, way
        self.jogs = Jogging(self.move, self.stop, lambda axis, steps: way if way is None or steps > 0 else -way)

    def move(self, axis: str, steps: int) -> Problems:
        self.did.append((axis, steps))
        self.until_s = self.now_s + (60.0 if abs(steps) == WAY else 1.0)
        return ()

    def stop(self) -> None:
        self.did.append(("stop", 0))
        self.until_s = self.now_s + 0.05

    def press(self, now_s: float, axis: str = "x", steps: int = 12) -> Problems:
        self.now_s = now_s
        return self.jogs.press((axis, steps), now_s < self.until_s, now_s)

    def wait(self, now_s: float) -> None:
        self.now_s = now_s
        self.jogs.carry_on(now_s < self.until_s, now_s)


def test_a_press_is_a_step_and_one_further_waits() -> None:
    bench = Bench()
    for now_s in (0.0, 0.3, 0.6):
        assert bench.press(now_s) == ()
    assert bench.did == [("x", 12)]
    bench.wait(1.1)
    bench.wait(2.2)
    assert bench.did == [("x", 12)] * 2


def test_the_newest_press_is_the_one_that_waits() -> None:
    bench = Bench()
    bench.press(0.0)
    bench.press(0.3, "y")
    bench.press(0.6, "x", -12)
    bench.wait(1.1)
    assert bench.did == [("x", 12), ("x", -12)]


def held_down(bench: Bench, from_s: float, to_s: float) -> float:
    """A key as a terminal repeats it; returns when it came last."""
    now_s = from_s
    while now_s < to_s:
        bench.press(now_s)
        now_s += REPEATED_S
    return now_s - REPEATED_S


def test_a_key_held_down_is_one_move_to_the_end_and_stops_when_the_key_goes() -> None:
    bench = Bench()
    bench.press(0.0)
    last_s = held_down(bench, 0.5, 1.9)
    assert bench.did == [("x", 12), ("x", WAY)]
    bench.wait(last_s + SILENT_S - 0.01)
    assert bench.did[-1] == ("x", WAY)
    bench.wait(last_s + SILENT_S + 0.01)
    bench.wait(last_s + SILENT_S + 0.5)
    assert bench.did[2:] == [("stop", 0)], "stopped once, and no step is left over"


def test_another_key_ends_the_move_and_is_a_step_of_its_own() -> None:
    bench = Bench()
    last_s = held_down(bench, 0.0, 1.5)
    bench.press(last_s + 0.02, "x", -12)
    bench.wait(last_s + 0.1)
    assert bench.did == [("x", 12), ("x", WAY), ("stop", 0), ("x", -12)]


def test_where_the_end_of_the_way_is_not_known_a_held_key_makes_steps() -> None:
    bench = Bench(way=None)
    held_down(bench, 0.0, 2.5)
    assert bench.did == [("x", 12)] * 3


def test_a_step_beyond_the_reach_is_refused() -> None:
    bench = Bench(way=5)
    assert "reach ends" in bench.press(0.0)[0] and bench.did == []


def test_what_is_forgotten_does_not_come() -> None:
    bench = Bench()
    last_s = held_down(bench, 0.0, 0.5)
    bench.jogs.forget()
    bench.wait(last_s + 1.5)
    assert bench.did == [("x", 12)]


@given(st.lists(st.floats(REPEAT_S + 0.01, 3.0), max_size=30))
def test_fingers_never_make_a_long_move(pauses_s: list[float]) -> None:
    bench, now_s = Bench(), 0.0
    for pause_s in pauses_s:
        bench.press(now_s)
        now_s += pause_s
        bench.wait(now_s)
    assert set(bench.did) <= {("x", 12)} and len(bench.did) <= len(pauses_s)
    assert HELD_PRESSES * REPEAT_S > SILENT_S, "a run of repeats lasts longer than a silence"


@pytest.fixture
def console() -> Iterator[MachineConsole]:
    library = Library.standard()
    made = MachineConsole(library, library.machine("pcb-drill"), RunSettings(pace="real"))
    made.initialise()
    settle(made)
    yield made
    made.close()


def hold_key(console: MachineConsole, steps: int, for_s: float) -> None:
    """As a screen does: the console is turned, the key repeats."""
    until_s, due_s = time.monotonic() + for_s, 0.0
    while time.monotonic() < until_s:
        console.turn()
        if time.monotonic() >= due_s:
            due_s = time.monotonic() + REPEATED_S
            assert console.jog("x", steps) == ()


def test_the_machine_runs_smoothly_while_the_key_is_held_and_rests_soon_after(console: MachineConsole) -> None:
    hold_key(console, 12, 2.0)
    view = console.view()
    assert view.axes[0].state and view.axes[0].target_steps > 16000, "up its ramp, towards the end of the range"
    let_go = view.axes[0].position_steps
    settle(console)
    view = console.view()
    assert 100 < let_go < view.axes[0].position_steps < let_go + 400
    assert view.position_known and view.condition == "ready" and view.lost_steps == (0, 0, 0)


def test_a_jog_can_not_leave_the_reach(console: MachineConsole) -> None:
    assert console.jog("x", -12) == ("the axis can't go so far: its reach ends before",)
    assert console.jog("z", 300) == ()
    settle(console)
    assert console.jog("z", 600) == ("the axis can't go so far: its reach ends before",)
    assert console.view().fault is None and console.view().axes[2].position_steps == 300


def test_a_jog_longer_than_the_axis_is_refused_before_its_place_is_known() -> None:
    library = Library.standard()
    made = MachineConsole(library, library.machine("pcb-drill"), RunSettings(pace="free"))
    try:
        assert made.jog("z", -836) == made.jog("z", 836) == ("the axis can't go so far: its reach ends before",)
        assert made.view().fault is None and not made.view().at_work
    finally:
        made.close()


def test_the_rate_asked_for_stays_with_its_machine() -> None:
    library = Library.standard()
    made = MachineConsole(library, library.machine("pcb-drill").at_rate(400), BY_SIMULATED_CLOCK, tick_hz=400)
    try:
        assert made.choose_machine("pcb-drill") == () and made.view().tick_hz == 400
        assert "in force" in made.view().notices[0]
        assert made.choose_machine("boiler-drum") == ()
        assert made.view().tick_hz == library.machine("boiler-drum").tick_hz
        assert "own rate" in made.view().notices[0]
    finally:
        made.close()
