"""The record: what is kept, in what order, how it is asked, and what it refuses."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.trace import Recorder, Signal, Trace, dense, pack_command

COUNTS = (Signal("late", "count", stimulus=True), Signal("z.position", "count", stimulus=False))


def counts(*rows: tuple[int, int, int], end: int) -> Trace:
    recorder = Recorder(COUNTS)
    for index, tick, value in rows:
        recorder.set(index, tick, value)
    return recorder.finish(end)


def rows_of(trace: Trace) -> list[tuple[int, int, int]]:
    return list(zip(trace.ticks.tolist(), trace.signal.tolist(), trace.values.tolist(), strict=True))


def test_only_changes_are_kept() -> None:
    trace = counts((0, 0, 3), (0, 1, 3), (0, 2, 4), (0, 3, 4), end=5)
    assert rows_of(trace) == [(0, 0, 3), (0, 1, 0), (2, 0, 4)]


def test_nothing_is_kept_while_nothing_changes() -> None:
    recorder = Recorder(COUNTS)
    for tick in range(1000):
        recorder.set(0, tick, tick // 500)
    assert len(recorder) == 2


def test_a_signal_set_late_was_zero_before() -> None:
    trace = counts((1, 4, 7), (0, 5, 0), end=6)
    assert rows_of(trace) == [(0, 0, 0), (0, 1, 0), (4, 1, 7)]


def test_rows_of_one_tick_stand_as_declared_and_the_last_value_counts() -> None:
    trace = counts((1, 2, 9), (0, 2, 8), (1, 2, 5), end=3)
    assert rows_of(trace)[2:] == [(2, 0, 8), (2, 1, 5)]


def test_a_value_that_came_and_went_within_a_tick_is_no_change() -> None:
    assert rows_of(counts((0, 2, 9), (0, 2, 0), end=3)) == [(0, 0, 0), (0, 1, 0)]


def test_a_run_of_no_ticks_has_no_rows() -> None:
    trace = Recorder(COUNTS).finish(0)
    assert (rows_of(trace), dense(trace, "late").tolist()) == ([], [])


def test_column_types_and_read_only(trace: Trace) -> None:
    assert [column.dtype.name for column in (trace.ticks, trace.signal, trace.values)] == [
        "int64",
        "int32",
        "int64",
    ]
    with pytest.raises(ValueError, match="read-only"):
        trace.values[0] = 1


def test_questions(trace: Trace) -> None:
    assert [each.tolist() for each in trace.changes_of("x.position")] == [[0, 6, 10], [0, -1, -2]]
    assert [trace.value_at("x.position", tick) for tick in (0, 5, 6, 9, 10, 14)] == [0, 0, -1, -1, -2, -2]
    assert trace.shown_at("kmd", 3) == "1:KMD_GOTOdXdY"
    assert trace.header_value("tick_hz") == "500"
    assert trace.header_values("command") == ("KMD_GOTOdXdY 2 0", "KMD_KONIEC")
    assert trace.header_values("seed") == ()


def test_questions_without_an_answer(trace: Trace) -> None:
    for tick in (-1, 15):
        with pytest.raises(IndexError, match="outside"):
            trace.value_at("kmd", tick)
    with pytest.raises(KeyError, match=r"out\.7"):
        trace.changes_of("out.7")
    with pytest.raises(KeyError, match="seed"):
        trace.header_value("seed")


@pytest.mark.parametrize(
    ("kind", "value", "shown"),
    [
        ("word", 0x2A, "0x0000002a"),
        ("word", 2**32 - 1, "0xffffffff"),
        ("count", -17, "-17"),
        ("name", 1, "HOLD"),
        ("command", 0, "-"),
        ("command", pack_command(12, 1), "12:HOLD"),
    ],
)
def test_how_values_are_shown(kind: str, value: int, shown: str) -> None:
    assert Signal("any", kind, stimulus=True, names=("-", "HOLD")).show(value) == shown


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        ("word", -1),
        ("word", 2**18),
        ("count", 2**17),
        ("count", -(2**17) - 1),
        ("name", 2),
        ("name", -1),
        ("command", -1),
        ("command", pack_command(1, 2)),
        ("command", pack_command(1, 0)),
        ("command", pack_command(10**9, 1)),
    ],
)
def test_a_value_without_meaning_is_refused(kind: str, value: int) -> None:
    recorder = Recorder([Signal("any", kind, stimulus=True, width_bits=18, names=("-", "HOLD"))])
    recorder.set(0, 3, value)
    with pytest.raises(ValueError, match=f"any: {value} at tick 3 is no {kind}"):
        recorder.finish(4)


@pytest.mark.parametrize(
    ("wrong", "reason"),
    [
        ({"kind": "float"}, "no kind 'float'"),
        ({"width_bits": 33}, "33 bits"),
        ({"name": "two words"}, "without blanks"),
        ({"names": ("-", "HOLD", "HOLD")}, "different"),
    ],
)
def test_a_signal_that_could_not_be_recorded_is_refused(wrong: dict[str, Any], reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        Signal(**{"name": "request", "kind": "name", "stimulus": True, **wrong})


@pytest.mark.parametrize(
    ("signals", "row", "reason"),
    [
        (COUNTS, (4, 0, 1), "ticks 0..3 were run"),
        (COUNTS, (-1, 0, 1), "ticks 0..3 were run"),
        (COUNTS, (0, 2, 1), "only 2"),
        (COUNTS[:1] * 2, (0, 0, 1), "same name"),
    ],
)
def test_rows_that_fit_no_run_are_refused(signals: tuple[Signal, ...], row: tuple[int, int, int], reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        Trace.of_changes((), signals, [row[0]], [row[1]], [row[2]], end=4)


@settings(deadline=None)
@given(st.lists(st.tuples(st.integers(-2, 2), st.integers(-2, 2)), min_size=1, max_size=40))
def test_recording_every_tick_gives_every_tick_back(values: list[tuple[int, int]]) -> None:
    """Sampled densely, a trace is what was set: nothing lost by keeping changes only."""
    rows = [(index, tick, value) for tick, pair in enumerate(values) for index, value in enumerate(pair)]
    trace = counts(*rows, end=len(values))
    for index, signal in enumerate(COUNTS):
        expected = [pair[index] for pair in values]
        assert dense(trace, signal.name).tolist() == expected
        assert [trace.value_at(signal.name, tick) for tick in range(trace.end)] == expected


@settings(deadline=None)
@given(st.permutations(range(12)))
def test_order_of_rows_does_not_matter(order: list[int]) -> None:
    """An engine may hand in a whole column after the other; the trace is the same."""
    ticks, signal = np.divmod(np.arange(12), 2)
    values = np.arange(12) // 3
    straight = Trace.of_changes((), COUNTS, ticks, signal, values, 6)
    mixed = Trace.of_changes((), COUNTS, ticks[order], signal[order], values[order], 6)
    assert straight == mixed


def test_equality_compares_words_not_indexes() -> None:
    def requests(names: tuple[str, ...], value: int, end: int = 9) -> Trace:
        recorder = Recorder([Signal("request", "name", stimulus=True, names=names)])
        recorder.set(0, 4, value)
        return recorder.finish(end)

    hold = requests(("-", "HOLD", "STOP"), 1)
    assert hold == requests(("-", "STOP", "HOLD"), 2)
    assert hold != requests(("-", "HOLD", "STOP"), 2)
    assert hold != requests(("-", "HOLD", "STOP"), 1, end=10)
    assert hold != "HOLD"
