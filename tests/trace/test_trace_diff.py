"""The first difference: the right tick for every way in which runs can part, in a dozen lines."""

import io
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.trace import Signal, Trace, first_difference, read_text, render, write_text

Build = Callable[..., Trace]


def test_a_run_does_not_differ_from_itself_nor_from_its_file(trace: Trace) -> None:
    file = io.StringIO()
    write_text(trace, file)
    file.seek(0)
    assert first_difference(trace, trace) is None
    assert first_difference(read_text(file), trace) is None


@pytest.mark.parametrize(
    ("row", "tick", "signal", "expected", "actual", "command"),
    [
        ((6, "out.0", 0x24), 6, "out.0", "0x00000025", "0x00000024", "1:KMD_GOTOdXdY"),
        ((8, "out.0", 0x05), 8, "out.0", "0x00000025", "0x00000005", "1:KMD_GOTOdXdY"),  # a step too early
        ((10, "out.0", 0x25), 10, "out.0", "0x00000005", "0x00000025", "1:KMD_GOTOdXdY"),  # a step left out
        ((11, "out.0", 0x00), 11, "out.0", "0x00000005", "0x00000000", "2:KMD_KONIEC"),
        ((13, "fault", 0), 13, "fault", "SOFT_LIMIT", "-", "-"),
        ((14, "fault", 0), 14, "fault", "SOFT_LIMIT", "-", "-"),
    ],
)
def test_where_runs_part(
    trace: Trace,
    changed: Build,
    row: tuple[int, str, int],
    tick: int,
    signal: str,
    expected: str,
    actual: str,
    command: str,
) -> None:
    found = first_difference(trace, changed(row))
    assert found is not None
    assert (found.tick, found.signal, found.expected, found.actual) == (tick, signal, expected, actual)
    assert found.command == command
    back = first_difference(changed(row), trace)
    assert back is not None
    assert (back.tick, back.signal, back.expected, back.actual) == (tick, signal, actual, expected)


def test_stimuli_and_derived_signals_count_only_when_named(trace: Trace, changed: Build) -> None:
    other = changed((3, "in.0", 0x14), (10, "x.position", 0))
    assert first_difference(trace, other) is None
    assert getattr(first_difference(trace, other, ["x.position"]), "tick", None) == 10
    assert getattr(first_difference(trace, other, ["x.position", "in.0"]), "tick", None) == 3
    with pytest.raises(KeyError, match=r"out\.9"):
        first_difference(trace, other, ["out.9"])


def test_the_first_declared_signal_counts_within_a_tick(trace: Trace, changed: Build) -> None:
    found = first_difference(trace, changed((7, "fault", 1), (7, "out.0", 0)))
    assert found is not None
    assert (found.tick, found.signal) == (7, "out.0")


@pytest.mark.parametrize("end", [13, 0, 12])
def test_a_run_that_is_over_too_soon(trace: Trace, changed: Build, end: int) -> None:
    found = first_difference(trace, changed(end=end))
    assert found is not None
    assert (found.tick, found.signal, found.expected, found.actual) == (
        end,
        "end",
        "15 ticks",
        f"{end} ticks",
    )


def test_a_change_in_the_last_common_tick_comes_before_the_end(trace: Trace, changed: Build) -> None:
    found = first_difference(trace, changed((12, "out.0", 0), end=13))
    assert found is not None
    assert (found.tick, found.signal) == (12, "out.0")


def test_a_response_that_was_not_recorded(trace: Trace) -> None:
    kept = Signal("out.0", "word", stimulus=False)
    ticks, values = trace.changes_of("out.0")
    alone = Trace.of_changes((), [kept], ticks, np.zeros_like(ticks), values, trace.end)
    found = first_difference(trace, alone)
    assert found is not None
    assert (found.tick, found.signal, found.expected, found.actual) == (0, "fault", "-", "(not recorded)")


RENDERED = """\
first difference at tick 10: out.0
  expected  0x00000005
  actual    0x00000027
  bits      x.1b should be off, bit 5 should be off
  command   1:KMD_GOTOdXdY
  changes around it (- expected only, + actual only, 3 before and after):
           0 out.0 0x00000000
           6 out.0 0x00000025
  -       10 out.0 0x00000005
  +       10 out.0 0x00000027
  +       12 out.0 0x00000001"""


def test_rendered(trace: Trace, changed: Build) -> None:
    found = first_difference(trace, changed((10, "out.0", 0x27), (12, "out.0", 1)))
    assert found is not None
    assert found.bits == (1, 5)
    assert render(found, {"out.0": ("x.1a", "x.1b")}) == RENDERED


def test_rendered_in_ascii_and_without_bits(changed: Build) -> None:
    found = first_difference(changed(), changed((13, "fault", 0)))
    assert found is not None
    text = render(found)
    assert text.isascii()
    assert "bits" not in text
    assert "  expected  SOFT_LIMIT" in text.splitlines()


def test_changes_around_are_few_and_never_claim_what_was_not_compared(changed: Build) -> None:
    """One run toggles every tick: the other's later changes are beyond what is shown, not missing."""
    busy = changed(*((tick, "out.0", tick) for tick in range(4, 15)))
    found = first_difference(changed(), busy)
    assert found is not None
    assert [(near.tick, near.side) for near in found.around] == [
        (0, " "),
        (4, "+"),
        (5, "+"),
        (6, "+"),
        (6, "-"),
    ]


Samples = st.lists(st.tuples(st.integers(0, 2), st.integers(0, 2)), min_size=1, max_size=12)
PAIR = (Signal("out.0", "word", stimulus=False), Signal("fault", "name", False, names=("-", "A", "B")))
OTHER_PAIR = (PAIR[0], Signal("fault", "name", False, names=("-", "B", "A")))


def sampled(signals: tuple[Signal, ...], samples: list[tuple[int, int]]) -> Trace:
    values = np.array(samples)
    ticks, signal = np.divmod(np.arange(values.size), len(signals))
    return Trace.of_changes((), signals, ticks, signal, values.ravel(), len(samples))


@settings(deadline=None)
@given(Samples, Samples)
def test_agrees_with_comparing_tick_by_tick(expected: list[tuple[int, int]], actual: list[tuple[int, int]]) -> None:
    """Also where the two traces number the same words differently."""
    renumbered = [(out, (0, 2, 1)[fault]) for out, fault in actual]
    found = first_difference(sampled(PAIR, expected), sampled(OTHER_PAIR, renumbered))
    ticks = range(min(len(expected), len(actual)))
    by_hand = [
        (tick, signal.name)
        for tick in ticks
        for index, signal in enumerate(PAIR)
        if expected[tick][index] != actual[tick][index]
    ]
    if len(expected) != len(actual):
        by_hand.append((len(ticks), "end"))
    assert (found and (found.tick, found.signal)) == (by_hand[0] if by_hand else None)
