"""One motor: where it is, which state of its ramp it is in, which column of its phase table is out.

An axis that counts waits the interval of its state, puts the next column out, and after each whole step asks the ramp
for the next state (paper, section 4; machine/ramp.py). What it is about is one value, ``motion`` (motion.py).
Positions are steps. An axis knows nothing of sensors.
"""

from typing import Protocol

from drillctl.execution.axis_wires import column_images, forcing_bits, winding_halves
from drillctl.execution.motion import BRAKING, COOLED, FOLLOWING, FOLLOWS, HOLDING, MOVING, REST, SETTLING, STOPPING
from drillctl.machine import AxisTable, RampTable
from drillctl.machine.landing import Strokes, strokes_of
from drillctl.ports import with_bits


class Followers(Protocol):
    """The axes that step along with one that leads."""

    def carry(self) -> None:
        """Puts out the followers' columns; called before each column of the leader."""

    def rest(self) -> None:
        """Lets the followers rest; called when the leader has come to rest."""


class Axis:
    """The running state of one axis. Created once; every field is an integer or a table, but ``followers``."""

    __slots__ = (
        "base", "bits", "clear_mask", "column", "column_in_step", "columns_per_step", "count", "direction",
        "direction_sign", "drive", "drive_patterns", "followers", "forcing", "halt_mask", "halves", "high", "hold_bits",
        "hold_patterns", "interval", "least", "length", "limits", "low", "made", "met", "min_interval", "most",
        "motion", "position", "ramp", "ramped_from", "reach", "seek_mask", "span", "state", "strokes", "target",
        "top", "travelled", "up", "wait", "wires",
    )  # fmt: skip

    def __init__(self, table: AxisTable, limits: tuple[int, int, int], reach: tuple[int, int] | None = None):
        self.ramp = table.ramp
        self.interval = table.ramp.interval
        self.strokes = strokes_of(table.ramp)
        self.ramped_from = 0  # steps to go in state 0 from which the state rises
        self.columns_per_step = table.columns_per_step
        self.length = table.phase.columns
        self.direction_sign = -1 if table.invert else 1
        self.low, self.high, self.span = table.low_steps, table.high_steps, table.span_steps
        self.limits = limits  # input bits of the end sensors: index 1 for +, -1 for - (0 unused)
        self.reach = reach or (self.low, self.high)  # where it can be sent: its range short of its limit sensors
        self.top = max(0, self.reach[0])  # the return to zero ends here
        self.up = self.top  # a head fed by a distance waits here; KMD_SUW changes it
        self.wires = sum(1 << bit for bit in table.wire_bits)
        self.forcing, self.halves = forcing_bits(table), winding_halves(table)
        self.drive_patterns = column_images(table, forcing=True)
        self.hold_patterns = column_images(table, forcing=False)
        self.column = self.length - 1  # so that the first step forward puts the first column out
        self.position = self.target = self.base = self.made = self.travelled = 0
        self.least = self.most = 0  # between these it has turned round since its phases were off, or its zero was taken
        self.state = self.count = self.column_in_step = self.min_interval = 0
        self.direction = 1
        self.wait = self.interval[0]
        self.drive = table.motor.pulse is not None
        self.motion = REST
        self.seek_mask = self.clear_mask = self.halt_mask = 0  # the sensor whose edge brakes; whose going, coming halts
        self.met = 0  # the direction in which it was moving when a limit line that it shares with others came on
        self.bits = self.hold_bits = 0  # the column that is out, and the same without its forcing bits
        self.followers: Followers | None = None

    @property
    def counting(self) -> bool:
        """Whether it counts ticks towards its next column."""
        return self.motion >= MOVING

    @property
    def follows(self) -> bool:
        """Whether another axis leads it along a line."""
        return self.motion in FOLLOWS

    def set_target(self, target: int, min_interval: int) -> None:
        """A new target, with the shortest interval allowed. In state 0 the count restarts; in motion it goes on."""
        self.target = target
        self.min_interval = min_interval
        self.ramped_from = self.strokes.ramped_from(self.direction, min_interval)
        if self.motion == BRAKING:
            self.motion = MOVING
        if self.state == 0 and self.column_in_step == 0:
            self.start()

    def start(self) -> None:
        """From state 0: counts towards the target; where it stands there already, it moves no more."""
        if self.target == self.position:
            if self.motion >= MOVING:
                self.motion = SETTLING
            return
        if self.motion <= SETTLING:
            self.cool()
        self.set_direction(1 if self.target > self.position else -1)
        self.motion = MOVING
        self.count = 0
        self.wait = max(self.interval[0], self.min_interval)
        self.ramped_from = self.strokes.ramped_from(self.direction, self.min_interval)

    def ramp_tables(self) -> tuple[RampTable, tuple[int, ...], Strokes]:
        """Its ramp, and what is known from it."""
        return self.ramp, self.interval, self.strokes

    def take_ramp(self, ramp: RampTable, interval: tuple[int, ...], strokes: Strokes) -> None:
        """Goes by another ramp from here on, at rest."""
        self.ramp, self.interval, self.strokes = ramp, interval, strokes

    def follow(self, direction: int) -> None:
        """From rest: steps in this direction whenever its leader's line says so."""
        self.cool()
        self.set_direction(direction)
        self.motion = FOLLOWING

    def set_direction(self, direction: int) -> None:
        """The direction of the steps to come. A drive's direction wire must stand before its first pulse."""
        self.was_at(self.position, self.position)
        self.direction = direction
        if self.drive:
            self.bits = self.hold_bits = self.hold_patterns[direction * self.direction_sign][self.column]

    def interrupt(self) -> bool:
        """One tick of an axis that counts. True while it still counts afterwards."""
        self.count += 1
        if self.count < self.wait:
            return True
        self.count = 0
        self.advance()
        return self.motion >= MOVING

    def hold(self) -> None:
        """Brakes down the ramp and keeps the target. A follower stops as its leader does."""
        if MOVING <= self.motion < STOPPING:
            self.motion = HOLDING
            self._rest_if_still()

    def resume(self) -> None:
        """Goes on after a hold: may accelerate again, or counts anew from state 0."""
        if self.motion == HOLDING:
            self.motion = MOVING
        elif self.motion <= SETTLING:
            self.start()

    def start_again(self) -> None:
        """The rotor stopped while no ticks came: forcing goes off, and the count starts anew from state 0."""
        self.state = self.count = 0
        self.cool()
        if self.motion == BRAKING:
            self.motion = MOVING
        if self.column_in_step:
            self.wait = max(self.interval[0], self.min_interval)
        elif self.motion >= HOLDING:
            self._rest()
        elif self.motion == MOVING:
            self.start()

    def ramp_down(self) -> None:
        """Brakes down the ramp; where it comes to rest is its target. A follower stops as its leader does."""
        if not self.follows:
            self.motion = STOPPING
            self._rest_if_still()

    def stop_now(self) -> None:
        """Stops in this tick, without a ramp, and keeps the current: from states 0 and 1 no step is lost."""
        while self.drive and self.column_in_step:  # its pulse is out already: the step is made
            self.put_column()
        self.state = self.count = self.column_in_step = 0
        self.motion = STOPPING
        self._rest()

    def release(self) -> None:
        """Stops and takes the current off all phases; from now on it can be pushed by hand, as far as it likes."""
        self.stop_now()
        self.bits = self.hold_bits = 0
        self.least = self.most = self.position

    def set_wire(self, bits: int, on: int) -> None:
        """Sets one or several wires by hand, at rest: they stay so until the next column is put out."""
        self.bits, self.hold_bits = with_bits(self.bits, bits, on), with_bits(self.hold_bits, bits, on)

    def zero(self) -> None:
        """This place is machine zero."""
        self.position = self.target = self.base = self.least = self.most = 0

    def was_at(self, least: int, most: int) -> None:
        """Notes that it has turned round between these places, both included."""
        self.least, self.most = min(self.least, least), max(self.most, most)

    def been(self) -> tuple[int, int]:
        """The least and the greatest place that it was at since its phases were off."""
        return min(self.least, self.position), max(self.most, self.position)

    def in_reach(self, target: int) -> bool:
        """Whether an axis whose place is known can be sent there. From beyond its reach it can be sent towards it."""
        low, high = self.reach
        return min(low, self.position) <= target <= max(high, self.position)

    def within_travel(self, target: int) -> bool:
        """Whether the travel of an axis whose place is unknown may hold all places that it was at, and the target."""
        least, most = self.been()
        return least <= target <= most or max(most, target) - min(least, target) <= self.span

    def cool(self) -> None:
        """Takes the forcing wires off, the column's 5 V bits stay: 24 V at rest would burn the winding."""
        self.bits = self.hold_bits
        self.motion = COOLED[self.motion]

    def advance(self) -> None:
        """Puts the next column out, the followers' too, and takes the next state after a whole step."""
        if self.followers is not None:
            self.followers.carry()
        if self.put_column():
            self._settle()

    def put_column(self) -> bool:
        """Puts the next column out; True when that completes a step."""
        turn = self.direction * self.direction_sign
        self.column = column = (self.column + turn) % self.length
        self.bits = self.drive_patterns[turn][column]
        self.hold_bits = self.hold_patterns[turn][column]
        self.travelled += self.direction
        self.column_in_step += 1
        if self.column_in_step < self.columns_per_step:
            return False
        self.column_in_step = 0
        self.position += self.direction
        self.made += 1
        return True

    def put_steps(self, steps: int) -> None:
        """Puts the columns of so many whole steps out, in each of which it keeps its state. It stands between steps."""
        turn, columns = self.direction * self.direction_sign, steps * self.columns_per_step
        self.column = (self.column + turn * columns) % self.length
        self.bits = self.drive_patterns[turn][self.column]
        self.hold_bits = self.hold_patterns[turn][self.column]
        self.travelled += self.direction * columns
        self.position += self.direction * steps
        self.made += steps

    def _settle(self) -> None:
        """After a whole step: the next state. A hold or a stop takes one state off after every step."""
        state, direction, motion = self.state, self.direction, self.motion
        to_go = (self.target - self.position) * direction
        if motion >= HOLDING:
            after = state - direction if state else 0
        else:
            may_rise = (
                motion == MOVING
                and self.interval[state] > self.min_interval
                and (state != 0 or to_go >= self.ramped_from)
            )
            after = self.ramp.after_step(state, direction, to_go, may_rise)
        self.state = after
        if after:
            if after != state and motion == MOVING and after * direction < state * direction:
                self.motion = BRAKING
            self.wait = max(self.interval[after], self.min_interval)
        elif to_go == 0 or motion >= HOLDING:
            self._rest()
        else:  # it has overrun its target, and turns round
            self.start()

    def _rest_if_still(self) -> None:
        if self.state == 0 and self.column_in_step == 0:
            self._rest()

    def _rest(self) -> None:
        if self.motion == STOPPING:
            self.target = self.position
        self.motion = SETTLING
        if self.followers is not None:
            self.followers.rest()
