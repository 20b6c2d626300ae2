"""Initialisation by an encoder's index: each row of the table, and each way in which it fails."""

from dataclasses import replace

import pytest

from drillctl.execution.motion import STOPPING
from drillctl.kmd import Fault
from drillctl.machine import HomingStep, ParameterRow, Parameters
from tests.support.bench import Bench, shipped

X = 0
LIMITS = {"fast": 1, "slow": 40, "back": 90, "index": 700}
ROWS = tuple(HomingStep(do, (X,), "min", limit) for do, limit in LIMITS.items())


def bench(*more: HomingStep, start: int = 400) -> Bench:
    """The eight-axis drill with a homing table for X alone, X found at ``start``."""
    machine = shipped("eight-axis")
    x, *others = machine.axes
    axes = (replace(x, start_steps=start, high_steps=600), *others)
    return Bench(replace(machine, axes=axes, homing=(*ROWS, *more), parameters=None)).queue("KMD_INICJALIZACJA")


def in_row(b: Bench, row: int) -> Bench:
    """Runs to where a row of the homing table has begun."""
    b.until(lambda: b.m.homing_row == row)
    return b


def stuck(b: Bench, name: str, level: int) -> Bench:
    """With a wire that is high or low from now on, whatever the plant does."""
    setattr(b.card, "stuck_high" if level else "stuck_low", b.input_bit(name))
    return b


@pytest.mark.parametrize(
    ("row", "wire", "level", "fault", "steps_in_row"),
    [
        (0, "x_home", 0, Fault.HOMING_NO_SWITCH, 800 + 80),
        (2, "x_home", 1, Fault.HOMING_ON_SWITCH, 90),
        (3, "x_index", 0, Fault.HOMING_NO_INDEX, 700),
        (2, "x_index", 1, Fault.HOMING_EARLY_INDEX, 84),
    ],
)
def test_each_way_it_fails_has_its_fault(row: int, wire: str, level: int, fault: Fault, steps_in_row: int) -> None:
    b = stuck(in_row(bench(), row), wire, level)
    made = b.m.axes[X].made
    b.finish()
    assert (b.m.fault, b.m.position_known) == (fault, False)
    assert b.m.axes[X].made - made == steps_in_row


def test_a_switch_that_lets_go_while_the_axis_brakes_on_it() -> None:
    b = bench()
    b.until(lambda: b.m.axes[X].motion == STOPPING)
    stuck(b, "x_home", 0).finish()
    assert (b.m.fault, b.m.position_known) == (Fault.HOMING_OFF_SWITCH, False)


def test_the_axis_goes_slowly_on_to_a_switch_that_it_has_left_and_no_step_beyond() -> None:
    b = bench()
    b.until(lambda: b.m.axes[X].motion == STOPPING)
    stuck(b, "x_home", 0)
    at_rest = in_row(b, 1).m.axes[X].made
    b.until(lambda: b.m.axes[X].made == at_rest + 3)
    b.card.stuck_low = 0
    made = b.m.axes[X].made
    in_row(b, 2)
    assert b.m.axes[X].made == made
    b.finish()
    assert (b.m.fault, b.card.plant.position_steps(X)) == (Fault.NONE, 0)


def test_an_index_elsewhere_is_found_and_its_offset_is_gone_before_zero_is_taken() -> None:
    b = bench(HomingStep("offset", (X,), "min", 30), start=-70)
    b.finish()
    assert (b.m.fault, b.m.position_known, b.positions()[X]) == (Fault.NONE, True, 0)
    assert b.card.plant.position_steps(X) == 30


def test_a_row_keeps_its_interval() -> None:
    slow = tuple(replace(row, interval=20) for row in ROWS)
    b = Bench(replace(bench().machine, homing=slow)).queue("KMD_INICJALIZACJA")
    waits = set()

    def watched() -> bool:
        if b.m.axes[X].counting:
            waits.add(b.m.axes[X].wait)
        return b.ticker.over()

    b.until(watched)
    assert (b.m.fault, waits) == (Fault.NONE, {20})


def entered(**x_parameters: float) -> Bench:
    """The same, and X has parameters for its homing."""
    parameters = Parameters(axes=(("x", ParameterRow(tuple(x_parameters.items()))),))
    machine = replace(bench(HomingStep("offset", (X,), "min", 30)).machine, parameters=parameters)
    return Bench(machine).queue("KMD_INICJALIZACJA")


@pytest.mark.parametrize("offset_mm", [0.0, 0.4, -0.25])
def test_the_offset_of_the_parameters_is_the_distance_from_index_to_zero(offset_mm: float) -> None:
    b = entered(homing_offset_mm=offset_mm)
    b.finish()
    assert (b.m.fault, b.positions()[X]) == (Fault.NONE, 0)
    assert b.card.plant.position_steps(X) == 100 * offset_mm


@pytest.mark.parametrize(("detection_mm", "fault"), [(0.56, Fault.NONE), (0.53, Fault.HOMING_NO_INDEX)])
def test_the_index_must_come_within_the_detection_length(detection_mm: float, fault: Fault) -> None:
    b = entered(homing_detection_mm=detection_mm)
    b.finish()
    assert b.m.fault == fault


@pytest.mark.parametrize(("speed_mm_min", "interval"), [(2400, 1), (2399, 2), (1200, 2), (100, 24)])
def test_the_homing_speed_is_never_passed_on_the_way_to_the_switch(speed_mm_min: float, interval: int) -> None:
    b = entered(homing_speed_mm_min=speed_mm_min)
    waits = set()

    def watched() -> bool:
        if b.m.axes[X].counting and b.m.homing_row == 0:
            waits.add(b.m.axes[X].wait)
        return b.m.homing_row > 0

    b.until(watched)
    assert min(waits) == interval


@pytest.mark.parametrize("row", ROWS)
def test_a_changed_row_is_another_machine(row: HomingStep) -> None:
    machine = shipped("eight-axis")
    digests = {replace(machine, homing=(changed,)).digest for changed in (row, replace(row, interval=3))}
    assert len(digests) == 2
