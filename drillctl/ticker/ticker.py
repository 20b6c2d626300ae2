"""Runs the ticks of one machine on one port; between them it samples, counts holes and writes the status record.

Rule: no decision about motion is taken here; layer 3 (execution) takes them all within ``tick``.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from drillctl.execution import Controller, loaded, look, report, tick
from drillctl.execution.fastforward.stretch import counting_ticks, leave_counted
from drillctl.kmd import (
    STATUS,
    CommandQueue,
    Gate,
    Mailbox,
    Op,
    Queue,
    Requests,
    TickGate,
    has_ended,
    is_idle,
    takes_commands,
)
from drillctl.machine import Machine
from drillctl.plant import IDEAL_PLANT, IdealPlant, Plant, PlantChoice
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import Driver
from drillctl.ticker.sampler import Keeper, Sampler
from drillctl.trace import Recorder, Segments, Trace

FAST, TICK = "fast", "tick"  # the engines, by name
NEVER = 1 << 62  # a tick that doesn't come


@dataclass
class Ticker:
    """One machine on one port.

    plant    what stands behind a simulated card; None on a real port
    traced   the run is recorded; ``derived``: with columns, positions, states and what the plant has
    keeper   takes the record in place of a Recorder made here
    touched  grows by a hole when a bit of the plant first meets its board there: (tool, tag of the hole, place in
             steps from machine zero by axis, lost steps taken off, the axis of the bit)
    """

    machine: Machine
    port: Driver
    plant: Plant | None = None
    traced: bool = False
    derived: bool = False
    queue: CommandQueue = field(default_factory=Queue)
    requests: Mailbox = field(default_factory=Requests)
    gate: TickGate = field(default_factory=Gate)
    keeper: Keeper | None = None

    def __post_init__(self) -> None:
        self.controller = Controller(self.machine, self.queue, self.requests, self.port)
        record = np.zeros(1, dtype=STATUS)
        self.status: np.void = record[0]
        self._lateness = 0, 0
        self._behind: list[int] = []
        self._status_bytes = record.view(np.uint8).data
        self.touched: list[tuple[int, int, tuple[float, ...], int]] = []
        self._touches, self._met = 0, [0] * len(self.machine.axes)
        self._tags: set[tuple[int, int]] = set()
        self.sampler = Sampler(self.controller, self.plant, self.derived, self.keeper) if self.traced else None

    @classmethod
    def simulated(cls, machine: Machine, traced: bool = False, derived: bool = False,
                  plant_choice: PlantChoice = IDEAL_PLANT) -> "Ticker":  # fmt: skip
        """The machine on the simulated card, with a plant behind it. Raises PlantRefused."""
        plant = plant_choice.build(machine)
        return cls(machine, SimulatedCard(plant), plant, traced, derived)

    def run(self, ticks: int, until: Callable[[], bool] | None = None) -> int:
        """Runs up to so many wakes, fewer where ``until`` is true after one; returns how many of them were ticks."""
        m, plant, sampler = self.controller, self.plant, self.sampler
        first = m.tick
        for _ in range(ticks):
            before = m.tick
            tick(m)
            if m.served and m.tick_hz != self.machine.tick_hz:
                self.follow_rate()
            if sampler is not None and m.tick != before:
                sampler.sample()
            if plant is not None and plant.touches != self._touches:
                self.note_touch()
            if until is not None and until():
                break
        return m.tick - first

    def note_touch(self) -> None:
        """Counts a hole for each bit that has just met its board, but in depth detection. Needs a plant."""
        assert self.plant is not None
        if self.plant.touches != self._touches:
            before, self._touches, self._met = self._met, self.plant.touches, self.plant.met.copy()
            for axis in axes_met(before, self._met) if self.controller.command.opcode != Op.DOTYK else ():
                self.touch(self.controller.tool, self.controller.hole_begun, self.places(), axis)

    def advance(self, wakes: int, until: Callable[[], bool] | None = None) -> int:
        """Like ``run``, as far as the gate lets; while it is shut only the inputs are read."""
        if not self.gate.paused:
            return self.run(wakes, until)
        if self.waits:
            look(self.controller)
            return 0
        ticks = self.run(1)
        self.gate.passed(ticks)
        return ticks

    def pass_counting(self, most: int) -> int:
        """Passes at most so many ticks together, in which axes only count and nothing is put out; returns how many.
        On the ideal plant alone: another goes on between the columns too, and real inputs change at any time.
        """
        if not isinstance(self.plant, IdealPlant) or self.gate.paused:
            return 0
        ticks = counting_ticks(self.controller, self.port.latch(), most)
        leave_counted(self.controller, ticks)
        return ticks

    def turn(self, until: Callable[[], bool] | None = None, before: int = NEVER) -> int:
        """Runs the ticks that the queue is sure to last for (each takes one command at most) or to tick ``before``."""
        return self.advance(min(max(1, len(self.queue)), before - self.controller.tick), until)

    @property
    def waits(self) -> bool:
        """Whether ticks wait for the gate. Requests, a machine that brakes or returns, and hot windings don't wait."""
        shut = self.gate.paused and not self.gate.left
        waits = shut and not self.requests.waiting and takes_commands(self.controller.condition)
        return waits and not self.controller.hot_until

    @property
    def resting(self) -> bool:
        """Whether the machine is outside a job, nothing moves and no command waits."""
        m = self.controller
        return is_idle(m.condition, m.job, m.moving) and not m.busy and len(self.queue) == 0

    def load(self, machine: Machine) -> None:
        """Takes the same machine with other phase and ramp tables (edited_tables.py has checked that), at rest."""
        self.machine, self.controller = machine, loaded(machine, self.controller)
        if self.sampler is not None:
            self.sampler.follow(self.controller)

    def follow_rate(self) -> None:
        """Takes over the controller's tick rate after a PACE, for everything that counts ticks as time."""
        self.machine = self.controller.machine = self.machine.at_rate(self.controller.tick_hz)
        if self.plant is not None:
            self.plant.set_rate(self.machine.tick_hz)

    def over(self) -> bool:
        """Whether the job has ended and everything rests."""
        m = self.controller
        return has_ended(m.condition, m.job, m.moving)

    def report(self) -> np.void:
        """The status record, written anew; the lost steps of the plant are measured only while everything rests."""
        report(self.controller, self._status_bytes)
        if self.plant is not None:
            self._measure(self.plant)
        return self.status

    def _measure(self, plant: Plant) -> None:
        """Notes how far the plant is behind, if that has changed; lost steps only while everything rests."""
        behind = [round(1000 * plant.behind_steps(i, axis.travelled)) for i, axis in enumerate(self.controller.axes)]
        if behind != self._behind:
            self._behind = behind
            self.status["behind"][: len(behind)] = behind
        if not self.controller.moving:
            lost = self.lost_steps()
            self.status["lost"][: len(lost)] = np.rint(lost)

    def late(self, count: int, worst_ns: int) -> None:
        """Notes for the status record how many ticks were late so far, and the worst."""
        if (count, worst_ns) != self._lateness:
            self._lateness = count, worst_ns
            self.status["late"], self.status["late_worst_ns"] = count, worst_ns

    def record(self, header: Iterable[tuple[str, str]]) -> Trace | Segments | None:
        """The record of the run so far, in the form in which it is kept."""
        return self.finished_trace(header)

    def finished_trace(self, header: Iterable[tuple[str, str]]) -> Trace | None:
        """The trace of the run so far; None where it is kept elsewhere, or not at all."""
        if self.sampler is None or not isinstance(self.sampler.recorder, Recorder):
            return None
        return self.sampler.recorder.finish(self.controller.tick, header)

    def touch(self, tool: int, tag: int, places: tuple[float, ...], axis: int) -> None:
        """Counts a hole as the bit of an axis meets its board; one that it meets again (pecks) counts once."""
        if tag == 0 or (tag, axis) not in self._tags:
            self._tags.add((tag, axis))
            self.touched.append((tool, tag, places, axis))

    def lost_steps(self) -> tuple[float, ...]:
        """How far each axis of the plant is behind the controller, in steps. Needs a plant."""
        assert self.plant is not None
        return tuple(self.plant.lost_steps(i, axis.travelled) for i, axis in enumerate(self.controller.axes))

    def places(self) -> tuple[float, ...]:
        """Where each axis of the plant stands, in the controller's steps from machine zero. Needs a plant."""
        assert self.plant is not None
        axes = enumerate(self.controller.axes)
        return tuple(axis.position - self.plant.behind_steps(i, axis.travelled) for i, axis in axes)


def axes_met(before: Sequence[int], now: Sequence[int]) -> list[int]:
    """Returns the axes whose bits have met their boards between two values of ``Plant.met``."""
    return [axis for axis, (old, new) in enumerate(zip(before, now, strict=True)) if old != new]
