"""One tick, to the letter: when columns come out, commands end and the next are popped (docs/SPEC.md, 1.1, 1.2)."""

import pytest

from drillctl.execution.motion import AxisMotion
from drillctl.kmd import Fault, Op
from drillctl.machine import travel_ticks
from tests.support.bench import MACHINES, Bench, shipped

DISTANCES = (1, 2, 3, 4, 5, 6, 7, 8, 9, 15, 16, 17, 30, 100)
INSTANT = {
    "KMD_RUCHd x=0": Op.RUCH_D,
    "KMD_LINIAd x=0 y=0": Op.LINIA_D,
    "KMD_GOTOdXdY 0 0": Op.GOTO_DXDY,
    "KMD_BAZA": Op.BAZA,
    "KMD_PREDKOSC 5": Op.PREDKOSC,
    "KMD_CZEKAJ 0": Op.CZEKAJ,
    "KMD_CZEKAJ 1": Op.CZEKAJ,
    "KMD_WRZECIONO 100": Op.WRZECIONO,
    "KMD_NARZEDZIE 3": Op.NARZEDZIE,
    "KMD_FAZY_WYL": Op.FAZY_WYL,
    "KMD_CZEKAJ_WE z_top 1 50": Op.CZEKAJ_WE,
    "KMD_WIERTLO_GORA": Op.WIERTLO_GORA,
    "KMD_KONIEC": Op.KONIEC,
}


def bench(name: str = "pcb-drill") -> Bench:
    return Bench(shipped(name))


def column_changes(b: Bench, axis: str) -> list[int]:
    """Ticks in which another column of an axis was put out; forcing bits apart."""
    mask = b.bits(axis) & ~b.forcing(axis)
    shown = [image & mask for image in [0, *b.images]]
    return [tick for tick in range(len(b.images)) if shown[tick] != shown[tick + 1]]


def test_the_first_column_of_a_move_from_rest_is_out_six_ticks_after_its_pop() -> None:
    b = bench().queue("KMD_RUCHd x=30")
    b.finish()
    assert b.images[:7] == [0, 0, 0, 0, 0, 0, b.bits("x", "1a", "2a", "24a")]


def test_the_columns_of_a_move_come_at_the_sums_of_its_intervals() -> None:
    b = bench("boiler-drum").queue("KMD_RUCHd x=5")
    b.finish()
    sums = [9, 9 + 8, 9 + 8 + 7, 9 + 8 + 7 + 8, 9 + 8 + 7 + 8 + 9]
    assert column_changes(b, "x") == [ticks - 1 for ticks in sums]


@pytest.mark.parametrize("distance", DISTANCES)
@pytest.mark.parametrize("name", MACHINES)
def test_a_move_is_done_in_the_tick_of_its_last_step_and_the_next_popped_one_later(name: str, distance: int) -> None:
    machine = shipped(name)
    x = machine.axes[0]
    ticks = travel_ticks(x.ramp, distance, 0, x.columns_per_step)
    b = Bench(machine).queue(f"KMD_RUCHd x={distance}; KMD_RUCHd x=-{distance}")
    assert b.done_at(1) == ticks - 1
    assert b.positions()[0] == distance
    assert b.m.running == 1
    b.tick()
    assert (b.m.running, b.m.axes[0].count) == (2, 1)
    assert b.done_at(2) == 2 * ticks - 1
    b.tick()
    assert not b.m.job


@pytest.mark.parametrize("moves", [(3, 4, 0), (4, 3, 0), (0, 0, 9), (100, 1, 30), (5, -17, 8)])
@pytest.mark.parametrize("floor", [0, 3, 10])
def test_a_move_takes_the_greatest_of_its_axes_interval_sums(moves: tuple[int, int, int], floor: int) -> None:
    b = bench().queue(f"KMD_PREDKOSC {floor}; KMD_RUCHd x={moves[0]} y={moves[1]} z={moves[2]}")
    ramp = b.machine.axes[0].ramp
    greatest = max(travel_ticks(ramp, steps, floor) for steps in moves)
    assert b.done_at(2) == 1 + greatest - 1
    assert b.positions() == list(moves)


@pytest.mark.parametrize("line", INSTANT)
def test_commands_without_motion_take_one_tick(line: str) -> None:
    b = bench().queue(f"{line}\n{line}", end=False) if "KONIEC" not in line else bench().queue("KMD_BAZA")
    b.tick()
    assert (b.m.done, b.m.busy, b.m.tick) == (1, False, 1)
    b.tick()
    assert (b.m.done, b.m.tick, b.m.fault) == (2, 2, Fault.NONE)


@pytest.mark.parametrize(("n", "ticks"), [(0, 1), (1, 1), (2, 2), (3, 3), (1000, 1000)])
def test_a_wait_takes_its_ticks_and_one_at_least(n: int, ticks: int) -> None:
    b = bench().queue(f"KMD_CZEKAJ {n}; KMD_KONIEC")
    assert b.done_at(1) == ticks - 1
    assert b.finish() == 1


def test_a_wait_for_an_input_ends_in_the_tick_that_latches_it() -> None:
    b = bench().queue("KMD_CZEKAJ_WE x_max 1 100")
    b.tick(10)
    b.card.stuck_high = b.input_bit("x_max")
    assert b.done_at(1) == 10


def test_a_speed_holds_for_the_moves_that_follow_until_the_next() -> None:
    b = bench().queue("KMD_PREDKOSC 20; KMD_RUCHd x=5; KMD_RUCHd y=5; KMD_PREDKOSC 0; KMD_RUCHd x=5")
    assert [b.done_at(sequence) for sequence in range(1, 6)] == [0, 100, 200, 201, 201 + 24]


@pytest.mark.parametrize("name", MACHINES)
def test_inputs_are_read_once_and_outputs_written_once_a_tick(name: str) -> None:
    b = Bench(shipped(name)).queue("KMD_RUCHd x=9; KMD_CZEKAJ 3; KMD_LINIAd x=-9 y=4; KMD_WIERTLO_GORA")
    b.finish()
    assert b.card.calls == ["latch", "flush"] * b.m.tick
    b.tick(3)
    assert b.card.calls == ["latch", "flush"] * b.m.tick


def test_nothing_that_the_card_shows_after_the_latch_is_seen_in_that_tick() -> None:
    """The sensor's edge is the outcome of this tick's flush, so the brake begins in the next tick."""
    b = bench().ready().queue("KMD_WIERTLO_DOL")
    b.until(lambda: bool(b.card.plant.inputs & b.input_bit("z_bottom")))
    z = b.m.axes[2]
    at_edge = z.position
    assert (z.motion == AxisMotion.STOPPING, z.state) == (False, 3)
    b.tick()
    assert z.motion == AxisMotion.STOPPING
    b.finish()
    assert z.position == at_edge + 3
