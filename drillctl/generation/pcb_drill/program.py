"""A work list as a program of KMD records: initialise, take the base, then tool by tool, hole by hole: go, down, up.

Rule: built with numpy, a record's ``tag`` is its hole's number from 1; where there is backlash, a hole is always
come to from below.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.pcb_drill.strokes import drill_stroke, spot_stroke
from drillctl.generation.sequences import Records, numbered, record
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import Group, WorkList, approaches, backlash_of, positioning_axes
from drillctl.kmd import RECORD, Op
from drillctl.kmd.commands import Flag
from drillctl.machine import Machine


def board_program(work: WorkList, machine: Machine, settings: WorkSettings) -> Records:
    """The program of a job, dtype RECORD; at the end the head is up and back at the working base."""
    spindle = dict(machine.outputs).get("spindle")
    drill = drill_stroke(machine, settings.peck_mm)
    passes = [drill] if settings.spot_mm is None else [spot_stroke(machine, settings.spot_mm), drill]
    parts = [record(Op.INICJALIZACJA), *_base(settings, machine)]
    here = np.zeros(2, np.int64)
    for group in work.groups:
        parts += [*_switch(spindle, 0), record(Op.NARZEDZIE, [group.number])]  # hands are at the chuck meanwhile
        parts += [*_switch(spindle, 1), *_spin_up(machine, spindle)]
        for stroke in passes:
            parts.append(_holes(work, group, stroke, here, machine))
            here = work.steps[group.stop - 1]
    parts += [*_switch(spindle, 0), _gotos(np.zeros((1, 2), np.int64), machine), record(Op.KONIEC)]
    return numbered(parts)


def _base(settings: WorkSettings, machine: Machine) -> list[Records]:
    """Initialisation leaves the base at machine zero; one elsewhere is gone to and taken again."""
    if not any(settings.base_steps):
        return []
    return [_gotos(np.array([settings.base_steps], np.int64), machine), record(Op.BAZA)]


def _holes(work: WorkList, group: Group, stroke: Records, here: NDArray[np.int64], machine: Machine) -> Records:
    """The holes of a tool: to each a go (two where backlash is taken up), then the stroke."""
    steps = work.steps[group.start : group.stop]
    before = approaches(steps, here, backlash_of(machine))
    blocks = np.zeros((len(steps), len(stroke) + 2), dtype=RECORD)
    blocks[:, 0] = _gotos(before, machine)
    blocks[:, 1] = _gotos(steps, machine)
    blocks[:, 2:] = stroke
    blocks["tag"][:, 2:] = work.number[group.start : group.stop, None]
    kept = np.ones(blocks.shape, bool)
    kept[:, 0] = (before != steps).any(axis=1)
    return blocks[kept]


def _gotos(steps: NDArray[np.int64], machine: Machine) -> Records:
    x, y = positioning_axes(machine)
    records = np.zeros(len(steps), dtype=RECORD)
    records["opcode"] = Op.GOTO_X_Y
    records["flags"] = Flag.ABSOLUTE
    records["axes"] = 1 << x | 1 << y
    records["args"][:, x], records["args"][:, y] = steps[:, 0], steps[:, 1]
    return records


def _spin_up(machine: Machine, spindle: int | None) -> list[Records]:
    ticks = round(machine.configuration.spin_up_s * machine.tick_hz)
    return [] if spindle is None or not ticks else [record(Op.CZEKAJ, [ticks])]


def _switch(bit: int | None, level: int) -> list[Records]:
    return [] if bit is None else [record(Op.WYJSCIE, [bit, level])]
