"""Takes the machine through commands that can be foreseen, and leaves it as if it had ticked through them.

Rule: the caller takes the commands out of the queue, and lets tick do what ``foresee`` doesn't have. A stroke of the
heads that tick does for the first time is recorded.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller, Stage
from drillctl.execution.fastforward.batch import Batch
from drillctl.execution.fastforward.move_profile import MoveProfile
from drillctl.execution.fastforward.plan import foresee, is_stroke, signatures
from drillctl.execution.fastforward.strokes import Recording, Strokes
from drillctl.execution.fastforward.world import PlantFacts, turned
from drillctl.execution.motion import SETTLING
from drillctl.execution.spindle import at_speed
from drillctl.kmd import Condition, Op
from drillctl.trace.tapes import ImagePool

DTYPES = {1: np.uint32, 2: np.uint64}  # of an output image, by cards
LARGEST_POOL = 1 << 25  # words


class Engine:
    """Foresees for one controller. ``pool`` holds all that its batches put out."""

    def __init__(self, m: Controller, world: PlantFacts, pool: ImagePool | None = None):
        self._m, self._world = m, world
        self.pool = pool or ImagePool(DTYPES.get(m.machine.cards, np.uint64))
        self._strokes = Strokes(m, world)
        self._profiles: dict[tuple[int, int, int], MoveProfile] = {}

    @property
    def between(self) -> bool:
        """Whether a command would be taken in the next tick, and nothing else is going on."""
        m = self._m
        ready = m.condition == Condition.READY and not m.fault
        return ready and not (m.busy or m.moving or m.gap or m.unseen or m.hot_until or m.requests.waiting)

    def _sees(self) -> bool:
        """Whether the plant is where the controller has it, and both are of the common kind."""
        m = self._m
        sensors = (self._world.inputs ^ m.polarity) & m.sensor_mask
        return (
            m.machine.cards in DTYPES
            and not m.step_limit
            and len(self.pool.images) < LARGEST_POOL
            and all(_rests(axis) for axis in m.axes)
            and all(self._world.stands(index, *turned(axis)) for index, axis in enumerate(m.axes))
            and not any(sensors & pair == pair for pair in m.pairs)
            and not (sensors & (m.action_mask | m.shared | m.alarm_mask) or m.estops)
            and not (m.spindle is not None and m.speed_reached and not at_speed(m, sensors))
        )

    def foresee(self, commands: NDArray[np.void]) -> Batch | None:
        """The batch of as many of the commands, dtype RECORD (n,), as can be foreseen; None where the first must be
        ticked. To be called between two commands only (``between``).
        """
        if not len(commands) or not self._sees():
            return None
        return foresee(self._m, self._world, self._strokes, self._profile, commands)

    def leave(self, batch: Batch) -> None:
        """The machine and the plant after a batch."""
        for index, axis_batch in enumerate(batch.axis_batches):
            if axis_batch is not None:
                axis_batch.leave(batch.ticks)
                if axis_batch.steps.any():
                    self._world.follow(index, *turned(self._m.axes[index]))
        batch.stroked.leave(self._m, self._world, len(batch.commands) - 1, int(batch.ticks[-1]))
        self._leave_controller(batch)
        self._world.settle(self._m.image, [head for *_, head in batch.touches])

    def _leave_controller(self, batch: Batch) -> None:
        m, last = self._m, batch.commands[-1]
        m.command.load(last)
        m.running = m.done = m.command.sequence
        m.enter(Stage.IDLE if m.command.opcode == Op.KONIEC else Stage.RUNNING)
        m.elapsed = int(batch.ticks[-1])
        m.tick += batch.end
        m.late = m.served = 0
        m.inputs = batch.last_inputs()
        m.sensors = (m.inputs ^ m.polarity) & m.sensor_mask
        m.switched = int(batch.switched[-1])
        m.tool, m.hole_begun = int(batch.tools[-1]), int(batch.holes[-1])
        m.holes_done += int(((batch.commands["opcode"] == Op.WIERTLO_DOL) & (batch.commands["tag"] > 0)).sum())
        m.image = m.switched
        for axis in m.axes:
            m.image |= axis.bits

    def recording(self, command: NDArray[np.void]) -> Recording | None:
        """Returns what notes the ticks of a command, dtype RECORD (1,), if it is a stroke of the heads, alone or before
        other axes start.
        """
        if not (self._m.position_known and is_stroke(command, self._strokes.heads).all()):
            return None
        return Recording(self._m, self._world, self._strokes, signatures(command, np.uint16(self._m.head_mask))[0])

    def _profile(self, index: int, direction: int, min_interval: int) -> MoveProfile:
        key = index, direction, min_interval
        if key not in self._profiles:
            self._profiles[key] = MoveProfile(self._m.axes[index], direction, min_interval)
        return self._profiles[key]


def _rests(axis: Axis) -> bool:
    """Nothing is left of a move, a line or a stop; and a drive's direction wire is a wire as any other at rest."""
    alike = not axis.drive or axis.drive_patterns == axis.hold_patterns
    return alike and axis.motion <= SETTLING and axis.followers is None and not axis.met
