"""The work list: what is drilled with which tool, where, in steps from the working base.

Rule: holes that the machine can't reach are refused here, each by name, before anything moves. Slots become chains
of holes. Called by job.py.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.drillfile import DrillFile
from drillctl.generation.errors import JobError
from drillctl.generation.placing import Affine
from drillctl.machine import Machine

# A chain overlaps by half its drill: the waist left between two holes is then an eighth of the diameter.
CHAIN_PITCH = 0.5
CHAIN_DRILL_MM = 1.0  # for a slot whose drill nobody has named
Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Group:
    """The holes of one tool: ``start`` to ``stop`` of the work list."""

    number: int
    diameter_mm: float | None
    start: int
    stop: int


@dataclass(frozen=True, eq=False)
class WorkList:
    """Holes in drilling order, grouped by tool.

    file_xy_mm (n, 2) as the file has them; steps (n, 2) X and Y from the working base; line (n,) of the file.
    """

    groups: tuple[Group, ...]
    file_xy_mm: Floats
    steps: Integers
    line: Integers


@dataclass(frozen=True, eq=False)
class _Hits:
    """Every place where a bit goes down, in file order: slots dissolved into chains."""

    xy_mm: Floats
    tool: Integers
    line: Integers


def build(drill_file: DrillFile, placed: Affine, machine: Machine) -> WorkList:
    """The work list of a file on a machine. Raises JobError for a machine or holes that don't fit."""
    x, y = positioning_axes(machine)
    hits = _hits(drill_file)
    if not len(hits.xy_mm):
        raise JobError([f"{drill_file.name}: there is no hole to drill"])
    order = np.argsort(hits.tool, kind="stable")
    hits = _Hits(hits.xy_mm[order], hits.tool[order], hits.line[order])
    scale = np.array([machine.axes[x].steps_per_mm, machine.axes[y].steps_per_mm])
    steps = np.rint(placed.apply(hits.xy_mm) * scale).astype(np.int64)
    _check_reach(drill_file, hits, steps, machine, (x, y))
    return WorkList(_groups(drill_file, hits), hits.xy_mm, steps, hits.line)


def positioning_axes(machine: Machine) -> tuple[int, int]:
    """The indexes of X and Y. Raises JobError where a machine does not position a board with them."""
    x, y = machine.axis_index("x"), machine.axis_index("y")
    if x is None or y is None or {x, y} & set(machine.drill_axes):
        heads = ", ".join(machine.axis_names[index] for index in machine.drill_axes)
        raise JobError([f"{machine.name}: a board needs axes x and y beside the drilling ones ({heads})"])
    return x, y


def _hits(drill_file: DrillFile) -> _Hits:
    """Holes and slot chains, merged in the order of the file."""
    chains = [_chain(drill_file, index) for index in range(len(drill_file.slot_mm))]
    counts = [len(chain) for chain in chains]
    at = np.concatenate([np.arange(len(drill_file.hole_xy_mm)) + 0.5, np.repeat(drill_file.slot_at, counts)])
    order = np.argsort(at, kind="stable")
    xy_mm = np.concatenate([drill_file.hole_xy_mm, *chains])
    tool = np.concatenate([drill_file.hole_tool, np.repeat(drill_file.slot_tool, counts)])
    line = np.concatenate([drill_file.hole_line, np.repeat(drill_file.slot_line, counts)])
    return _Hits(xy_mm[order], tool[order].astype(np.int64), line[order].astype(np.int64))


def _chain(drill_file: DrillFile, index: int) -> Floats:
    """A slot as holes from end to end, evenly apart."""
    start, end = drill_file.slot_mm[index].reshape(2, 2)
    diameter_mm = drill_file.tools[int(drill_file.slot_tool[index])].diameter_mm or CHAIN_DRILL_MM
    pieces = max(1, int(np.ceil(np.hypot(*(end - start)) / (diameter_mm * CHAIN_PITCH))))
    along: Floats = np.linspace(0.0, 1.0, pieces + 1)[:, None]
    return start + along * (end - start)


def _groups(drill_file: DrillFile, hits: _Hits) -> tuple[Group, ...]:
    used, starts = np.unique(hits.tool, return_index=True)
    stops = [*starts[1:].tolist(), len(hits.tool)]
    tools = [drill_file.tools[index] for index in used.tolist()]
    return tuple(Group(t.number, t.diameter_mm, a, b) for t, a, b in zip(tools, starts.tolist(), stops, strict=True))


def _check_reach(
    drill_file: DrillFile, hits: _Hits, steps: Integers, machine: Machine, axes: tuple[int, int]
) -> None:
    reach = np.array([machine.reach(axis) for axis in axes])
    outside = (steps < reach[:, 0]) | (steps > reach[:, 1])
    problems = []
    for hole in np.flatnonzero(outside.any(axis=1)).tolist():
        xy_mm = hits.xy_mm[hole]
        told = [
            f"{'xy'[k].upper()} {steps[hole, k]} steps is outside {reach[k, 0]}..{reach[k, 1]}"
            for k in (0, 1)
            if outside[hole, k]
        ]
        tool = drill_file.tools[int(hits.tool[hole])].number
        problems.append(
            f"{drill_file.name}:{hits.line[hole]}: hole of tool T{tool} at X{xy_mm[0]:.4f} Y{xy_mm[1]:.4f} mm "
            f"is out of reach of {machine.name}: {'; '.join(told)}"
        )
    if problems:
        raise JobError(problems)
