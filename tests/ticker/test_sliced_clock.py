"""The simulated clock: slices of what is due, never late, the pace told; and a machine of fine ticks run by it."""

from pathlib import Path

import pytest

from drillctl.execution.clock import PacedClock
from drillctl.machine import Library, shipped_tables
from drillctl.ticker import realtime
from drillctl.ticker.sliced_clock import FRAME_NS, MOST_FRAMES, SlicedClock

LIBRARY = Library((shipped_tables(),))


class Hands:
    """Time that passes only as it is slept, or told."""

    def __init__(self) -> None:
        self.now_ns = 1_000

    def sleep(self, seconds: float) -> None:
        self.now_ns += round(seconds * 1e9)


def clock_of(tick_hz: int) -> tuple[SlicedClock, Hands]:
    hands = Hands()
    return SlicedClock(tick_hz, lambda: hands.now_ns, hands.sleep), hands


@pytest.mark.parametrize(("tick_hz", "frames"), [(100_000, 100), (4167, 100), (730, 100), (500, 60), (100, 40), (7, 9)])
def test_real_time_is_kept_to_the_tick(tick_hz: int, frames: int) -> None:
    clock, hands = clock_of(tick_hz)
    begun_ns, ticks = hands.now_ns, 0
    for _ in range(frames):
        assert clock.wait() == 0
        ticks += clock.ticks
    assert abs(ticks - (hands.now_ns - begun_ns) * tick_hz / 1e9) <= 1


def test_a_slow_computer_stretches_time_and_the_pace_says_by_how_much() -> None:
    clock, hands = clock_of(100_000)
    for _ in range(60):
        clock.wait()
        ran = clock.ticks // 4
        hands.now_ns += 5 * FRAME_NS  # so long took these ticks
        clock.ran(ran)
        assert clock.ticks <= MOST_FRAMES * FRAME_NS * 100_000 // 1_000_000_000
    assert 10 <= clock.pace <= 20 and clock.late == clock.worst_ns == 0
    for _ in range(200):
        clock.wait()
        clock.ran(clock.ticks)
    assert clock.pace == 100


def test_another_rate_counts_from_the_next_slice() -> None:
    clock, _ = clock_of(1000)
    clock.wait()
    assert clock.ticks == 10
    clock.set_rate(100_000)
    clock.wait()
    assert clock.ticks == 1000 and clock.period_ns == 10_000


def test_the_rate_that_a_computer_carries_is_tried_by_the_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the ticks alone would allow is no answer where the clock is late: it is halved until it goes."""
    machine = LIBRARY.machine("pcb-drill").at_rate(40_000)
    monkeypatch.setattr(realtime, "_seconds_a_tick", lambda ticker: 1 / 50_000)
    monkeypatch.setattr(realtime, "_late_share", lambda ticker, hz: 0.7 if hz > 6_000 else 0.0)
    assert realtime.most_ticks_hz(machine) == 5_000
    monkeypatch.setattr(realtime, "_late_share", lambda ticker, hz: 0.0)
    assert realtime.most_ticks_hz(machine) == 40_000


def test_a_trial_counts_the_late_ticks(monkeypatch: pytest.MonkeyPatch) -> None:
    class Late(PacedClock):
        def wait(self) -> int:
            self.late += 1
            return 3

    ticker = realtime._moving(LIBRARY.machine("pcb-drill"))
    monkeypatch.setattr(realtime, "PacedClock", Late)
    assert realtime._late_share(ticker, 500) == 1
    assert ticker.controller.tick > 0


@pytest.mark.skipif("sys.platform != 'linux'", reason="real pace")
def test_a_machine_of_fine_ticks_runs_on_a_screen_and_is_never_late(tmp_path: Path) -> None:
    from drillctl.console.machine_console import MachineConsole
    from drillctl.ticker.launch import RunSettings
    from tests.support.operator import until

    made = MachineConsole(LIBRARY, LIBRARY.machine("boiler-drum"), RunSettings(pace="real", sliced=True))
    try:
        made.run_queue("KMD_INICJALIZACJA\nKMD_RUCH x=40\n")
        until(made, lambda: made.view().axes[0].position_steps == 40 and not made.view().moving)
        view = made.view()
        assert view.fault is None and view.late == 0 and view.pace > 0
        assert view.axes[0].state == 0
    finally:
        made.close()
