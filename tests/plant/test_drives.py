"""Drives with motors: they follow their pulses with inertia, home to the step, and trip where they can't follow."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from drillctl.kmd import Fault, Request
from drillctl.machine import Machine
from drillctl.plant.dynamic.kernel import KERNEL, PLAIN
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.plant.dynamic.recorder import motion_of
from tests.support.bench import Bench, shipped

SETTLED = "KMD_CZEKAJ 800"  # 0.1 s


@cache
def eight(x_start: int = 300) -> Machine:
    """The eight-axis drill, found near zero."""
    machine = shipped("eight-axis")
    x, *others = machine.axes
    axes = (replace(x, start_steps=x_start), *(replace(axis, start_steps=80) for axis in others))
    surroundings = replace(machine.surroundings, scatter_mm=0.005)
    return replace(machine, axes=axes, surroundings=surroundings)


def bench(machine: Machine, *faults: str, seed: int = 1) -> Bench:
    return Bench(machine, plant=DynamicPlant(machine, faults, seed))


def places(b: Bench) -> list[float]:
    return [b.card.plant.position_steps(axis) for axis in range(len(b.machine.axes))]


@cache
def zero() -> list[float]:
    """Where the axes rest after homing: a little beyond their indexes, by the lag of a slow move."""
    b = bench(eight()).queue(f"KMD_INICJALIZACJA; {SETTLED}")
    b.finish()
    assert (b.m.fault, b.m.position_known) == (Fault.NONE, True)
    return places(b)


@pytest.mark.parametrize(("x_start", "seed"), [(120, 2), (-70, 3)])
def test_homing_finds_the_same_step_whatever_the_switches_scatter(x_start: int, seed: int) -> None:
    b = bench(eight(x_start), seed=seed).queue(f"KMD_INICJALIZACJA; {SETTLED}")
    b.finish()
    assert (b.m.fault, b.m.position_known) == (Fault.NONE, True)
    assert places(b) == pytest.approx(zero(), abs=0.5)
    assert zero() == pytest.approx([0.0] * 8, abs=3)


def test_a_motor_follows_its_pulses_with_a_lag_and_comes_to_rest_on_its_step() -> None:
    b = bench(eight()).queue(f"KMD_INICJALIZACJA; {SETTLED}; KMD_RUCH x=400", end=False)
    b.until(lambda: b.m.axes[0].made > 0 and b.m.position_known and b.positions()[0] == 200)
    assert 2 < 200 - places(b)[0] < 60
    assert not any(b.ticker.lost_steps()), "what lags will come"
    b.queue(SETTLED).finish()
    assert places(b)[0] == pytest.approx(400 + zero()[0], abs=0.5)


def test_an_axis_driven_beyond_its_drive_falls_behind_and_the_machine_says_so() -> None:
    b = bench(eight(), "jammed.x=100").queue("KMD_RUCHd x=2000 y=2000")
    b.finish()
    assert (b.m.fault, b.m.position_known) == (Fault.DRIVE_ALARM, False)
    assert b.card.plant.inputs & b.input_bit("x_alarm") and not b.card.plant.inputs & b.input_bit("y_alarm")
    assert b.positions()[0] > 299 > abs(places(b)[0] - 300)
    b.ask(Request.ACK).tick(2)
    assert b.m.fault == Fault.DRIVE_ALARM, "it has not been switched on anew"


def test_a_weak_drive_follows_a_slow_move_and_trips_on_a_fast_one() -> None:
    machine = eight()
    x = machine.axes[0]
    assert x.dynamics is not None
    weak = replace(x, dynamics=replace(x.dynamics, current_a=0.2, error_pulses=20))
    found = []
    for speed in ("KMD_PREDKOSC 40", "KMD_PREDKOSC 0"):
        b = bench(replace(machine, axes=(weak, *machine.axes[1:]))).queue(f"{speed}; KMD_RUCHd x=60; {SETTLED}")
        b.finish()
        found.append(b.m.fault)
    assert found == [Fault.NONE, Fault.DRIVE_ALARM]


def test_the_compiled_law_of_drives_is_the_plain_one() -> None:
    images = np.random.default_rng(1).integers(0, 4, 300, np.uint64)
    runs = []
    for kernel in (KERNEL, PLAIN):
        plant = DynamicPlant(eight(), (), 0, kernel)
        for image in images.tolist():
            plant.drive(image)
        runs.append([plant.position_steps(0), *plant.motors[0].axis.currents])
    assert runs[0] == runs[1]


def test_a_pulse_counts_by_its_direction_wire_at_its_rising_edge() -> None:
    table = eight().axes[0]
    pulse, direction = (1 << bit for bit in table.wire_bits)
    forth, back = [direction, direction | pulse] * 5, [0, pulse] * 2
    motion = motion_of(table, 8000, [*forth, *back, *[0] * 2000])
    assert motion.columns[-1] / 2 == pytest.approx(3, abs=0.5)
