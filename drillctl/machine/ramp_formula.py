"""Ramps computed from a few figures: ``[computed]`` in a ramp's file, in place of its ``[[state]]`` rows.

Rule: all in whole numbers and fractions, so that a ramp is the same on every computer. The starting interval shrinks
either by the same number of ticks a step (paper, section 3.2) or under a given acceleration, whose course is a
trapezium: linear up, constant, linear down. Where an acceleration is given, an interval lasts so many steps that what
its change adds to the speed, over the time that it lasted, is never above it.
"""

from collections.abc import Iterator
from fractions import Fraction
from itertools import groupby, islice
from typing import Annotated

import msgspec

from drillctl.language import Message

MOST_STATES = 4096
LONGEST_INTERVAL = 100_000
MM_PER_M = 1000
Hertz = Annotated[float, msgspec.Meta(gt=0, le=100_000)]


class Computed(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """``[computed]``: the scale that the ramp is made for, and its figures.

    tick_hz, pulse_mm       ticks a second, millimetres of travel a pulse; a machine that has others is refused
    start_hz, top_hz        pulses a second of state 0 and of the highest state
    shrink_ticks            ticks by which the interval shrinks a step
    acceleration_m_s2       greatest acceleration, m/s2; one of these two, or both, must be given
    curved_share            without ``shrink_ticks``: share of the ramp's time in which its acceleration changes
    """

    tick_hz: Annotated[int, msgspec.Meta(ge=1, le=100_000)]
    pulse_mm: Annotated[float, msgspec.Meta(gt=0, le=100)]
    start_hz: Hertz
    top_hz: Hertz
    shrink_ticks: Annotated[int, msgspec.Meta(ge=1, le=LONGEST_INTERVAL)] | None = None
    acceleration_m_s2: Annotated[float, msgspec.Meta(gt=0, le=1000)] | None = None
    curved_share: Annotated[float, msgspec.Meta(ge=0, le=1)] = 0


class FormulaError(ValueError):
    """Figures that make no ramp: the key to change, and the reason."""

    def __init__(self, key: str, reason: Message):
        super().__init__(reason)
        self.key, self.reason = key, reason


def computed_intervals(figures: Computed) -> list[int]:
    """Returns the interval of each state from 0 to the highest, in ticks, none longer than the one before. Raises
    FormulaError.
    """
    start, top = (_interval(figures, key) for key in ("start_hz", "top_hz"))
    if start <= top:
        top_hz, start_hz = f"{figures.top_hz:g}", f"{figures.start_hz:g}"
        reason = Message("computed: top_hz {top} is not above start_hz {start}", top=top_hz, start=start_hz)
        raise FormulaError("top_hz", reason)
    limit = None if figures.acceleration_m_s2 is None else _pulses_a_tick2(figures, figures.acceleration_m_s2)
    if figures.shrink_ticks is not None:
        shrinking = iter((*range(start, top, -figures.shrink_ticks), top))
    elif limit is not None:
        steps = list(islice(_curved(start, top, limit, Fraction(str(figures.curved_share))), MOST_STATES + 2))
        if len(steps) > MOST_STATES + 1:
            raise _too_long()
        shrinking = iter(steps)
    else:
        raise FormulaError("start_hz", Message("computed: shrink_ticks or acceleration_m_s2 is missing"))
    intervals: list[int] = []
    for interval in _lasting(shrinking, limit):
        if len(intervals) > MOST_STATES:
            raise _too_long()
        intervals.append(interval)
    return intervals


def _too_long() -> FormulaError:
    reason = Message("computed: the ramp has more than {most} states; make it shorter", most=MOST_STATES)
    return FormulaError("start_hz", reason)


def _interval(figures: Computed, key: str) -> int:
    hertz = Fraction(str(getattr(figures, key)))
    interval = round(Fraction(figures.tick_hz) / hertz)
    if not 1 <= interval <= LONGEST_INTERVAL:
        reason = Message(
            "computed: {key} {hz} is an interval of {ticks} ticks, outside 1..{most}",
            key=key, hz=f"{float(hertz):g}", ticks=interval, most=LONGEST_INTERVAL,
        )  # fmt: skip
        raise FormulaError(key, reason)
    return interval


def _pulses_a_tick2(figures: Computed, metres_a_s2: float) -> Fraction:
    """An acceleration in pulses a tick, a tick."""
    pulses = Fraction(str(metres_a_s2)) * MM_PER_M / Fraction(str(figures.pulse_mm))
    return pulses / figures.tick_hz**2


def _lasting(intervals: Iterator[int], limit: Fraction | None) -> Iterator[int]:
    """Yields each interval as often as it comes, or more often where the change to the next one asks for it."""
    before = times = 0
    for interval, run in groupby(intervals):
        if before:
            yield from _run(before, interval, times, limit)
        before, times = interval, sum(1 for _ in run)
    yield before


def _run(interval: int, following: int, times: int, limit: Fraction | None) -> Iterator[int]:
    if limit is not None:
        gain = Fraction(1, following) - Fraction(1, interval)
        times = max(times, -(-gain // (limit * interval)))
    yield from (interval for _ in range(times))


def _curved(start: int, top: int, limit: Fraction, curved_share: Fraction) -> Iterator[int]:
    """Yields the interval of each step of a ramp of least time under an acceleration; the last one is ``top``.

    The speed at each step is that of the trapezium at the whole tick at which the steps before it are over.
    """
    slow, quick = Fraction(1, start), Fraction(1, top)
    whole = -(-(quick - slow) // (limit * (1 - curved_share / 2)))  # ticks of the ramp
    curve = round(whole * curved_share / 2)  # ticks of each curved end
    steepest = (quick - slow) / (whole - curve)
    yield start
    tick = start
    while tick < whole:
        speed = slow + steepest * _share(tick, whole, curve)
        interval = max(top, -(-1 // speed))
        yield interval
        tick += interval
    yield top


def _share(tick: int, whole: int, curve: int) -> Fraction:
    """The gain in speed up to a tick, in ticks of greatest acceleration."""
    left = whole - tick
    if tick < curve:
        return Fraction(tick * tick, 2 * curve)
    if left < curve:
        return whole - curve - Fraction(left * left, 2 * curve)
    return tick - Fraction(curve, 2)
