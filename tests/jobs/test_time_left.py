"""The time left: what the commands still to come take, whatever befell the ones before."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from drillctl.jobs.estimate import TimeLeft

TICKS = st.lists(st.integers(1, 500), min_size=1, max_size=12)


@given(TICKS)
def test_a_job_that_goes_as_foreseen_counts_down_to_nothing(ticks: list[int]) -> None:
    left, total = TimeLeft(np.array(ticks)), sum(ticks)
    ends = np.cumsum(ticks)
    for tick in range(total + 1):
        done = int(np.searchsorted(ends, tick, side="right"))
        assert left.ticks(done, tick) == total - tick


@given(TICKS, st.data())
def test_a_wait_or_another_start_changes_nothing_of_what_comes_after(ticks: list[int], data: st.DataObject) -> None:
    left, tick = TimeLeft(np.array(ticks)), 0
    for done, foreseen in enumerate(ticks):
        to_come = sum(ticks[done + 1 :])
        assert left.ticks(done, tick) == foreseen + to_come
        taken = data.draw(st.integers(1, 2000))
        tick += taken
        assert left.ticks(done, tick) == max(foreseen - taken, 0) + to_come
    assert left.ticks(len(ticks), tick) == left.ticks(len(ticks) + 3, tick + 9) == 0


def test_nothing_is_left_of_what_was_never_foreseen() -> None:
    assert TimeLeft(np.array([], np.int64)).ticks(0, 5) == 0
