"""Outputs looked at in segments, against the columns made of all their changes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.trace import Segments, Signal, Trace, tape_lanes
from drillctl.trace.lanes import Column
from drillctl.trace.tape_lanes import MANY, TapeColumn, TapeView
from drillctl.trace.tapes import Tape

END = 400
rows = st.lists(st.tuples(st.integers(0, END - 1), st.integers(0, 3)), max_size=60)
tick = st.integers(-1, END)


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """So that the summary is used for short stretches too."""
    monkeypatch.setattr(tape_lanes, "BLOCK_TICKS", 16)
    monkeypatch.setattr(tape_lanes, "SHORT_STRETCH", 20)
    monkeypatch.setattr(tape_lanes, "CHUNK_TICKS", 64)


def segments_of(values: list[tuple[int, int]], cuts: list[int]) -> Segments:
    """A run of one card; what it puts out in two tapes, each bit on its own, cut into slices."""
    ticks, words = zip(*values, strict=True) if values else ((), ())
    signals = [Signal("out.0", "word", False)]
    whole = Segments.of_trace(Trace.of_changes((), signals, ticks, [0] * len(ticks), words, END))
    pool = np.concatenate((whole.pool[:1] * 0, whole.pool & np.uint64(1), whole.pool & np.uint64(2)))  # it begins dark
    starts = np.array(sorted({0, *cuts}))
    lengths = np.diff(starts, append=END)
    return Segments(whole.rest, whole.signals, pool, (Tape(1 + starts, lengths), Tape(1 + END + starts, lengths)))


def both(values: list[tuple[int, int]], cuts: list[int], bit: int, invert: bool) -> tuple[Column, TapeColumn]:
    """A lane of all changes, and the same one of the segments."""
    segments, column = segments_of(values, cuts), Column()
    ticks, words = segments.trace().changes_of("out.0")
    column.append(ticks, (words >> bit & 1) ^ int(invert))
    return column, TapeColumn(TapeView(segments), bit, invert)


@settings(max_examples=40, deadline=None)
@given(rows, st.lists(st.integers(1, END - 1)), st.integers(0, 1), st.booleans(), st.data())
def test_every_answer_is_that_of_the_changes(
    values: list[tuple[int, int]], cuts: list[int], bit: int, invert: bool, data: st.DataObject
) -> None:
    column, taped = both(values, cuts, bit, invert)
    for at in data.draw(st.lists(st.integers(0, END - 1), max_size=5)):
        assert taped.at(at) == column.at(at)
    first, end = sorted(data.draw(st.tuples(st.integers(0, END - 1), st.integers(1, END))))
    if first < end:
        for mine, theirs in zip(taped.window(first, end), column.window(first, end), strict=True):
            np.testing.assert_array_equal(mine, theirs)
    edges = np.array(sorted(data.draw(st.sets(st.integers(0, END), min_size=2, max_size=9))))
    for _ in range(2):  # the second time from memory
        values_, changes = taped.strip(edges)
        expected, counted = column.strip(edges)
        np.testing.assert_array_equal(values_, expected)
        np.testing.assert_array_equal(changes, np.minimum(counted, MANY))
    for onset in (False, True):
        for direction in (1, -1):
            at = data.draw(tick)
            assert taped.find(at, direction, onset) == column.find(at, direction, onset), (at, direction, onset)
