"""A job: what is run on a machine, with all that is needed to tell a person about it.

Rule: whatever is wrong with the input is found here, before a queue or a port exists. Called by desk and the verbs.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drillctl.files.inputs import read_bytes
from drillctl.generation.errors import JobError
from drillctl.generation.placing import Affine
from drillctl.generation.program import board_program
from drillctl.generation.wishes import Wishes
from drillctl.generation.worklist import Group, WorkList, build
from drillctl.kmd import KmdError, Names, parse_program, to_text
from drillctl.language import one_line
from drillctl.machine import Machine

if TYPE_CHECKING:
    from drillctl.generation.drillfile import DrillFile, DrillFileError

LARGEST_QUEUE_BYTES = 256 * 1024 * 1024
UNMOVED = Affine.of(np.eye(2))


@dataclass(frozen=True)
class MadeHole:
    """One hole as the plant made it, in the file's coordinates; tool and diameter as far as they are known."""

    tool: int
    diameter_mm: float | None
    x_mm: float
    y_mm: float


@dataclass(frozen=True, eq=False)
class Job:
    """A program (dtype kmd.RECORD) with its source. ``work`` is None for a queue written by hand."""

    name: str
    program: NDArray[np.void]
    machine: Machine
    work: WorkList | None = None
    warnings: tuple[str, ...] = ()

    @property
    def holes_total(self) -> int:
        """Holes of the work list; a queue written by hand has no list."""
        return 0 if self.work is None else len(self.work.steps)

    def made_hole(self, tool: int, tag: int, places: tuple[float, ...]) -> MadeHole:
        """What a touch of the board is in the file's coordinates: ``places`` are steps from machine zero by axis."""
        group, placed = self._hole(tag)
        x_mm, y_mm = placed.inverse().apply_one(self._place_mm("x", places), self._place_mm("y", places))
        return MadeHole(group.number if group else tool, group.diameter_mm if group else None, x_mm, y_mm)

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
        assert self.work is not None
        x_mm, y_mm = self.work.hits.xy_mm[int(np.searchsorted(self.work.number, number))].tolist()
        return x_mm, y_mm

    def without(self, done: set[int], wishes: Wishes) -> "Job":
        """What is left of a board when these holes, by number, are drilled: initialised anew, from the same base."""
        assert self.work is not None
        work = self.work.without(done)
        return replace(self, work=work, program=board_program(work, self.machine, wishes))

    def _hole(self, tag: int) -> tuple[Group | None, Affine]:
        """The tool group and the board of a hole by its number, as far as a work list knows it."""
        row = int(np.searchsorted(self.work.number, tag)) if self.work is not None else 0
        if self.work is None or row >= self.holes_total or self.work.number[row] != tag:
            return None, UNMOVED
        group = next(group for group in self.work.groups if group.start <= row < group.stop)
        return group, self.work.boards[self.work.hits.board[row]]


def load_job(path: Path, machine: Machine, wishes: Wishes, fmt: str | None = None, after_end: str = "refuse") -> Job:
    """A drill file or (``.kmd``) a queue as a job. Raises JobError with one line a problem.

    fmt, after_end: how the drill file is read (drillfile.read).
    """
    if path.suffix.lower() == ".kmd":
        return _queue_job(path, machine)
    from drillctl.generation.drillfile import DrillFileError, read

    try:
        drill_file = replace(read(path, fmt=fmt, after_end=after_end), name=str(path))
    except DrillFileError as error:
        raise refusal(path, error) from error
    work = build(drill_file, wishes, machine)
    warnings = (*file_warnings(path, drill_file), *_life_warnings(path, work))
    return Job(path.name, board_program(work, machine, wishes), machine, work, warnings)


def refusal(path: Path, error: "DrillFileError") -> JobError:
    """What is wrong with a drill file, a line a problem, by the path that was given."""
    places = (f"{path}:{problem.line}" if problem.line else f"{path}" for problem in error.problems)
    return JobError([f"{place}: {problem.reason}" for place, problem in zip(places, error.problems, strict=True)])


def file_warnings(path: Path, drill_file: "DrillFile") -> list[str]:
    """A line for each thing that was read with a doubt, and for what is not drilled."""
    told = [f"{path}{f':{w.line}' if w.line else ''}: {w.reason}" for w in drill_file.warnings]
    routs = drill_file.routs
    return [*told, f"{path}: {routs} milled cuts are not drilled"] if routs else told


def _life_warnings(path: Path, work: WorkList) -> list[str]:
    """A line for each drill that will be blunt before its holes are made."""
    told = []
    for group in work.groups:
        left = group.drill.hits_left if group.drill else None
        if left is not None and group.stop - group.start > left:
            holes = group.stop - group.start
            told.append(f"{path}: tool T{group.number} makes {holes} holes; its drill is good for {left} more")
    return told


def queue_text(job: Job) -> str:
    """A job as a ``.kmd`` queue, one command a line."""
    names = names_of(job.machine)
    lines = [f"# {one_line(job.name)} on {job.machine.name}: {job.holes_total} holes"]
    lines += [to_text(record, names) for record in job.program]
    return "\n".join([*lines, ""])


def names_of(machine: Machine) -> Names:
    """What a machine calls its axes, outputs and inputs."""
    return Names(machine.axis_names, dict(machine.outputs), {sensor.name: sensor.bit for sensor in machine.sensors})


def _queue_job(path: Path, machine: Machine) -> Job:
    try:
        text = read_bytes(path, LARGEST_QUEUE_BYTES, "a queue").decode()
        program = parse_program(text, names_of(machine), str(path))
    except OSError as error:
        raise JobError([f"{path}: can't be read: {error.strerror}"]) from error
    except UnicodeDecodeError as error:
        raise JobError([f"{path}: not UTF-8 text, so not a .kmd queue"]) from error
    except KmdError as error:
        raise JobError([str(error)]) from error
    return Job(path.name, program, machine)
