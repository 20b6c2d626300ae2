"""A work list as a program of KMD records: initialise, take the base, then tool by tool, hole by hole: go, down, up.

Rule: built with numpy, a record's ``tag`` is its hole's number from 1; where there is backlash, a hole is always
come to from below.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.pcb_drill.milling import slots_of, stretches
from drillctl.generation.pcb_drill.strokes import drill_stroke, spot_stroke
from drillctl.generation.sequences import Records, numbered, record
from drillctl.generation.spindles import heads_of
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import Group, WorkList, approaches, backlash_of, positioning_axes
from drillctl.kmd import RECORD, Op
from drillctl.kmd.commands import Flag
from drillctl.machine import Machine


def board_program(work: WorkList, machine: Machine, settings: WorkSettings) -> Records:
    """The program of a job, dtype RECORD; at the end the head is up and back at the working base. Spindles that were
    not chosen stay up. Raises JobError for one that the machine does not have.
    """
    spindle = dict(machine.outputs).get("spindle")
    heads = heads_of(machine, settings.spindles)
    drill = drill_stroke(machine, settings.peck_mm, heads)
    passes = [(work, drill)]
    if settings.spot_mm is not None:  # a spot is left where it was made, also that of a slot
        passes.insert(0, (replace(work, ends=work.steps), spot_stroke(machine, settings.spot_mm, heads)))
    parts = [record(Op.INICJALIZACJA), *go_to_base(settings, machine)]
    here = np.zeros(2, np.int64)
    for group in work.groups:
        parts += [*switch(spindle, 0), record(Op.NARZEDZIE, [group.number])]  # hands are at the chuck meanwhile
        parts += [*switch(spindle, 1), *spin_up(machine, spindle)]
        for made, stroke in passes:
            parts += strokes_of(made, group, stroke, here, machine, settings)
            here = made.ends[group.stop - 1]
    parts += [*switch(spindle, 0), gotos(np.zeros((1, 2), np.int64), machine), record(Op.KONIEC)]
    return numbered(parts)


def go_to_base(settings: WorkSettings, machine: Machine) -> list[Records]:
    """Initialisation leaves the base at machine zero; one elsewhere is gone to and taken again."""
    if not any(settings.base_steps):
        return []
    return [gotos(np.array([settings.base_steps], np.int64), machine), record(Op.BAZA)]


def strokes_of(
    work: WorkList, group: Group, stroke: Records, here: NDArray[np.int64], machine: Machine, settings: WorkSettings
) -> Iterator[Records]:
    """All holes of a tool by the same stroke, and its slots milled."""
    for part, are_slots in stretches(work, group):
        each = slots_of(work, part, machine, settings) if are_slots else stroke
        yield holes_of(work, part, each, here, machine)
        here = work.ends[part.stop - 1]


def holes_of(work: WorkList, group: Group, stroke: Records, here: NDArray[np.int64], machine: Machine) -> Records:
    """The holes of a tool: to each a go (two where backlash is taken up), then the stroke, (commands,) the same for all
    or (holes, commands). Where the machine's file says from where on the heads are clear, the way to the next hole
    begins during the stroke up.
    """
    steps = work.steps[group.start : group.stop]
    before = approaches(steps, work.ends[group.start : group.stop], here, backlash_of(machine))
    blocks = np.zeros((len(steps), stroke.shape[-1] + 2), dtype=RECORD)
    blocks[:, 0] = gotos(before, machine)
    blocks[:, 1] = gotos(steps, machine)
    blocks[:, 2:] = stroke
    blocks["tag"][:, 2:] = work.number[group.start : group.stop, None]
    kept = np.ones(blocks.shape, bool)
    kept[:, 0] = (before != steps).any(axis=1)
    if machine.drill_clear_steps is not None:
        overlap(blocks[:-1, -1], gotos(before[1:], machine))
        kept[1:, 1] = kept[1:, 0]
        kept[1:, 0] = False
    return blocks[kept]


def overlap(ups: Records, ways: Records) -> None:
    """Makes strokes up (n,) and the ways that follow them (n,) one command each: X and Y start on their way as soon as
    the heads are clear of the board.
    """
    ups["opcode"], ups["flags"] = Op.GORA_X_Y, ways["flags"]
    ups["axes"] |= ways["axes"]
    ups["args"] += ways["args"]


def gotos(steps: NDArray[np.int64], machine: Machine) -> Records:
    """A move of X and Y to each of these places (n, 2), in steps from the working base."""
    x, y = positioning_axes(machine)
    records = np.zeros(len(steps), dtype=RECORD)
    records["opcode"] = Op.GOTO_X_Y
    records["flags"] = Flag.ABSOLUTE
    records["axes"] = 1 << x | 1 << y
    records["args"][:, x], records["args"][:, y] = steps[:, 0], steps[:, 1]
    return records


def spin_up(machine: Machine, spindle: int | None) -> list[Records]:
    """The wait until the spindle turns; nothing where it has no output, or needs no time."""
    ticks = round(machine.configuration.spin_up_s * machine.tick_hz)
    return [] if spindle is None or not ticks else [record(Op.CZEKAJ, [ticks])]


def switch(bit: int | None, level: int) -> list[Records]:
    """An output, by its bit, switched to a level; nothing where the machine has none."""
    return [] if bit is None else [record(Op.WYJSCIE, [bit, level])]
