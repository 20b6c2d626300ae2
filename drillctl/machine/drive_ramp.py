"""The ramp of a drive from its axis's parameters: greatest speed, acceleration, S share, pulse equivalent, gear.

Rule: a state a step. The interval of each step is the time in which a drive that accelerates from rest goes that step,
rounded up to whole ticks, so that neither speed nor acceleration is ever above the parameter's. Only ``+ - * /`` and
comparisons of floats are used, which give the same ramp on every computer. Lengths mm, times ticks of a column.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import ceil

from drillctl.language import Message
from drillctl.machine.parameters import ParameterRow
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_formula import LONGEST_INTERVAL, MOST_STATES, FormulaError

FROM_PARAMETERS = "from-parameters"  # in place of a ramp's name
SPEED, ACCELERATION, S_SHARE = "greatest_speed_mm_min", "acceleration_mm_min2", "s_share"
SECONDS_A_MINUTE = 60
KEPT_WITHIN = 0.02  # by how much less than its parameter the greatest speed may be
ROUNDING = Fraction(1, 1000)  # by how much it may be more: a speed is written with a few digits
UNSET_HZ = 100  # columns a second of an axis whose parameters are not all set: slow enough for any drive
HALVINGS = 48  # of the time in which a step may end


def pulses_per_mm(row: ParameterRow) -> Fraction | None:
    """Returns the pulses to a millimetre of travel, exactly; None where a parameter is unset."""
    pulse_mm, numerator, denominator = map(row.number, ("pulse_equivalent_mm", "gear_numerator", "gear_denominator"))
    if not pulse_mm or not numerator or not denominator:
        return None
    return Fraction(int(denominator), int(numerator)) / Fraction(str(pulse_mm))


def drive_ramp(row: ParameterRow, tick_hz: int, columns_per_step: int) -> RampTable:
    """Returns the ramp of an axis with these parameters; without a ramp and slow where they are not all set. Raises
    FormulaError with the parameter's name.
    """
    scale, speed, acceleration = pulses_per_mm(row), row.number(SPEED), row.number(ACCELERATION)
    curved_share = row.number(S_SHARE)
    if scale is None or speed is None or acceleration is None or curved_share is None:
        slow = max(1, round(tick_hz / UNSET_HZ))
        return _table((slow, slow))
    return _computed(scale, speed, acceleration, curved_share, Fraction(tick_hz, columns_per_step))


@lru_cache(64)
def _computed(
    scale: Fraction, speed_mm_min: float, acceleration_mm_min2: float, curved_share: float, rate: Fraction
) -> RampTable:
    """``scale`` pulses a millimetre; ``rate`` the greatest number of steps a second."""
    steps_s = Fraction(str(speed_mm_min)) / SECONDS_A_MINUTE * scale
    top = _top(rate, steps_s, scale)
    gain = float(Fraction(str(acceleration_mm_min2)) / SECONDS_A_MINUTE**2 * scale / rate**2)
    return _table(_intervals(_Course.of(float(steps_s / rate), gain, curved_share), top))


def _top(rate: Fraction, steps_s: Fraction, scale: Fraction) -> int:
    """Returns the interval of the greatest speed, in ticks a column. Raises FormulaError where it is lost by more than
    KEPT_WITHIN.
    """
    exact = rate / steps_s
    top = ceil(exact * (1 - ROUNDING))
    if 1 - exact / top <= KEPT_WITHIN:
        return top
    slower, faster = (float(rate / ticks / scale * SECONDS_A_MINUTE) for ticks in (top, max(1, top - 1)))
    fields = {"name": SPEED, "wanted": f"{float(steps_s / scale * SECONDS_A_MINUTE):g}", "slower": f"{slower:g}"}
    if top == 1:
        raise FormulaError(
            SPEED,
            Message("{name}: the tick rate can't give {wanted} mm/min; the greatest is {slower}", **fields),
        )
    raise FormulaError(
        SPEED,
        Message(
            "{name}: the tick rate can't give {wanted} mm/min; the nearest are {slower} and {faster}",
            faster=f"{faster:g}",
            **fields,
        ),
    )


@dataclass(frozen=True, slots=True)
class _Course:
    """How a drive gains speed from rest. Speeds are steps a tick, accelerations that a tick.

    speed    at the end; ``steepest`` the greatest acceleration
    whole    ticks of the ramp; ``curve`` ticks of each end of it in which the acceleration grows or fades
    """

    speed: float
    steepest: float
    whole: float
    curve: float

    @classmethod
    def of(cls, speed: float, steepest: float, curved_share: float) -> "_Course":
        """From the greatest speed and acceleration."""
        whole = speed / (steepest * (1 - curved_share / 2))
        return cls(speed, steepest, whole, whole * curved_share / 2)

    def way(self, tick: float) -> float:
        """The steps made by a tick, whole ones and a part."""
        if tick >= self.whole:
            return self.speed * (self.whole / 2 + (tick - self.whole))
        if tick > self.whole - self.curve:  # the end is the beginning, looked at from the end
            left = self.whole - tick
            return self.speed * (self.whole / 2 - left) + self.way(left)
        if tick < self.curve:
            return self.steepest * tick * tick * tick / (6 * self.curve)
        half = tick - self.curve / 2
        return self.steepest * (half * half / 2 + self.curve * self.curve / 24)

    def ends(self) -> Iterator[float]:
        """Yields the tick, with its part, in which each step ends."""
        made, begin, longest = 0, 0.0, self.whole + 2 / self.speed
        while True:
            made += 1
            low, high = begin, begin + longest
            for _ in range(HALVINGS):
                middle = (low + high) / 2
                low, high = (middle, high) if self.way(middle) < made else (low, middle)
            begin, longest = high, (high - begin) * 1.001  # each step is quicker than the one before
            yield high


def _intervals(course: _Course, top: int) -> tuple[int, ...]:
    """Returns the interval of each state. One lasts until what the next adds to the speed, over the time that it
    lasted, is within the acceleration. Raises FormulaError.
    """
    if course.way(course.whole) > MOST_STATES:
        raise _too_long()
    found: list[int] = []
    before = lasted = 0.0
    for end in course.ends():
        wanted = max(top, ceil(end - before - 1e-6))
        before = end
        if not found:
            interval = wanted
        else:
            quickest = 1 / (1 / found[-1] + course.steepest * lasted)
            interval = min(found[-1], max(wanted, ceil(quickest - 1e-9)))
        if interval > LONGEST_INTERVAL:
            reason = Message("{name}: the first step would last more than {most} ticks", name=ACCELERATION,
                             most=LONGEST_INTERVAL)  # fmt: skip
            raise FormulaError(ACCELERATION, reason)
        lasted = interval + (lasted if found and interval == found[-1] else 0)
        found.append(interval)
        if interval <= top:
            return tuple(found if len(found) > 1 else 2 * found)
        if len(found) > MOST_STATES:
            raise _too_long()
    raise AssertionError  # a course never ends


def _too_long() -> FormulaError:
    reason = Message("{name}: the ramp has more than {most} steps", name=ACCELERATION, most=MOST_STATES)
    return FormulaError(ACCELERATION, reason)


def _table(intervals: tuple[int, ...]) -> RampTable:
    """A state a step: so braking from state s takes s steps, and no distance is missed."""
    top = len(intervals) - 1
    states = tuple(map(abs, (*range(top + 1), *range(-top, 0))))
    brake = tuple(state + 1 if state else 0 for state in states)
    return RampTable(FROM_PARAMETERS, top, tuple(intervals[state] for state in states), states, brake)
