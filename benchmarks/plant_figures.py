"""What the dynamic plant loses, and from when on: the tables of docs/PLANT.md.

Run as ``python -m benchmarks.plant_figures`` (some minutes; ``--quick`` for one rest column of each kind and a
coarser grid). Every figure is a trial of the real automaton on X of a machine, judged at rest (lab/trials.py), but
for the example board, which is drilled whole.
"""

import argparse
import os
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random

import numpy as np

from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.jobs.runner import JobRunner
from drillctl.lab.moves import move
from drillctl.lab.tables import BROKEN, direct_start
from drillctl.lab.trials import Trial, errors_full_steps, lost
from drillctl.machine import AxisTable, Dynamics, Library, shipped_tables
from drillctl.plant import PlantChoice
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.plant.dynamic.rotor import DynamicRotor
from drillctl.ticker.link import LocalLink
from drillctl.ticker.ticker import Ticker

MACHINES = ("pcb-drill", "pcb-drill-ramp-lab")
LONG_COLUMNS, SHORT_COLUMNS, LONGEST_COLUMNS = 900, 300, 1500
VARIED = ("resistance_ohm", "inductance_h", "torque_nm_per_a", "inertia_kgm2", "viscous_nms", "coulomb_nm")
VARIANTS, SPREAD = 40, 0.03
WAYS = {"forward": 1, "backward": -1}
NEVER = "-"
BOARD = Path(__file__).resolve().parent.parent / "examples" / "blinker.drl"
DRUM_STEPS = 700
BOARD_HZ = (500, 560, 575, 580, 585, 590, 595, 600)


@dataclass(frozen=True)
class Bench:
    """How thorough: which rest columns a move begins on, and how far apart the tick rates are."""

    columns: Sequence[int]
    grid_hz: int

    def errors(
        self, axis: AxisTable, columns: int, rates_hz: Sequence[int], variants: Sequence[Dynamics] = ()
    ) -> np.ndarray:
        """(rates x variants, rest columns): moves of so many columns."""
        moves = [move(axis, columns // axis.columns_per_step, column) for column in self.columns]
        assert axis.dynamics is not None
        kinds = [(hz, kind) for hz in rates_hz for kind in variants or [axis.dynamics]]
        trials = [Trial(each, hz, kind) for hz, kind in kinds for each in moves]
        return errors_full_steps(axis, trials).reshape(len(kinds), len(moves))

    def losing_hz(self, axis: AxisTable, columns: int, lowest: int, highest: int) -> list[int]:
        """The rates of the grid at which a move loses steps."""
        rates = range(lowest, highest + 1, self.grid_hz)
        losing = lost(self.errors(axis, columns, rates)).any(axis=1)
        return [hz for hz, loses in zip(rates, losing, strict=True) if loses]

    def first_lost_hz(self, axis: AxisTable, columns: int) -> str:
        """The lowest rate from 300 Hz on."""
        return str(min(self.losing_hz(axis, columns, 300, 700), default=NEVER))

    def slow_losses_hz(self, axis: AxisTable, columns: int) -> str:
        """All rates up to 580 Hz."""
        return ", ".join(map(str, self.losing_hz(axis, columns, 60, 580))) or NEVER


def short_moves(axis: AxisTable, bench: Bench) -> str:
    """All moves 1..500 both ways at 500 Hz from every rest column."""
    moves = [move(axis, way * steps, c) for c in bench.columns for steps in range(1, 501) for way in WAYS.values()]
    assert axis.dynamics is not None
    errors = errors_full_steps(axis, [Trial(each, 500, axis.dynamics) for each in moves])
    return f"{int(lost(errors).sum())} of {len(moves)}; at most {np.abs(errors).max():.2f} off"


def variants_of(dynamics: Dynamics) -> list[Dynamics]:
    """Half of them anywhere within 3 %, half in the corners."""
    random = Random(1996)
    found = []
    for number in range(VARIANTS):
        parts = [random.uniform(-1, 1) if number % 2 else random.choice((-1, 1)) for _ in VARIED]
        changes = zip(VARIED, parts, strict=True)
        found.append(replace(dynamics, **{name: getattr(dynamics, name) * (1 + SPREAD * by) for name, by in changes}))
    return found


def varied_losses(axis: AxisTable, bench: Bench, hz: int) -> str:
    assert axis.dynamics is not None
    variants = variants_of(axis.dynamics)
    lose = 0
    for way in WAYS.values():
        errors = bench.errors(axis, way * LONGEST_COLUMNS, [hz], variants)
        lose += int(lost(errors).any(axis=1).sum())
    return f"{lose} of {2 * VARIANTS}"


def rows(axis: AxisTable, bench: Bench) -> Iterator[tuple[str, str]]:
    """What stands in the first table, for one machine."""
    direct = replace(axis, ramp=direct_start(axis.ramp))
    unforced = replace(axis, phase=BROKEN["forcing removed"](axis.phase))
    yield "moves of 1 to 500 steps both ways that lose at 500 Hz; error at rest in full steps", short_moves(axis, bench)
    for name, way in WAYS.items():
        yield f"loses from, {name} [Hz]", bench.first_lost_hz(axis, way * LONG_COLUMNS)
    for name, way in WAYS.items():
        yield f"loses up to 580 Hz, {name} [Hz]", bench.slow_losses_hz(axis, way * LONG_COLUMNS)
    for hz in (500, 560, 580):
        yield f"variants within 3 % and direction that lose at {hz} Hz", varied_losses(axis, bench, hz)
    for name, way in WAYS.items():
        yield f"without a ramp loses from, {name} [Hz]", bench.first_lost_hz(direct, way * SHORT_COLUMNS)
    for name, way in WAYS.items():
        yield f"without forcing loses from, {name} [Hz]", bench.first_lost_hz(unforced, way * SHORT_COLUMNS)


def print_table(head: Sequence[str], lines: Sequence[Sequence[str]]) -> None:
    for line in (head, ["---"] * len(head), *lines):
        print(f"| {' | '.join(line)} |", flush=True)


def broken_tables(axis: AxisTable, bench: Bench) -> None:
    """The worst error over the rest columns, forwards."""
    rates = (70, 250, 400, 500, 560)
    lines = []
    for name, breaking in {"sound": lambda table: table, **BROKEN}.items():
        bad = replace(axis, phase=breaking(axis.phase))
        errors = bench.errors(bad, LONGEST_COLUMNS, rates)
        lines.append([name, *(f"{each[np.argmax(np.abs(each))]:.1f}" for each in errors)])
    print_table(["table", *(f"{hz} Hz" for hz in rates)], lines)


def whole_board() -> None:
    """The example board on pcb-drill with its nominal figures: X, Y and Z with its drill."""
    lines = []
    for hz in BOARD_HZ:
        machine = Library((shipped_tables(),)).machine("pcb-drill").at_rate(hz)
        link = LocalLink(Ticker.simulated(machine, plant_choice=PlantChoice("dynamic")))
        told = JobRunner(load_job(BOARD, machine, JobSetup("pcb-drill")), link, lambda progress: None).run().outcome
        lost_steps = " ".join(f"{name} {steps}" for name, steps in (told.lost_steps or {}).items())
        fault = told.fault.name if told.fault else NEVER
        lines.append([f"{hz} Hz", f"{told.holes_done} of {told.holes_total}", lost_steps, fault])
    print_table(["blinker.drl at", "holes", "steps lost", "fault"], lines)


def behind_steps(axis: AxisTable, steps: int, tick_hz: int, part: float = 1.0) -> int:
    """The steps by which a rotor is behind at rest, after this part of a move and a dead stop."""
    made = move(axis, steps, rest_ticks=1)
    last = round(part * len(made.images)) - 1
    images = [made.images[0]] * tick_hz + [*made.images[: last + 1]] + [made.images[last]] * tick_hz
    rotor = DynamicRotor(axis, tick_hz)
    for image in images:
        rotor.pull(int(image))
    return round(rotor.columns_lost(int(made.columns[last])))


def drum_strokes() -> None:
    """What boiler-drum's motors lose of a stroke at its fastest gear: with its ramp, without, and stopped dead."""
    machine = Library((shipped_tables(),)).machine("boiler-drum")
    lines = []
    for what, ramped, part in (("with its ramp", True, 1.0), ("without its ramp", False, 1.0),
                               ("stopped dead at its top speed", True, 0.5)):  # fmt: skip
        axes = [axis if ramped else replace(axis, ramp=direct_start(axis.ramp)) for axis in machine.axes]
        lost_steps = [[behind_steps(axis, way * DRUM_STEPS, machine.tick_hz, part) for way in (1, -1)] for axis in axes]
        lines.append([what, *(f"{forward}, {backward}" for forward, backward in lost_steps)])
    print_table(["", "x, five phases", "y, three phases"], lines)


def ticks_a_second(name: str) -> str:
    """Of the scalar plant, three axes moving; of CPU time."""
    machine = Library((shipped_tables(),)).machine(name)
    plant = DynamicPlant(machine)
    moves = [move(axis, 700 // axis.columns_per_step, rest_ticks=0).images.tolist() for axis in machine.axes]
    images = [x | y | z for x, y, z in zip(*moves, strict=True)]
    began = time.process_time()
    for image in images:
        plant.drive(image)
    return f"{len(images) / (time.process_time() - began):.0f}"


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--quick", action="store_true")
    quick = arguments.parse_args().quick
    bench = Bench(range(3) if quick else range(12), 20 if quick else 5)
    axes = [Library((shipped_tables(),)).machine(name).axes[0] for name in MACHINES]
    first, second = ([*rows(axis, bench)] for axis in axes)
    print_table(["", *MACHINES], [[what, a, b] for (what, a), (_, b) in zip(first, second, strict=True)])
    print()
    broken_tables(axes[0], bench)
    print()
    whole_board()
    print()
    drum_strokes()
    speeds = ", ".join(f"{name} {ticks_a_second(name)}" for name in MACHINES)
    print(f"\nTicks a second, three axes moving: {speeds}; load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


if __name__ == "__main__":
    main()
