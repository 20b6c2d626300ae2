"""One motor: where it is, which state of its ramp it is in, which column of its phase table is out.

Rule: ``interrupt`` is called once a tick while the axis counts; it waits the interval of its state, puts the next
column out, and after each whole step asks the ramp for the next state (paper, section 4; machine/ramp.py).
What comes to rest is marked ``cooling``, and loses its forcing bits in the next tick (docs/SPEC.md, 1.5).
Called by tick, commands, homing, guard and stops. Positions are steps; nothing here knows of sensors.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from drillctl.machine import AxisTable
from drillctl.machine.hazards import opposite_halves
from drillctl.ports import with_bits

if TYPE_CHECKING:
    from drillctl.execution.line import Line


class Axis:
    """The running state of one axis. Created once; every field is an integer, a flag or a table."""

    __slots__ = (
        "base", "bits", "braked", "clear_mask", "column", "column_in_step", "columns_per_step", "cooling",
        "count", "counting", "direction", "direction_sign", "drive", "drive_patterns", "feed_hold", "follower",
        "forcing", "halves", "high", "hold_bits", "hold_patterns", "interval", "least", "length", "limits",
        "line", "low", "made", "min_interval", "most", "position", "ramp", "reach", "seek_mask", "span",
        "state", "stopping", "target", "travelled", "up", "wait", "wires",
    )  # fmt: skip

    def __init__(self, table: AxisTable, limits: tuple[int, int, int], reach: tuple[int, int] | None = None):
        self.ramp = table.ramp
        self.interval = table.ramp.interval
        self.columns_per_step = table.columns_per_step
        self.length = table.phase.columns
        self.direction_sign = -1 if table.invert else 1
        self.low, self.high, self.span = table.low_steps, table.high_steps, table.span_steps
        self.limits = limits  # input bits of the end sensors: index 1 for +, -1 for - (0 unused)
        self.reach = reach or (self.low, self.high)  # where it can be sent: its range short of its limit sensors
        self.up = max(0, self.reach[0])  # where a head that is fed by a distance waits between holes
        self.wires = sum(1 << bit for bit in table.wire_bits)
        self.forcing, self.halves = _forcing(table), _halves(table)
        self.drive_patterns = _patterns(table, forcing=True)
        self.hold_patterns = _patterns(table, forcing=False)
        self.column = self.length - 1  # so that the first step forward puts the first column out
        self.position = self.target = self.base = self.made = self.travelled = 0
        self.least = self.most = 0  # between these it has turned round since its phases were off, or its zero was taken
        self.state = self.count = self.column_in_step = self.min_interval = 0
        self.direction = 1
        self.wait = self.interval[0]
        self.drive = table.motor.pulse is not None
        self.counting = self.cooling = self.braked = self.feed_hold = self.stopping = self.follower = False
        self.seek_mask = self.clear_mask = 0
        self.bits = self.hold_bits = 0  # the column that is out, and the same without its forcing bits
        self.line: Line | None = None

    def set_target(self, target: int, min_interval: int) -> None:
        """A new target, with the slowest allowed interval. In state 0 the count restarts; in motion it goes on."""
        self.target = target
        self.min_interval = min_interval
        self.braked = False
        if self.state == 0 and self.column_in_step == 0:
            self.start()

    def start(self) -> None:
        """From state 0: counts towards the target, or stays where it is."""
        self.counting = self.target != self.position
        if self.counting:
            self.set_direction(1 if self.target > self.position else -1)
            self.count = 0
            self.wait = max(self.interval[0], self.min_interval)

    def set_direction(self, direction: int) -> None:
        """The direction of the steps to come. A drive's direction wire must stand before its first pulse."""
        self.was_at(self.position, self.position)
        self.direction = direction
        if self.drive:
            self.bits = self.hold_bits = self.hold_patterns[direction * self.direction_sign][self.column]

    def interrupt(self) -> bool:
        """One tick of an axis that counts. True while it still counts afterwards."""
        self.count += 1
        if self.count >= self.wait:
            self.count = 0
            self._advance()
        return self.counting

    def hold(self) -> None:
        """Brake down the ramp, keeping the target. An axis led along a line stops as its leader does."""
        if not self.follower:
            self.feed_hold = True
            self._rest_if_still()

    def resume(self) -> None:
        """Lift a hold: accelerate again, or count anew from state 0."""
        self.feed_hold = False
        self.braked = False
        if self.state == 0 and self.column_in_step == 0 and not self.counting and not self.follower:
            self.start()

    def start_again(self) -> None:
        """The rotor stopped while nobody drove it: forcing goes off, and the count starts anew from state 0."""
        self.state = self.count = 0
        self.braked = False
        self.cool()
        if self.column_in_step:
            self.wait = max(self.interval[0], self.min_interval)
        elif self.feed_hold or self.stopping:
            self._rest()
        elif self.counting:
            self.start()

    def ramp_down(self) -> None:
        """Brake down the ramp; where the axis comes to rest is its target. One that is led stops as its leader."""
        if not self.follower:
            self.stopping = True
            self._rest_if_still()

    def stop_now(self) -> None:
        """Stop in this tick, without a ramp, keeping the current: from states 0 and 1 nothing is lost."""
        while self.drive and self.column_in_step:  # its pulse is out already: the step is made
            self.put_column()
        self.state = self.count = self.column_in_step = 0
        self.stopping = True
        self._rest()
        self.feed_hold = False

    def release(self) -> None:
        """Stop and take the current off all phases; from now on it can be pushed by hand, as far as it likes."""
        self.stop_now()
        self.bits = self.hold_bits = 0
        self.least = self.most = self.position

    def set_wire(self, bits: int, on: int) -> None:
        """A wire by hand, at rest, or several: they stay so until the next column is put out."""
        self.bits, self.hold_bits = with_bits(self.bits, bits, on), with_bits(self.hold_bits, bits, on)

    def zero(self) -> None:
        """This place is machine zero."""
        self.position = self.target = self.base = self.least = self.most = 0

    def was_at(self, least: int, most: int) -> None:
        """It has turned round between these places, both included."""
        self.least, self.most = min(self.least, least), max(self.most, most)

    def been(self) -> tuple[int, int]:
        """The least and the greatest place that it was at since its phases were off."""
        return min(self.least, self.position), max(self.most, self.position)

    def in_reach(self, target: int) -> bool:
        """Of a known place: whether it can be sent there. From beyond its reach it can be sent back towards it."""
        low, high = self.reach
        return min(low, self.position) <= target <= max(high, self.position)

    def within_travel(self, target: int) -> bool:
        """Of an unknown place: whether its travel may hold all places that it was at, and the target too."""
        least, most = self.been()
        return least <= target <= most or max(most, target) - min(least, target) <= self.span

    def cool(self) -> None:
        """At rest: the column's 5 V bits stay, forcing goes off; 24 V held would burn the winding."""
        self.bits = self.hold_bits
        self.cooling = False

    def put_column(self) -> bool:
        """Puts the next column out; True when that completes a step."""
        turn = self.direction * self.direction_sign
        self.column = (self.column + turn) % self.length
        self.bits = self.drive_patterns[turn][self.column]
        self.hold_bits = self.hold_patterns[turn][self.column]
        self.travelled += self.direction
        self.column_in_step += 1
        if self.column_in_step < self.columns_per_step:
            return False
        self.column_in_step = 0
        self.position += self.direction
        self.made += 1
        return True

    def _advance(self) -> None:
        if self.line is not None:
            self.line.carry()
        if self.put_column():
            self._settle()

    def _settle(self) -> None:
        """After a whole step: the next state. A hold or a stop takes one state off after every step."""
        state, direction = self.state, self.direction
        to_go = (self.target - self.position) * direction
        if self.feed_hold or self.stopping:
            after = state - direction if state else 0
        else:
            may_rise = not self.braked and self.interval[state] > self.min_interval
            after = self.ramp.after_step(state, direction, to_go, may_rise)
        self.state = after
        if after == 0:
            self._at_state_zero(to_go)
        else:
            self.braked = self.braked or after * direction < state * direction
            self.wait = max(self.interval[after], self.min_interval)

    def _at_state_zero(self, to_go: int) -> None:
        self.braked = False
        if to_go == 0 or self.feed_hold or self.stopping:
            self._rest()
        else:
            self.start()

    def _rest_if_still(self) -> None:
        if self.state == 0 and self.column_in_step == 0:
            self._rest()

    def _rest(self) -> None:
        self.counting = False
        self.cooling = True
        if self.stopping:
            self.target = self.position
            self.stopping = False
        if self.line is not None:
            self.line.rest()


def _forcing(table: AxisTable) -> int:
    """The bits of the forcing wires."""
    return sum(1 << bit for wire, bit in zip(table.phase.wires, table.wire_bits, strict=True) if wire.forcing)


def _halves(table: AxisTable) -> tuple[int, ...]:
    """The bits of both halves of a winding, for each winding that has two."""
    bits = dict(zip(table.phase.wire_names(), table.wire_bits, strict=True))
    return tuple(1 << bits[one] | 1 << bits[other] for one, other in opposite_halves(table.motor))


def _patterns(table: AxisTable, forcing: bool) -> tuple[tuple[int, ...], ...]:
    """Port images of all columns: index 1 for forward, -1 for backward (0 unused); one tuple where they agree."""
    wires = [(w, bit) for w, bit in zip(table.phase.wires, table.wire_bits, strict=True) if forcing or not w.forcing]
    columns = range(table.phase.columns)
    forward = tuple(sum(1 << bit for wire, bit in wires if wire.forward[column]) for column in columns)
    backward = tuple(sum(1 << bit for wire, bit in wires if wire.backward[column]) for column in columns)
    return ((), forward, forward if backward == forward else backward)
