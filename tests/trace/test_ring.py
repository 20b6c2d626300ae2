"""The recorder in shared memory: what goes in comes out, in order; what was lost is told."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.cli import main
from drillctl.ticker.child_process import ChildProcess
from drillctl.trace import Recorder, Signal
from drillctl.trace.ring import CAPACITY, RingRecorder

SIGNALS = [Signal("a", "count", True), Signal("b", "count", False)]
CHANGES = 5 * CAPACITY


@given(st.lists(st.tuples(st.integers(0, 1), st.integers(-3, 3), st.booleans()), max_size=200))
@settings(max_examples=60, deadline=None)
def test_the_ring_keeps_what_a_recorder_keeps(sets: list[tuple[int, int, bool]]) -> None:
    ring, recorder, drained = RingRecorder(len(SIGNALS)), Recorder(SIGNALS), []
    for tick, (index, value, drain) in enumerate(sets):
        ring.set(index, tick, value)
        recorder.set(index, tick, value)
        if drain:
            drained.append(ring.drain())
    changes = np.concatenate([*drained, ring.drain()])
    kept = recorder.finish(len(sets))
    again = type(kept).of_changes((), SIGNALS, changes["tick"], changes["signal"], changes["value"], len(sets))
    assert again == kept and not ring.overrun


def test_a_reader_in_another_process_misses_nothing() -> None:
    """Through many turns of the ring, the writer waiting for nobody but for this test's sake."""
    ring = RingRecorder(1)

    def write() -> None:
        for tick in range(CHANGES):
            while tick - int(ring._state["taken"][0]) >= CAPACITY:
                pass
            ring.set(0, tick, tick)

    writer, came = ChildProcess(write), []
    while not writer.gone:
        came.append(ring.drain())
    came.append(ring.drain())
    ticks = np.concatenate(came)["tick"]
    assert np.array_equal(ticks, np.arange(CHANGES)) and not ring.overrun


def test_a_reader_that_falls_behind_is_told() -> None:
    ring = RingRecorder(1)
    for tick in range(CAPACITY + 1):
        ring.set(0, tick, tick)
    assert ring.overrun
    kept = ring.drain()
    assert len(kept) == CAPACITY and kept["tick"][-1] == CAPACITY - 1


def test_a_trace_with_a_hole_is_not_replayed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "q.kmd").write_text("KMD_RUCHd x=5\n")
    trace = tmp_path / "q.trace"
    assert main(["run", str(tmp_path / "q.kmd"), "--trace", str(trace)]) == 0
    assert main(["replay", str(trace)]) == 0
    trace.write_text(trace.read_text().replace("seed 0\n", "seed 0\noverrun 1\n"))
    assert main(["replay", str(trace)]) == 2
    assert "changes are missing (overrun)" in capsys.readouterr().err
