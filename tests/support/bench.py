"""A machine on the bench: the real controller on a simulated card that can be watched and made to lie.

Rule: nothing of the tick is replaced; only the card stands between the controller and the ideal plant.
Used by tests/execution.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.job import names_of
from drillctl.kmd import Condition, Request, parse_program
from drillctl.machine import Library, Machine, RampTable, shipped_tables
from drillctl.machine.ramp_file import parse_ramp
from drillctl.machine.source import Source
from drillctl.plant import IdealPlant, Plant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ticker.ticker import Ticker

FINE_TICK_HZ = 20_000
LONGEST_RUN_WAKES = 400_000
MACHINES = ("pcb-drill", "pcb-drill-ramp-lab", "boiler-drum", "eight-axis")


EVEN = (  # intervals of 9 to 1 ticks, a state a step
    'name = "even-steps"\n{option}[computed]\ntick_hz = 1000\npulse_mm = 0.02\n'
    "start_hz = 111.11\ntop_hz = 1000\nshrink_ticks = 1\n"
)


def even_ramp(option: str = "") -> RampTable:
    """A ramp computed as the drum drill's is, short enough to be ticked through; ``option`` is a line of its file."""
    return parse_ramp(Source(Path("even-steps.toml"), EVEN.format(option=option)))


@cache
def shipped(name: str) -> Machine:
    """A machine as it is shipped, whatever tables the user has; one of fine ticks with coarse ones: a step takes a few
    ticks and not hundreds, so that it can be ticked through.
    """
    return coarse(Library((shipped_tables(),)).machine(name))


def coarse(machine: Machine) -> Machine:
    """The machine itself; one of fine ticks with coarse ones."""
    if machine.tick_hz < FINE_TICK_HZ:
        return machine
    return replace(machine, tick_hz=4167, axes=tuple(replace(axis, ramp=even_ramp()) for axis in machine.axes))


class WatchedCard(SimulatedCard):
    """A simulated card that counts, remembers what was flushed, and whose inputs may be stuck.

    stuck_high, stuck_low   input bits that read so whatever the plant does
    """

    def __init__(self, plant: Plant):
        super().__init__(plant)
        self.calls: list[str] = []
        self.images: list[int] = []
        self.stuck_high = self.stuck_low = 0

    def latch(self) -> int:
        self.calls.append("latch")
        return (super().latch() | self.stuck_high) & ~self.stuck_low

    def flush(self, image: int) -> None:
        self.calls.append("flush")
        self.images.append(image)
        super().flush(image)


class Bench:
    """A machine, its controller ``m``, its ``card``; ``images[n]`` is what tick n put out (no wakes of an underrun)."""

    def __init__(self, machine: Machine, traced: bool = False, plant: Plant | None = None):
        self.machine = machine
        plant = plant or IdealPlant(machine)
        self.card = WatchedCard(plant)
        self.ticker = Ticker(machine, self.card, plant, traced, derived=traced)
        self.m = self.ticker.controller
        self.images = self.card.images
        self.before_tick: Callable[[], None] | None = None  # done once, before the next run of ticks

    def queue(self, text: str, end: bool = True) -> "Bench":
        """Puts commands into the queue, one a line or separated by ``;``; ``end`` adds KMD_KONIEC."""
        program = self.program(text)
        return self.put(program if end else program[:-1])

    def program(self, text: str) -> NDArray[np.void]:
        """Commands as records, KMD_KONIEC the last."""
        return parse_program(text.replace(";", "\n"), names_of(self.machine))

    def put(self, program: NDArray[np.void]) -> "Bench":
        """Puts records into the queue, of this epoch."""
        program["epoch"] = self.m.epoch
        assert self.ticker.queue.put(program) == len(program), "the program does not fit into the queue"
        return self

    def tick(self, ticks: int = 1) -> "Bench":
        """So many wakes."""
        self.ticker.run(ticks)
        return self

    def ask(self, *requests: Request) -> "Bench":
        """Posts requests; the next tick serves them."""
        for request in requests:
            self.ticker.requests.post(request)
        return self

    def until(self, holds: Callable[[], bool]) -> int:
        """Runs until a condition holds after a tick; returns how many ticks that took."""
        if self.before_tick is not None:
            self.before_tick()
            self.before_tick = None
        ticks = self.ticker.run(LONGEST_RUN_WAKES, holds)
        assert holds(), f"not reached within {LONGEST_RUN_WAKES} wakes"
        return ticks

    def finish(self) -> int:
        """Runs to the end of the job, or to where a stop or fault ends it; returns the ticks it took."""
        return self.until(self.ticker.over)

    def ready(self) -> "Bench":
        """Initialises, so that the position is known, and forgets what was recorded meanwhile."""
        self.queue("KMD_INICJALIZACJA").finish()
        assert self.m.position_known
        self.images.clear()
        self.card.calls.clear()
        return self

    def done_at(self, sequence: int) -> int:
        """Runs until a command is done; the index of the tick that completed it."""
        self.until(lambda: self.m.done == sequence)
        return self.m.tick - 1

    def bits(self, axis: str, *wires: str) -> int:
        """The output bits of some wires of an axis (all of them when none is named)."""
        table = self.machine.axes[self.index(axis)]
        named = zip(table.phase.wire_names(), table.wire_bits, strict=True)
        return sum(1 << bit for name, bit in named if not wires or name in wires)

    def forcing(self, axis: str) -> int:
        """The bits of an axis's forcing wires."""
        table = self.machine.axes[self.index(axis)]
        named = zip(table.phase.wires, table.wire_bits, strict=True)
        return sum(1 << bit for wire, bit in named if wire.forcing)

    def input_bit(self, sensor: str) -> int:
        """A sensor's or an input's bit in the input image."""
        return next(1 << found.bit for found in self.machine.input_lines if found.name == sensor)

    def index(self, axis: str) -> int:
        """An axis's place in the machine's file."""
        return self.machine.axis_names.index(axis)

    def positions(self) -> list[int]:
        """By axis, in steps from machine zero."""
        return [axis.position for axis in self.m.axes]

    def latched(self) -> bool:
        return self.m.condition == Condition.LATCHED
