"""24 V on a winding at rest would burn it: forcing goes off one tick after the last step (docs/SPEC.md, 1.5)."""

import pytest

from drillctl.kmd import Request
from tests.support.bench import Bench, shipped

HOT_TICK = 6  # of a move's first step, which puts column 1 out; it carries 24 V


def bench(text: str, end: bool = True) -> Bench:
    return Bench(shipped("pcb-drill")).queue(text, end)


def forced_ticks(b: Bench, axis: str) -> list[int]:
    """The ticks whose image carries an axis's forcing."""
    return [tick for tick, image in enumerate(b.images) if image & b.forcing(axis)]


def test_an_axis_that_has_come_to_rest_keeps_its_column_without_forcing() -> None:
    b = bench("KMD_RUCHd x=1; KMD_CZEKAJ 20")
    b.finish()
    assert forced_ticks(b, "x") == [HOT_TICK]
    assert set(b.images[HOT_TICK + 1 :]) == {b.bits("x", "1a", "2a")}


def test_another_move_right_behind_does_not_keep_it() -> None:
    b = bench("KMD_RUCHd x=1; KMD_RUCHd x=-1; KMD_RUCHd x=1")
    b.finish()
    assert forced_ticks(b, "x") == [HOT_TICK, HOT_TICK + 14]


def test_an_axis_rests_while_another_still_moves() -> None:
    b = bench("KMD_RUCHd x=1 y=20")
    b.finish()
    assert forced_ticks(b, "x") == [HOT_TICK]


@pytest.mark.parametrize(("leader", "follower"), [("x", "y"), ("y", "x"), ("x", "z"), ("z", "y")])
def test_the_last_step_of_a_linked_axis_carries_its_forcing(leader: str, follower: str) -> None:
    """The follower's fourth column carries 24 V, and goes out as the table has it, whichever axis is served first."""
    b = bench(f"KMD_LINIAd {leader}=5 {follower}=4; KMD_CZEKAJ 9")
    last_step = b.done_at(1)
    b.finish()
    assert forced_ticks(b, follower)[-1] == last_step
    assert b.images[last_step] & b.bits(follower) == b.bits(follower, "1a", "2b", "24b")
    assert b.images[last_step + 1] & b.bits(follower) == b.bits(follower, "1a", "2b")


def test_a_linked_axis_that_sits_a_step_out_rests_meanwhile() -> None:
    b = bench("KMD_LINIAd x=100 y=1")
    b.finish()
    assert len(forced_ticks(b, "y")) == 1  # the leader is at full speed, so its next step is one tick later


@pytest.mark.parametrize("request_at", [HOT_TICK, HOT_TICK + 1, HOT_TICK + 2])
def test_a_hold_rests_too(request_at: int) -> None:
    b = bench("KMD_RUCHd x=30")
    b.tick(request_at).ask(Request.HOLD).tick(40)
    assert b.m.axes[0].state == 0
    rested = len(forced_ticks(b, "x"))
    b.ask(Request.RESUME).tick(6)
    assert len(forced_ticks(b, "x")) == rested
    b.finish()
    assert b.positions()[0] == 30


def test_a_resume_in_the_tick_after_the_rest_comes_too_late_for_the_forcing() -> None:
    b = bench("KMD_RUCHd x=4")
    b.tick(HOT_TICK + 1).ask(Request.HOLD)
    b.until(lambda: not b.m.moving)
    b.ask(Request.RESUME).tick()
    assert not b.images[-1] & b.forcing("x")


def test_a_stop_masks_one_tick_after_the_last_step() -> None:
    b = bench("KMD_RUCHd x=30")
    b.tick(HOT_TICK + 3).ask(Request.STOP).tick(50)
    assert b.positions()[0] == 2
    b.queue("KMD_RUCHd x=-2")
    b.finish()
    assert max(forced_ticks(b, "x")) < len(b.images) - 1


def test_a_job_that_starves_does_not_keep_the_windings_forced() -> None:
    b = bench("KMD_RUCHd x=1", end=False)
    b.tick(HOT_TICK + 1)
    assert b.images[-1] & b.forcing("x")
    b.tick()
    assert (b.m.underruns, b.m.tick) == (1, HOT_TICK + 1)
    assert b.images[-1] == b.bits("x", "1a", "2a")


def test_a_table_of_its_own_for_backward_rests_on_the_column_that_was_put_out() -> None:
    """A new direction is known before the first step that way; what rests is still the old column."""
    b = bench("KMD_RUCHd x=2; KMD_RUCHd x=-2")
    axis = b.m.axes[0]
    axis.hold_patterns = ((), axis.hold_patterns[1], tuple(0 for _ in axis.hold_patterns[1]))
    b.until(lambda: b.m.done == 1)
    b.tick(2)
    assert b.images[-1] == b.bits("x", "1a", "2a")
