"""The bits in their boards: how each resists its head, wears and breaks. And sensors and belts with faults.

Rule: thrust = F0 (1 + k wear), whatever the feed, while the bit is at the bottom of its hole; none in a hole that was
drilled already, and none on the way up. Where the machine's file says how much a bit bears, more breaks it.
"""

import math
from collections.abc import Mapping, Sequence
from random import Random
from typing import Any

from drillctl.machine import AxisTable, Machine, Sensor
from drillctl.machine.head_lines import CHUCK, head_output
from drillctl.machine.model import MM_PER_INCH
from drillctl.plant.carriage import Carriage, Pulses, Switch
from drillctl.plant.chucks import Chuck, Chucks
from drillctl.plant.dynamic import law
from drillctl.plant.dynamic.kernel import Kernel
from drillctl.plant.effects import Board
from drillctl.plant.faults import Faults

SAME_HOLE_MM = 0.1  # within this distance the bit is in the same hole again


class Bits:
    """The bits of all heads, as law.py computes with them.

    columns  what law.py reads and changes: what a run says of its last tick, then a row for each head
    """

    def __init__(self, machine: Machine, boards: Mapping[int, Board], known_faults: Faults, kernel: Kernel):
        axes, heads = len(machine.axes), machine.drill_axes
        width = law.HOLE + axes
        self.columns = kernel.numbers([0.0] * (law.FIRST + width * len(heads)))
        self.of = tuple(
            Bit(self.columns, law.FIRST + width * number, machine, head, boards.get(head), known_faults)
            for number, head in enumerate(heads)
        )

    def break_off(self, chucks: Chucks) -> None:
        """Tells the chucks which bits have broken in the last stretch."""
        for bit in self.of:
            bit.break_off(chucks.of(bit.axis))

    def follow(self, chucks: Chucks) -> None:
        """Takes over what has happened to the bits in their chucks, and which are in their boards."""
        for bit in self.of:
            bit.follow(chucks.of(bit.axis))


class Bit:
    """The bit of one head, by its ``axis``; in a row of Bits, which begins at ``at``."""

    def __init__(
        self, columns: Any, at: int, machine: Machine, axis: int, board: Board | None, known_faults: Faults
    ):  # fmt: skip
        head, around = machine.axes[axis], machine.surroundings
        assert head.dynamics is not None
        columns_per_turn = head.motor.columns_per_cycle * head.dynamics.cycles_per_turn
        lead_m = 0.001 * MM_PER_INCH * columns_per_turn / head.columns_per_inch
        self.axis, self._columns, self._at, self._board = axis, columns, at, board
        self._taken = 0
        surface = 0 if board is None else board.surface
        worn_m = known_faults.of("worn", head.name)
        if worn_m is None:
            worn_m = known_faults.of("blunt") or 0.0
        set_at = {
            law.MOUNTED: board is not None, law.HEAD: axis, law.INVERTED: head.invert, law.SURFACE: surface,
            law.BOTTOM: surface, law.WEAR: worn_m, law.METRES: 0.001 / head.steps_per_mm,
            law.THRUST: around.thrust_n, law.GROWTH: around.thrust_growth,
            law.LEVER: lead_m / (2 * math.pi), law.SAME: SAME_HOLE_MM,
            law.BEARS: around.bears_n if head_output(machine, CHUCK, axis) else 0.0,
        }  # fmt: skip
        for column, value in set_at.items():
            columns[at + column] = float(value)

    @property
    def mounted(self) -> bool:
        """Whether a drill is in the spindle."""
        return self._columns[self._at + law.MOUNTED] != 0.0

    @property
    def wear_m(self) -> float:
        """Metres of board that it has cut."""
        return self._columns[self._at + law.WEAR]

    def break_off(self, chuck: Chuck | None) -> None:
        """Tells its chuck where it has broken in the last stretch."""
        if chuck is not None and self._columns[self._at + law.BROKEN] != 0.0:
            chuck.break_off()
        self._columns[self._at + law.BROKEN] = 0.0

    def follow(self, chuck: Chuck | None) -> None:
        """Takes over what has happened in its chuck, where a bit that was taken is a sharp one; and whether it is in
        its board.
        """
        columns, at = self._columns, self._at
        columns[at + law.IN_BOARD] = float(self._board is not None and self._board.state)
        if chuck is None:
            return
        if chuck.taken != self._taken:
            self._taken = chuck.taken
            columns[at + law.WEAR] = columns[at + law.BEGUN] = 0.0
        columns[at + law.SHORT] = chuck.short_steps


class FaultySwitch(Switch):
    """A sensor whose edge scatters, and which may be stuck, dirty or bouncing."""

    def __init__(self, sensor: Sensor, steps_per_mm: float, scatter_mm: float, faults: Faults, seed: int):
        super().__init__(sensor)
        self._stuck = faults.of("stuck", sensor.name)
        self._flutter_ticks = int(faults.of("bouncing", sensor.name) or 0)
        self._fluttering = 0
        self._middle = self._edge + (faults.of("dirty", sensor.name) or 0.0) * steps_per_mm
        self._scatter = scatter_mm * steps_per_mm
        self._random = Random(f"{seed} {sensor.name}")
        self._draw_edge()

    def changes_at(self) -> tuple[float, float]:
        """Like the method of Switch; a sensor that is stuck never changes."""
        return super().changes_at() if self._stuck is None else (-math.inf, math.inf)

    @property
    def flutters(self) -> bool:
        """Whether its wire may change although nothing moves."""
        return self._fluttering > 0

    def _answers(self, outward: float) -> bool:
        if self._stuck is not None:
            return bool(self._stuck)
        if self._fluttering:
            self._fluttering -= 1
        before = self.reached
        after = super()._answers(outward)
        if after != before:
            self._fluttering = self._flutter_ticks
            if not after:
                self._draw_edge()
        return after ^ bool(self._fluttering % 2)

    def _draw_edge(self) -> None:
        """Draws where the sensor will answer next. Rounded, so that all mathematical libraries give the same."""
        self._edge = self._middle + round(self._random.gauss(0.0, 1.0), 6) * self._scatter


class LooseCarriage(Carriage):
    """A carriage on a belt with play: law.py moves it once the play is used up, else it stays where it was left."""

    def __init__(self, table: AxisTable, sensors: Sequence[FaultySwitch], play_mm: float, pulses: Pulses | None = None):
        super().__init__(table, sensors, pulses)
        self.switches = sensors
        self.half_play = play_mm * table.steps_per_mm / 2

    @property
    def flutters(self) -> bool:
        """Whether a wire of its sensors may change although nothing moves."""
        return any(switch.flutters for switch in self.switches)

    def lie_in(self, rows: Any, at: int, steps_per_mm: float) -> None:
        """Writes itself into a row of law.py."""
        rows[at + law.START] = rows[at + law.PLACE] = float(self.start)
        rows[at + law.PITCH], rows[at + law.PLAY] = self.steps_per_column, self.half_play
        rows[at + law.SCALE] = float(steps_per_mm)
