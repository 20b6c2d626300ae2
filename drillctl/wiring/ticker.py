"""Wiring of layers 3 and 4: runs the ticks of one machine on one port, and watches what the plant sees.

Rule: no decision about motion is taken here; between ticks it samples, counts holes and writes the status record.
Created by desk for a job and by the tests.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from drillctl.execution import Controller, report, tick
from drillctl.kmd import STATUS, CommandQueue, Condition, Mailbox, Queue, Requests
from drillctl.machine import Machine
from drillctl.plant import IdealPlant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import Driver
from drillctl.trace import Recorder, Trace
from drillctl.wiring.sampler import Keeper, Sampler


@dataclass
class Ticker:
    """One machine on one port. ``touched`` grows by a hole when the plant's bit first meets the board there:
    (tool, tag of the hole begun, place in steps from machine zero by axis, lost steps taken off)."""

    machine: Machine
    port: Driver
    plant: IdealPlant | None = None
    traced: bool = False
    derived: bool = False
    queue: CommandQueue = field(default_factory=Queue)
    requests: Mailbox = field(default_factory=Requests)
    keeper: Keeper | None = None

    def __post_init__(self) -> None:
        self.controller = Controller(self.machine, self.queue, self.requests, self.port)
        self.status: np.void = np.zeros(1, dtype=STATUS)[0]
        self.touched: list[tuple[int, int, tuple[float, ...]]] = []
        self._touches = 0
        self._tags: set[int] = set()
        self.sampler = Sampler(self.controller, self.plant, self.derived, self.keeper) if self.traced else None

    @classmethod
    def simulated(cls, machine: Machine, traced: bool = False, derived: bool = False) -> "Ticker":
        """The machine on the simulated card, with the ideal plant behind it."""
        plant = IdealPlant(machine)
        return cls(machine, SimulatedCard(plant), plant, traced, derived)

    def run(self, ticks: int, until: Callable[[], bool] | None = None) -> int:
        """Runs up to so many wakes, fewer when ``until`` says so after one; returns how many ticks came of them."""
        m, plant, sampler = self.controller, self.plant, self.sampler
        first = m.tick
        for _ in range(ticks):
            before = m.tick
            tick(m)
            if sampler is not None and m.tick != before:
                sampler.sample()
            if plant is not None and plant.touches != self._touches:
                self._touches = plant.touches
                self._touch()
            if until is not None and until():
                break
        return m.tick - first

    def over(self) -> bool:
        """The job has ended, and everything rests: at KMD_KONIEC, by a stop, or latched by a fault."""
        m = self.controller
        if m.condition == Condition.LATCHED:
            return not m.moving
        return m.condition == Condition.READY and not m.job and not m.moving

    def report(self) -> np.void:
        """The status record, written anew; what the plant has lost is told while everything rests."""
        report(self.controller, self.status)
        if self.plant is not None and not self.controller.moving:
            lost = self.lost_steps()
            self.status["lost"][: len(lost)] = np.rint(lost)
        return self.status

    def late(self, count: int, worst_ns: int) -> None:
        """How punctual the ticks were so far, for the status record."""
        self.status["late"], self.status["late_worst_ns"] = count, worst_ns

    def finished_trace(self, header: Iterable[tuple[str, str]]) -> Trace | None:
        """The record of the run so far, where it is kept in this process."""
        if self.sampler is None or not isinstance(self.sampler.recorder, Recorder):
            return None
        return self.sampler.recorder.finish(self.controller.tick, header)

    def _touch(self) -> None:
        """The bit meets the board; a hole that is come to again (a peck after a peck) is counted once."""
        tag = self.controller.hole_begun
        if tag == 0 or tag not in self._tags:
            self._tags.add(tag)
            self.touched.append((self.controller.tool, tag, self.places()))

    def lost_steps(self) -> tuple[float, ...]:
        """By axis: how far the plant is behind the controller, in steps. Needs a plant."""
        assert self.plant is not None
        pairs = zip(self.plant.rotors, self.controller.axes, strict=True)
        return tuple(r.columns_lost(a.travelled * a.sense) * a.sense / a.columns_per_step for r, a in pairs)

    def places(self) -> tuple[float, ...]:
        """By axis: where the plant stands, in the controller's steps from machine zero. Needs a plant."""
        positions = (axis.position for axis in self.controller.axes)
        return tuple(p - lost for p, lost in zip(positions, self.lost_steps(), strict=True))
