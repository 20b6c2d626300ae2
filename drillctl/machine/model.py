"""A machine as every other room sees it: checked, complete, immutable; integers and tuples.

Rule: nothing is read or checked here; config.py builds these. Positions, ranges and edges are steps from machine zero;
``columns`` are columns of the axis's phase table.
"""

import hashlib
import os
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path

from drillctl.machine.dynamics import Dynamics
from drillctl.machine.levels import OutputLevels, Word, masks_at
from drillctl.machine.motor import Motor
from drillctl.machine.parameters import Parameters
from drillctl.machine.phase import PhaseTable
from drillctl.machine.ramp import RampTable
from drillctl.machine.spindle import Spindle
from drillctl.machine.tool_change import ToolChanger
from drillctl.ports import CARD_BITS

MM_PER_INCH = 25.4


@dataclass(frozen=True, slots=True)
class AxisTable:
    """One axis: its tables, its scale, its work range (both ends included), and where a simulation finds it."""

    name: str
    phase: PhaseTable
    ramp: RampTable
    motor: Motor
    columns_per_step: int
    columns_per_inch: int
    low_steps: int
    high_steps: int
    start_steps: int
    invert: bool
    wire_bits: tuple[int, ...]
    backlash_steps: int = 0
    dynamics: Dynamics | None = field(default=None, repr=False)  # the plant's alone: not in the digest
    pulses_per_mm: Fraction | None = field(default=None, repr=False)  # exact, where it follows from parameters

    @property
    def steps_per_mm(self) -> float:
        """Steps of the ramp to a millimetre of travel."""
        if self.pulses_per_mm is not None:
            return float(self.pulses_per_mm)
        return self.columns_per_inch / self.columns_per_step / MM_PER_INCH

    @property
    def span_steps(self) -> int:
        """The length of the work range."""
        return self.high_steps - self.low_steps


@dataclass(frozen=True, slots=True)
class Sensor:
    """A switch at one end of an axis: on at its edge, off again ``hysteresis_steps`` back."""

    name: str
    bit: int
    active_level: int
    axis: int
    end: str  # "min" or "max"
    edge_steps: int
    hysteresis_steps: int
    line: str = field(default="", repr=False)  # the input whose bit it shares with other sensors; "" for its own bit


@dataclass(frozen=True, slots=True)
class Input:
    """An input that belongs to no end of an axis; ``action`` is what it asks for as long as it is on."""

    name: str
    bit: int
    active_level: int
    action: str  # "none", "pause", "stop", "estop"


@dataclass(frozen=True, slots=True)
class EncoderIndex:
    """The index (Z pulse) of an axis's encoder: an input that is on for ``width_steps``, once in every ``turn_steps``.
    At ``at_steps`` lies the middle of one pulse.
    """

    name: str
    bit: int
    active_level: int
    axis: int
    turn_steps: int
    width_steps: int
    at_steps: int


@dataclass(frozen=True, slots=True)
class FaultReaction:
    """What a machine does on a fault, by the fault's name, in place of what every machine does."""

    fault: str
    do: str  # "brake", "hold", "drop", "return"
    position_kept: bool


@dataclass(frozen=True, slots=True)
class HomingStep:
    """One row of the homing table: what to do, with which axes (indexes), at which end, within how many steps, with
    how many ticks at least between two steps (0: as fast as such a row goes).
    """

    do: str  # one of machine/shape.py: HomingRow
    axes: tuple[int, ...]
    end: str
    limit_steps: int
    interval: int = field(default=0, repr=False)  # in the digest where a row has it


@dataclass(frozen=True, slots=True)
class Configuration:
    """The settings of the paper's configuration screen (Fig. 4), without scale, ranges and tick rate."""

    card: str
    card_address: int
    mode: str  # "SIMULATED" or "REAL"
    longest_drilling_s: float
    tool_change: str  # "AUTOMATIC" or "MANUAL"
    spin_up_s: float  # from spindle on to the first hole


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What the dynamic plant meets beside its motors.

    scatter_mm       standard deviation of where a sensor answers
    thrust_n         thrust that a sharp drill needs to advance in the board
    thrust_growth    by which part of that it grows with each metre of board drilled
    bears_n          thrust beyond which the bit in a chuck breaks; 0: none breaks it
    spindle_rev_min_s  by how many rev/min the spindle's speed changes in a second, at most
    """

    scatter_mm: float = 0.0
    thrust_n: float = 0.0
    thrust_growth: float = 0.0
    bears_n: float = 0.0
    spindle_rev_min_s: float = 20_000.0


@dataclass(frozen=True, slots=True)
class Machine:
    """Everything a machine's file says, with its phase, ramp and motor tables in place of their names."""

    name: str
    description: str
    tick_hz: int
    emergency_stop: str  # "drop": outputs safe at once; "hold": pulses stop, the current stays; "brake": down the ramps
    configuration: Configuration
    axes: tuple[AxisTable, ...]
    sensors: tuple[Sensor, ...]
    outputs: tuple[tuple[str, int], ...]
    homing: tuple[HomingStep, ...]
    drill_axes: tuple[int, ...]
    drill_down_steps: int | None  # None: down to the lower sensor
    board_surface: tuple[int | None, ...]  # by axis: where a drilling axis meets the board
    files: tuple[str, ...]  # that it was read from, its own first
    shipped: bool
    surroundings: Surroundings = field(default=Surroundings(), repr=False)  # the plant's: not in the digest
    inputs: tuple[Input, ...] = field(default=(), repr=False)  # these: in the digest where a machine has them
    indexes: tuple[EncoderIndex, ...] = field(default=(), repr=False)
    reactions: tuple[FaultReaction, ...] = field(default=(), repr=False)
    only_zero_after: tuple[str, ...] = field(default=(), repr=False)  # faults after which only KMD_POWROT is taken
    return_interval: int = field(default=0, repr=False)  # the least ticks between steps of KMD_POWROT
    parameters: Parameters | None = field(default=None, repr=False)  # None: the machine has none
    levels: tuple[OutputLevels, ...] = field(default=(), repr=False)  # of the outputs that have any but 0
    output_words: tuple[Word, ...] = field(default=(), repr=False)
    input_words: tuple[Word, ...] = field(default=(), repr=False)
    drill_clear_steps: int | None = field(default=None, repr=False)  # down to here a head is clear of the board
    # How fast a bit may be moved sideways in the board; None: not at all. Of programs alone, so not in the digest.
    mill_mm_min: float | None = field(default=None, repr=False)
    spindle: Spindle | None = field(default=None, repr=False)  # None: its speed is not measured
    tool_changer: ToolChanger | None = field(default=None, repr=False)

    @property
    def file(self) -> str:
        """The path of the machine's own file."""
        return self.files[0]

    @property
    def axis_names(self) -> tuple[str, ...]:
        """The axes' names in the order of the file, which is the order of bits in a command's axis mask."""
        return tuple(axis.name for axis in self.axes)

    @property
    def cards(self) -> int:
        """How many cards of 32 outputs and 32 inputs the wiring needs."""
        bits = [bit for axis in self.axes for bit in axis.wire_bits]
        bits += [bit for _, bit in self.outputs] + [line.bit for line in self.input_lines]
        bits += [word.bit for word in (*self.output_words, *self.input_words)]
        return max(bits) // CARD_BITS + 1

    @property
    def input_lines(self) -> tuple[Sensor | Input, ...]:
        """What has an input bit of its own: the sensors that share none, then the inputs."""
        return (*(sensor for sensor in self.sensors if not sensor.line), *self.inputs)

    def axis_index(self, name: str) -> int | None:
        """Returns the index of an axis by its name, or None."""
        return self.axis_names.index(name) if name in self.axis_names else None

    def sensor_at(self, axis: int, end: str) -> Sensor | None:
        """Returns the sensor at an end of an axis, or None where that end has none."""
        return next((s for s in self.sensors if s.axis == axis and s.end == end), None)

    def index_of(self, axis: int) -> EncoderIndex | None:
        """Returns the index of an axis's encoder, or None where it has none."""
        return next((index for index in self.indexes if index.axis == axis), None)

    @property
    def homes_by_sensor(self) -> bool:
        """Whether the homing table looks for zero, whatever place the machine is at."""
        return any(step.do in ("seek", "fast") for step in self.homing)

    def reach(self, axis: int) -> tuple[int, int]:
        """Returns the positions that an axis can be sent to: its range, short of where its limit sensors answer."""
        table = self.axes[axis]
        low, high = self.sensor_at(axis, "min"), self.sensor_at(axis, "max")
        lowest = table.low_steps if low is None else max(table.low_steps, low.edge_steps + low.hysteresis_steps)
        highest = table.high_steps if high is None else min(table.high_steps, high.edge_steps - 1)
        return lowest, highest

    def output_word(self, name: str) -> Word | None:
        """Returns an output word by its name, or None."""
        return next((word for word in self.output_words if word.name == name), None)

    def input_word(self, name: str) -> Word | None:
        """Returns an input word by its name, or None."""
        return next((word for word in self.input_words if word.name == name), None)

    def switched_at(self, event: int, image: int = 0) -> int:
        """Returns what the outputs beside the axes are set to at an event (machine/levels.py), from what they have in
        an image. At ESTOP that is the safe image: no axis's wire is in it.
        """
        kept, on = masks_at(self.levels, event)
        return image & kept | on

    @property
    def longest_drilling_ticks(self) -> int:
        """The configured drilling time in ticks."""
        return self.drilling_ticks_at(self.tick_hz)

    def drilling_ticks_at(self, tick_hz: int) -> int:
        """Returns the configured drilling time in ticks, at an interrupt frequency."""
        return round(self.configuration.longest_drilling_s * tick_hz)

    def at_rate(self, tick_hz: int) -> "Machine":
        """Returns the same machine at another interrupt frequency."""
        return replace(self, tick_hz=tick_hz)

    def reference_from(self, folder: Path) -> str:
        """Returns what a trace in ``folder`` calls this machine: a shipped one by name, else its file's path from
        there.
        """
        if self.shipped:
            return self.name
        return Path(os.path.relpath(os.path.realpath(self.file), os.path.realpath(folder))).as_posix()

    @property
    def digest(self) -> str:
        """16 hex digits over everything that decides a run. Tick rate and file names are left out."""
        decisive = replace(self, files=(), shipped=False, description="", tick_hz=0)
        return hashlib.sha256((repr(decisive) + self._unusual()).encode()).hexdigest()[:16]

    def _unusual(self) -> str:
        """What decides a run and came later than the first digests, where it is not as it was before."""
        strokes = (f"{axis.name}: whole strokes\n" for axis in self.axes if axis.ramp.whole_strokes)
        slow = tuple((number, step.interval) for number, step in enumerate(self.homing) if step.interval)
        clear = () if self.drill_clear_steps is None else ("clear", self.drill_clear_steps)
        set_by_file = (self.only_zero_after, self.return_interval, self.parameters, slow, clear, self.tool_changer)
        later = (*self.inputs, *self.reactions, *self.indexes, *set_by_file)
        outputs = (*self.levels, *self.output_words, *self.input_words, self.spindle)
        return "".join((*strokes, *(f"{value!r}\n" for value in (*later, *outputs) if value)))
