"""KMD_GORA_X_Y: X and Y start while the heads still go up, never before all heads are clear (docs/SPEC.md, 1.10)."""

from dataclasses import replace

import pytest

from drillctl.kmd import Condition, Fault, Request
from tests.support.bench import Bench, shipped

CLEAR = 500
LIFT = "KMD_GORA_X_Y 300 200"


def drilled(clear: int | None = CLEAR) -> Bench:
    """The paper's machine with its head down in a hole, about to lift it."""
    b = Bench(replace(shipped("pcb-drill"), drill_clear_steps=clear)).ready()
    b.queue("KMD_WIERTLO_DOL").finish()
    assert b.positions()[2] > CLEAR
    return b


def spindles(down: str) -> Bench:
    """The eight-axis machine with some spindles below ``clear``."""
    b = Bench(replace(shipped("eight-axis"), drill_down_steps=120, drill_clear_steps=100)).ready()
    b.queue(f"KMD_WIERTLO_DOL {down}").finish()
    return b


def started(b: Bench) -> bool:
    return b.m.axes[0].counting


@pytest.mark.parametrize("clear", [CLEAR, 1, None])
def test_x_and_y_start_in_the_first_tick_that_finds_the_head_clear(clear: int | None) -> None:
    b = drilled(clear).queue(LIFT)
    place, counting = b.positions()[2], True
    while not started(b):
        place, counting = b.positions()[2], b.m.axes[2].counting or not b.m.busy
        b.tick()
    assert not counting if clear is None else place == clear, "as the tick began"
    b.finish()
    assert b.positions()[:2] == [300, 200] and not b.m.fault


def test_the_command_ends_with_the_last_of_all_axes() -> None:
    lift, way = (drilled().queue(text).finish() for text in ("KMD_WIERTLO_GORA", "KMD_GOTO_X_Y 900 200"))
    together = drilled().queue("KMD_GORA_X_Y 900 200").finish()
    assert max(lift, way) < together < lift + way - 300
    assert drilled().queue(LIFT).finish() == lift, "X and Y rest before the head does"
    assert drilled().queue("KMD_GORA_X_Y 0 0").finish() == lift, "no way to go"


def test_held_before_the_head_is_clear_x_and_y_wait_for_the_resume() -> None:
    for ticks in range(1, 400, 37):
        b = drilled().queue(LIFT).tick(ticks).ask(Request.HOLD).tick(60)
        held = started(b), b.positions()[0]
        b.tick(300)
        assert (started(b), b.positions()[0]) == held, "nothing starts in a hold"
        b.ask(Request.RESUME).finish()
        assert b.positions()[:2] == [300, 200] and b.m.position_known and not b.m.fault
        assert not any(b.ticker.lost_steps())


@pytest.mark.parametrize("request_made", [Request.STOP, Request.ESTOP])
def test_stopped_before_the_head_is_clear_they_never_start(request_made: Request) -> None:
    b = drilled().queue(LIFT).tick(40).ask(request_made).tick(3000)
    assert b.positions()[:2] == [0, 0] and not b.m.lifting
    assert b.m.condition == (Condition.READY if request_made == Request.STOP else Condition.LATCHED)


def test_a_spindle_that_is_not_raised_and_not_clear_keeps_x_and_y_where_they_are() -> None:
    b = spindles("z1 z2").queue("KMD_GORA_X_Y 300 200 z1")
    b.finish()
    assert (b.m.fault, b.positions()[:2]) == (Fault.HEAD_NOT_UP, [0, 0])
    b = spindles("z2 z5").queue("KMD_GORA_X_Y 300 200 z2 z5")
    b.finish()
    assert (b.m.fault, b.positions()[:2]) == (Fault.NONE, [300, 200])


def test_a_place_out_of_reach_is_refused_before_the_heads_move() -> None:
    b = drilled().queue("KMD_GORA_X_Y 99999 0")
    before = b.positions()
    b.finish()
    assert (b.m.fault, b.positions()) == (Fault.SOFT_LIMIT, before)
    b = Bench(shipped("pcb-drill")).queue(LIFT)
    b.finish()
    assert b.m.fault == Fault.HOMING_REQUIRED


def test_each_spindle_has_a_feed_of_its_own() -> None:
    """The greater of its own floor and that of the command."""
    b = spindles("z1 z2").queue("KMD_PREDKOSC 5; KMD_WIERTLO_GORA z1=3 z2=40").tick(2)
    assert [b.m.axes[index].min_interval for index in (2, 3)] == [5, 40]
    b.finish()
    b.queue("KMD_WIERTLO_DOL z3=9 z4").tick(1)
    assert [b.m.axes[index].min_interval for index in (4, 5)] == [9, 0]
