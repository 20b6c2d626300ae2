"""A job: what is run on a machine, with all that is needed to tell a person about it. Made by readers.py."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.eight_axis.magazine import Magazine
from drillctl.generation.placing import Affine
from drillctl.generation.worklist import Group, WorkList
from drillctl.kmd import Names
from drillctl.language import Message
from drillctl.machine import Machine

UNMOVED = Affine.of(np.eye(2))


@dataclass(frozen=True)
class MadeHole:
    """One hole as the plant made it, in the coordinates of the file; tool and diameter as far as they are known.
    ``spindle`` is the number, from 1, of the drilling axis that made it; ``number`` that of the hole in the whole job,
    from 1, or 0 for a touch of the board that the job has no number for.
    """

    tool: int
    diameter_mm: float | None
    x_mm: float
    y_mm: float
    spindle: int = 1
    number: int = 0


@dataclass(frozen=True, eq=False, repr=False)
class Job:
    """A program (dtype kmd.RECORD) with its source. ``work`` is None for a queue written by hand; ``programmed`` makes
    the program of another work list in the same way, and on a machine with a magazine for what is known of its tools.
    """

    name: str
    program: NDArray[np.void]
    machine: Machine
    work: WorkList | None = None
    warnings: tuple[Message, ...] = ()
    programmed: Callable[..., NDArray[np.void]] | None = None

    def __repr__(self) -> str:
        return f"<Job {self.name} for {self.machine.name}: {len(self.program)} commands, {self.holes_total} holes>"

    @property
    def holes_total(self) -> int:
        """Holes of the work list; a queue written by hand has no list."""
        return 0 if self.work is None else len(self.work.steps)

    def without_holes(self, done: set[int]) -> "Job":
        """What is left of a board when these holes, by number, are drilled: initialised anew, from the same base."""
        assert self.work is not None and self.programmed is not None
        work = self.work.without(done)
        return replace(self, work=work, program=self.programmed(work))

    def equipped(self, magazine: Magazine) -> "Job":
        """The same on a machine whose tools are as ``magazine`` says. Raises JobError where it can't be done so."""
        assert self.programmed is not None
        return replace(self, program=self.programmed(self.work, magazine=magazine))

    def made_hole(self, tool: int, tag: int, places: tuple[float, ...], head: int) -> MadeHole:
        """What a touch of the board is in the file's coordinates: ``places`` are steps from machine zero by axis,
        ``head`` is the axis of the bit.
        """
        group, placed = self._holes.get(tag, (None, UNMOVED))
        x_mm, y_mm = placed.inverse().apply_one(self._place_mm("x", places), self._place_mm("y", places))
        drill, diameter_mm = (group.number, group.diameter_mm) if group else (tool, None)
        return MadeHole(drill, diameter_mm, x_mm, y_mm, 1 + self.machine.drill_axes.index(head), tag)

    def _place_mm(self, name: str, places: tuple[float, ...]) -> float:
        """From machine zero; 0 on a machine without such an axis, which a queue may run on."""
        axis, steps_per_mm = self._scales[name]
        return 0.0 if axis is None else places[axis] / steps_per_mm

    @cached_property
    def _scales(self) -> dict[str, tuple[int | None, float]]:
        """Axis and scale of X and Y, which are asked for at every hole."""
        indexes = {name: self.machine.axis_index(name) for name in ("x", "y")}
        axes = self.machine.axes
        return {name: (i, 1.0 if i is None else axes[i].steps_per_mm) for name, i in indexes.items()}

    def hole_number(self, drilled: int) -> int:
        """The number in the whole job of the hole that this program drills as its ``drilled``-th, from 1."""
        assert self.work is not None
        return int(self.work.number[drilled - 1])

    def file_place(self, number: int) -> tuple[float, float]:
        """Where a hole, by its number in the whole job, stands in the file (mm)."""
        return self._file_places[number]

    @cached_property
    def _file_places(self) -> dict[int, tuple[float, float]]:
        """By number: asked for at every hole."""
        assert self.work is not None
        x_mm, y_mm = self.work.hits.xy_mm.T.tolist()
        return dict(zip(self.work.number.tolist(), zip(x_mm, y_mm, strict=True), strict=True))

    @cached_property
    def _holes(self) -> dict[int, tuple[Group | None, Affine]]:
        """The tool group and the board of each hole by its number: asked for at every hole."""
        if self.work is None:
            return {}
        groups = [group for group in self.work.groups for _ in range(group.start, group.stop)]
        boards = [self.work.boards[board] for board in self.work.hits.board.tolist()]
        return dict(zip(self.work.number.tolist(), zip(groups, boards, strict=True), strict=True))


def names_of(machine: Machine) -> Names:
    """What a machine calls its axes, outputs and inputs."""
    heads = tuple(machine.axis_names[index] for index in machine.drill_axes)
    inputs = {line.name: line.bit for line in machine.input_lines}
    return Names(machine.axis_names, dict(machine.outputs), inputs, heads)
