"""What may happen to a run, as a table: who is hit, by what, and what of the card or the disk fails.

To try something else, add a row to BLOWS.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from random import Random
from signal import Signals
from typing import Any

Z_TOP, Z_BOTTOM, X_MIN, Y_MIN = 4, 5, 0, 2  # input bits of pcb-drill
HOMED_FLUSHES = 1400  # by then initialisation is over: a sensor that begins to lie within it sets a wrong zero, unseen
# A sensor that answers wrongly for just as long as the head takes to brake, and is well again before the head meets
# the other one, is believed: nothing that software has could tell. So a lie is shorter than that, or stays.
LIE_FLUSHES = (1, 3, 1_000_000)
TARGETS = ("desk", "ticker", "guard")
SIGNALS = (Signals.SIGKILL, Signals.SIGSTOP, Signals.SIGTERM, Signals.SIGINT, Signals.SIGHUP)


@dataclass(frozen=True)
class Blow:
    """One blow. ``target`` gets ``signal`` after a while; ``plan`` is for the card and the disk (faulty.py)."""

    name: str
    target: str | None = None
    signal: Signals | None = None
    plan: Mapping[str, Any] = field(default_factory=dict)
    trace: str | None = None

    @property
    def takes_away(self) -> bool:
        """Whether desk or ticker is gone afterwards, so that the outputs must go off at once."""
        return self.target in ("desk", "ticker") and self.signal in (Signals.SIGKILL, Signals.SIGSTOP)


Make = Callable[[Random, int], Blow]  # given what a run takes, in flushes


def _signalled(target: str, number: Signals) -> Make:
    return lambda rng, last_flush: Blow(f"{number.name} to {target}", target, number)


def _sensor(name: str, bit: int, fails: str, level: int = 0) -> Make:
    def made(rng: Random, last_flush: int) -> Blow:
        first, flushes = rng.randrange(HOMED_FLUSHES, last_flush), rng.choice(LIE_FLUSHES)
        plan = {"fails": fails, "bit": bit, "level": level, "from_flush": first, "flushes": flushes}
        return Blow(name, plan=plan)

    return made


def _dead(name: str, bit: int, level: int) -> Make:
    """Stuck since before the machine was switched on: initialisation itself must see it, or the first hole."""
    plan = {"fails": "stuck", "bit": bit, "level": level, "from_flush": 0, "flushes": LIE_FLUSHES[-1]}
    return lambda rng, last_flush: Blow(name, plan=plan)


def _pulled(rng: Random, last_flush: int) -> Blow:
    first, flushes = rng.randrange(1, last_flush), rng.choice((1, 1_000_000))
    return Blow("port pulled", plan={"fails": "pulled", "from_flush": first, "flushes": flushes})


def _disk(rng: Random, last_flush: int) -> Blow:
    plan = {"fails": "disk", "lines": rng.randrange(10), "room_bytes": rng.choice((0, 1, 8))}
    return Blow("disk full under the journal", plan=plan)


def _trace(rng: Random, last_flush: int) -> Blow:
    return Blow("disk full under the trace", trace="/dev/full")


_SENSORS = {"z_top": Z_TOP, "z_bottom": Z_BOTTOM, "x_min": X_MIN, "y_min": Y_MIN}
BLOWS: tuple[Make, ...] = (
    *(_signalled(target, number) for target in TARGETS for number in SIGNALS),
    *(_sensor(f"{name} stuck at {level}", bit, "stuck", level) for name, bit in _SENSORS.items() for level in (0, 1)),
    *(_dead(f"{name} dead, at {level}", bit, level) for name, bit in _SENSORS.items() for level in (0, 1)),
    *(_sensor(f"{name} bouncing", bit, "bouncing") for name, bit in _SENSORS.items()),
    _pulled,
    _disk,
    _trace,
)
