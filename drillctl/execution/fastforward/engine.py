"""Takes the machine through commands that can be foreseen, and leaves it as if it had ticked through them.

Rule: the caller takes the commands out of the queue, and lets tick do what ``course`` doesn't. A stroke of the heads
that tick does for the first time is recorded.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.fastforward.batch import Batch
from drillctl.execution.fastforward.move_profile import MoveProfile
from drillctl.execution.fastforward.plan import foresee, is_stroke, signatures
from drillctl.execution.fastforward.strokes import Recording, Strokes
from drillctl.execution.fastforward.world import PlantFacts
from drillctl.kmd import Condition, Op
from drillctl.trace.tapes import ImagePool

DTYPES = {1: np.uint32, 2: np.uint64}  # of an output image, by cards
LARGEST_REEL = 1 << 25  # words


class Engine:
    """Foresees for one controller. ``reel`` holds all that its courses put out."""

    def __init__(self, m: Controller, world: PlantFacts, reel: ImagePool | None = None):
        self._m, self._world = m, world
        self.reel = reel or ImagePool(DTYPES.get(m.machine.cards, np.uint64))
        self._strokes = Strokes(m, world, self.reel)
        self._strides: dict[tuple[int, int, int], MoveProfile] = {}

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
            and len(self.reel.images) < LARGEST_REEL
            and all(_rests(axis) for axis in m.axes)
            and all(self._world.stands(index, _travel(axis)) for index, axis in enumerate(m.axes))
            and not any(sensors & pair == pair for pair in m.pairs)
        )

    def course(self, commands: NDArray[np.void]) -> Batch | None:
        """As many of the commands, dtype RECORD (n,), as can be foreseen; None where tick must have the first.

        Asked ``between`` two commands only.
        """
        if not len(commands) or not self._sees():
            return None
        return foresee(self._m, self._world, self._strokes, self._stride, commands)

    def leave(self, course: Batch) -> None:
        """The machine and the plant after a course."""
        for index, journey in enumerate(course.journeys):
            if journey is not None:
                journey.leave(course.ticks)
                if journey.steps.any():
                    self._world.follow(index, _travel(self._m.axes[index]))
        course.stroked.leave(self._m, self._world, len(course.commands) - 1)
        self._leave_controller(course)
        self._world.settle(self._m.image, len(course.touches()))

    def _leave_controller(self, course: Batch) -> None:
        m, last = self._m, course.commands[-1]
        m.command.load(last)
        m.running = m.done = m.command.sequence
        m.job = m.command.opcode != Op.KONIEC
        m.elapsed = int(course.ticks[-1])
        m.tick += course.end
        m.late = m.served = 0
        m.inputs = int(course.inputs()[1][-1])
        m.sensors = (m.inputs ^ m.polarity) & m.sensor_mask
        m.switched = int(course.switched[-1])
        m.tool, m.hole_begun = int(course.tools[-1]), int(course.holes[-1])
        m.holes_done += int(((course.commands["opcode"] == Op.WIERTLO_DOL) & (course.commands["tag"] > 0)).sum())
        m.image = m.switched
        for axis in m.axes:
            m.image |= axis.bits

    def recording(self, command: NDArray[np.void]) -> Recording | None:
        """To be told of the ticks of a command, dtype RECORD (1,), where it is a stroke of the heads alone."""
        if not (self._m.position_known and is_stroke(command, self._strokes.heads).all()):
            return None
        return Recording(self._m, self._world, self._strokes, signatures(command)[0])

    def _stride(self, index: int, direction: int, floor: int) -> MoveProfile:
        key = index, direction, floor
        if key not in self._strides:
            self._strides[key] = MoveProfile(self._m.axes[index], direction, floor)
        return self._strides[key]


def _rests(axis: Axis) -> bool:
    """Nothing is left of a move, a line or a stop; and a drive's direction wire is a wire as any other at rest."""
    alike = not axis.drive or axis.shown == axis.resting
    return alike and not (axis.counting or axis.state or axis.part or axis.line or axis.held or axis.cut or axis.led)


def _travel(axis: Axis) -> int:
    """Columns since power-up, as the wires have it."""
    return axis.travelled * axis.sense
