"""Slots that are milled: the bit goes down at one end, X and Y carry it along one line to the other, and it goes up.

Rule: only a machine whose file says how fast (``[drill] mill_mm_min``) mills. In pecks each pass but the last goes
there and back, so that a slot always ends where its last pass does. Between passes the bit stays in the board.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.errors import JobError
from drillctl.generation.pcb_drill.strokes import head_move, mask_of, pecks_of
from drillctl.generation.sequences import Records, record
from drillctl.generation.spindles import heads_of
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import Group, WorkList, positioning_axes
from drillctl.kmd import Op
from drillctl.kmd.commands import Flag
from drillctl.language import Message
from drillctl.machine import Machine

SECONDS_PER_MINUTE = 60
Integers = NDArray[np.int64]


def check_mills(machine: Machine, settings: WorkSettings) -> None:
    """Raises JobError for slots to be milled on a machine that doesn't say how fast it can."""
    if settings.mill and machine.mill_mm_min is None:
        raise JobError(
            Message(
                "{machine} does not mill: its file has no mill_mm_min in [drill]; without --mill slots are drilled as "
                "holes that overlap",
                machine=machine.name,
            ).at(machine.file)
        )


def is_slot(work: WorkList) -> NDArray[np.bool_]:
    """(n,): which of the places are milled."""
    milled: NDArray[np.bool_] = (work.steps != work.ends).any(axis=1)
    return milled


def stretches(work: WorkList, group: Group) -> Iterator[tuple[Group, bool]]:
    """The holes of a tool in stretches of either drilled or milled ones, and whether they are milled."""
    milled = is_slot(work)[group.start : group.stop]
    bounds = [0, *(np.flatnonzero(np.diff(milled)) + 1).tolist(), len(milled)]
    for first, stop in pairwise(bounds):
        yield replace(group, start=group.start + first, stop=group.start + stop), bool(milled[first])


def slots_of(work: WorkList, group: Group, machine: Machine, settings: WorkSettings) -> Records:
    """The strokes (slots, commands) of slots that follow each other, dtype RECORD."""
    heads = heads_of(machine, settings.spindles)
    begun, ends = (places[group.start : group.stop] for places in (work.steps, work.ends))
    floors = floor_ticks(begun, ends, machine)
    there, back = (lines(to, floors, machine) for to in (ends, begun))
    feed, no_feed = speeds(floors), speeds(np.zeros_like(floors))
    passes = pecks_of(machine, settings.peck_mm, heads)
    down = record(Op.WIERTLO_DOL, axes=mask_of(machine, heads))
    up = record(Op.WIERTLO_GORA, axes=mask_of(machine, heads))
    parts = []
    for depth in passes:
        parts += [head_move(machine, depth, heads), feed, there, back, no_feed]
    parts += [down, feed, there, no_feed, up]
    return np.stack([np.broadcast_to(part, len(begun)) for part in parts], axis=1)


def lines(to: Integers, floors: Integers, machine: Machine) -> Records:
    """A line of X and Y to each of these places (n, 2), in steps from the working base, no faster than its floor."""
    x, y = positioning_axes(machine)
    records = np.repeat(record(Op.LINIA, axes=1 << x | 1 << y, flags=Flag.ABSOLUTE | Flag.LINKED), len(to))
    records["args"][:, x], records["args"][:, y] = to[:, 0], to[:, 1]
    records["floor_ticks"] = floors
    return records


def speeds(floors: Integers) -> Records:
    """What limits the feed of the moves that follow, (n,): a queue as text has the feed in these commands alone."""
    records = np.repeat(record(Op.PREDKOSC), len(floors))
    records["args"][:, 0] = floors
    return records


def floor_ticks(begun: Integers, ends: Integers, machine: Machine) -> Integers:
    """(n,): the least ticks between two columns of the leading axis with which the bit is no faster than may be."""
    assert machine.mill_mm_min is not None
    axes = [machine.axes[axis] for axis in positioning_axes(machine)]
    ways_mm = np.abs(ends - begun) / [axis.steps_per_mm for axis in axes]
    columns = np.abs(ends - begun) * [axis.columns_per_step for axis in axes]
    seconds = np.hypot(*ways_mm.T) / machine.mill_mm_min * SECONDS_PER_MINUTE
    ticks: Integers = np.ceil(seconds * machine.tick_hz / columns.max(axis=1)).astype(np.int64)
    return ticks

