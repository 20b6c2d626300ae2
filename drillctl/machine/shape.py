"""Which keys may stand in a machine's file: types, bounds, defaults. An unknown key is an error.

Rule: shapes only; config.py checks what the values mean to each other.
"""

from typing import Annotated, Any, Literal

import msgspec

from drillctl.machine.drive_ramp import FROM_PARAMETERS
from drillctl.machine.phase import Name
from drillctl.ports import CARD_BITS

MOST_CARDS = 4
SLOWEST_TICK_HZ, FASTEST_TICK_HZ = 1, 100_000
LAST_BIT = MOST_CARDS * CARD_BITS - 1
Bit = Annotated[int, msgspec.Meta(ge=0, le=LAST_BIT)]
Steps = Annotated[int, msgspec.Meta(ge=-100_000_000, le=100_000_000)]
Positive = Annotated[int, msgspec.Meta(ge=1, le=1_000_000)]
TickHz = Annotated[int, msgspec.Meta(ge=SLOWEST_TICK_HZ, le=FASTEST_TICK_HZ)]
End = Literal["min", "max"]
Level = Literal[0, 1]
LevelAt = Literal["keep", 0, 1]
WordBits = tuple[Bit, Annotated[int, msgspec.Meta(ge=2, le=CARD_BITS)]]


class Strict(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """A table in which no other keys are allowed."""


class AxisRow(Strict, frozen=True):
    """``[[axis]]``: positions in steps from machine zero."""

    name: Name
    phase: str
    columns_per_step: Positive
    columns_per_inch: Positive
    range: tuple[Steps, Steps]
    ramp: str = FROM_PARAMETERS
    start: Steps = 0
    invert: bool = False
    motor: str | None = None
    dynamics: str | None = None
    backlash: Annotated[int, msgspec.Meta(ge=0, le=100_000)] = 0


class SensorRow(Strict, frozen=True):
    """``[[sensor]]``: a switch at one end of an axis, on an input bit of its own or on a ``line`` with others."""

    name: Name
    axis: str
    end: End
    edge: Steps
    hysteresis: Annotated[int, msgspec.Meta(ge=0, le=10_000)] = 0
    active: Level | None = None
    bit: Bit | None = None
    line: str | None = None


class InputRow(Strict, frozen=True):
    """``[[input]]``: an input that belongs to no end of an axis, and what it asks for as long as it is on; or a number
    on neighbouring bits (``word``: the first, how many).
    """

    name: Name
    bit: Bit | None = None
    active: Level = 1
    action: Literal["none", "pause", "stop", "estop"] = "none"
    word: WordBits | None = None


class OutputRow(Strict, frozen=True):
    """``[[output]]``: an output beside the axes with its level at each kind of stop; one bit, or a ``word``."""

    name: Name
    bit: Bit | None = None
    word: WordBits | None = None
    power_on: Level = 0
    stop: LevelAt = 0
    fault: LevelAt = 0
    estop: LevelAt = 0


class IndexRow(Strict, frozen=True):
    """``[[index]]``: the index (Z pulse) of an axis's encoder: on for ``width`` steps around ``at``, once a turn."""

    name: Name
    axis: str
    bit: Bit
    turn: Annotated[int, msgspec.Meta(ge=2, le=1_000_000)]
    active: Level = 1
    width: Positive = 1
    at: Steps = 0


class ReactionRow(Strict, frozen=True):
    """``[[reaction]]``: what the machine does on a fault, in place of what docs/FAULTS.md says."""

    fault: str
    do: Literal["brake", "hold", "drop", "return"]
    position: Literal["kept", "lost"]


class HomingRow(Strict, frozen=True):
    """``[[homing]]``: one row of initialisation."""

    do: Literal["raise", "release", "seek", "creep", "zero", "fast", "slow", "back", "index", "offset"]
    axes: Annotated[list[str], msgspec.Meta(min_length=1)]
    end: End = "min"
    limit: Positive = 60
    interval: Annotated[int, msgspec.Meta(ge=0, le=1_000_000)] = 0


class ToolChangerPart(Strict, frozen=True):
    """``[tool_changer]``: how the spindles meet the magazine."""

    order: Literal["together", "in turn"] = "together"
    spindle_pitch_mm: Annotated[float, msgspec.Meta(gt=0, le=1000)] = 100
    magazine_pitch_mm: Annotated[float, msgspec.Meta(gt=0, le=1000)] = 100


class ToolChangeRow(Strict, frozen=True):
    """``[[tool_change]]``: one step of an automatic tool change."""

    do: Literal["home", "foot", "x", "y", "xy", "height", "chuck", "delay", "left", "taken"]
    limit_s: Annotated[float, msgspec.Meta(gt=0, le=3600)]
    fault: Literal[
        "CHANGE_Z_NOT_HOME", "CHANGE_FOOT", "CHANGE_NOT_THERE", "CHANGE_HEIGHT", "CHANGE_CHUCK", "TOOL_NOT_LEFT",
        "TOOL_NOT_TAKEN",
    ]  # fmt: skip
    part: Literal["old", "new"] | None = None
    to: Literal["old", "new", "parking"] | None = None
    level: Level | None = None
    delay_s: Annotated[float, msgspec.Meta(gt=0, le=600)] | None = None
    input: Name | None = None
    reads: Level | None = None
    in_turn: bool = False


class ConfigurationPart(Strict, frozen=True):
    """``[configuration]``: the settings of the paper's configuration screen."""

    card: str = "simulated"
    card_address: Annotated[int, msgspec.Meta(ge=0, le=0xFFFF)] = 0x2A0
    mode: Literal["SIMULATED", "REAL"] = "SIMULATED"
    longest_drilling_s: Annotated[float, msgspec.Meta(gt=0, le=3600)] = 18
    tool_change: Literal["AUTOMATIC", "MANUAL"] = "MANUAL"
    spin_up_s: Annotated[float, msgspec.Meta(ge=0, le=600)] = 0


class DrillPart(Strict, frozen=True):
    """``[drill]``: which axes drill, how deep where no sensor says, down to where they are clear of the board, and how
    fast a bit may be moved sideways in it.
    """

    axes: Annotated[list[str], msgspec.Meta(min_length=1)]
    down: Steps | None = None
    clear: Steps | None = None
    mill_mm_min: Annotated[float, msgspec.Meta(ge=1, le=10_000)] | None = None


class SpindlePart(Strict, frozen=True):
    """``[spindle]``: when a spindle whose speed is measured is at its speed (machine/spindle.py)."""

    tolerance_percent: Annotated[float, msgspec.Meta(gt=0, le=50)] = 3
    standstill_rev_min: Annotated[int, msgspec.Meta(ge=0, le=10_000)] = 60
    reached_s: Annotated[float, msgspec.Meta(gt=0, le=600)] = 5
    dip_s: Annotated[float, msgspec.Meta(ge=0, le=600)] = 0.5
    rev_min_per_hz: Annotated[float, msgspec.Meta(gt=0, le=60)] = 60


class PlantPart(Strict, frozen=True):
    """``[plant]``: what a simulation must know beyond the ports."""

    board_surface: dict[str, Any] = {}  # of Steps
    scatter_mm: Annotated[float, msgspec.Meta(ge=0, le=1)] = 0
    thrust_n: Annotated[float, msgspec.Meta(ge=0, le=10_000)] = 0
    thrust_growth: Annotated[float, msgspec.Meta(ge=0, le=1000)] = 0
    bears_n: Annotated[float, msgspec.Meta(ge=0, le=10_000)] = 0
    spindle_rev_min_s: Annotated[float, msgspec.Meta(gt=0, le=10_000_000)] = 20_000


class MachineFile(Strict, frozen=True):
    """The whole file. Tables of free keys are checked value by value (Source.numbers), so that a fault has a line."""

    name: Name
    tick_hz: TickHz
    axis: Annotated[list[AxisRow], msgspec.Meta(min_length=1, max_length=10)]  # kmd.commands.MOST_AXES
    wiring: dict[str, Any]  # of Bit
    description: str = ""
    emergency_stop: Literal["drop", "hold", "brake"] = "drop"
    only_zero_after: list[str] = []  # names of faults
    return_interval: Annotated[int, msgspec.Meta(ge=0, le=1_000_000)] = 0
    locked: list[str] = []  # names of settings that the configuration screen may not change
    configuration: ConfigurationPart = ConfigurationPart()
    sensor: list[SensorRow] = []
    input: list[InputRow] = []
    index: list[IndexRow] = []
    reaction: list[ReactionRow] = []
    outputs: dict[str, Any] = {}  # of Bit
    output: list[OutputRow] = []
    homing: list[HomingRow] = []
    drill: DrillPart | None = None
    tool_changer: ToolChangerPart | None = None
    tool_change: Annotated[list[ToolChangeRow], msgspec.Meta(max_length=100)] = []
    plant: PlantPart = PlantPart()
    spindle: SpindlePart | None = None
    parameters: dict[str, Any] | None = None  # checked by parameter_file.py
