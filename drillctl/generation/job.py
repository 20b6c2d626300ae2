"""A job: what is run on a machine, with all that is needed to tell a person about it.

Rule: whatever is wrong with the input is found here, before a queue or a port exists. Called by desk.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.drillfile import DrillFileError, read
from drillctl.generation.errors import JobError
from drillctl.generation.placing import Affine, Placing, transform
from drillctl.generation.program import board_program
from drillctl.generation.worklist import WorkList, build, positioning_axes
from drillctl.kmd import KmdError, Names, parse_program
from drillctl.machine import Machine

LARGEST_QUEUE_BYTES = 256 * 1024 * 1024
IDENTITY = Placing(origin="file")


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
    placed: Affine
    work: WorkList | None = None
    warnings: tuple[str, ...] = field(default=())

    @property
    def holes_total(self) -> int:
        """Holes of the work list; for a queue, how often it lowers the head with a tag: never."""
        return 0 if self.work is None else len(self.work.steps)

    def made_hole(self, tool: int, tag: int, places: tuple[float, ...]) -> MadeHole:
        """What a touch of the board is in the file's coordinates: ``places`` are steps from machine zero by axis."""
        group = self._group(tag)
        number, diameter_mm = (tool, None) if group is None else group
        x_mm, y_mm = self._file_mm(places)
        return MadeHole(number, diameter_mm, x_mm, y_mm)

    def _group(self, tag: int) -> tuple[int, float | None] | None:
        groups = self.work.groups if self.work else ()
        return next(((g.number, g.diameter_mm) for g in groups if g.start < tag <= g.stop), None)

    def _file_mm(self, places: tuple[float, ...]) -> tuple[float, float]:
        x, y = positioning_axes(self.machine)
        board_mm = [places[axis] / self.machine.axes[axis].steps_per_mm for axis in (x, y)]
        file_mm = self.placed.inverse().apply(np.array([board_mm]))[0]
        return float(file_mm[0]), float(file_mm[1])


def load_job(path: Path, machine: Machine, placing: Placing, fmt: str | None = None) -> Job:
    """A drill file or (``.kmd``) a queue as a job. Raises JobError with one line a problem."""
    if path.suffix.lower() == ".kmd":
        return _queue_job(path, machine)
    try:
        drill_file = read(path, fmt=fmt)
    except DrillFileError as error:
        raise JobError([str(error)]) from error
    extent = np.concatenate([drill_file.hole_xy_mm, drill_file.slot_mm.reshape(-1, 2)])
    placed = transform(placing, extent)
    work = build(drill_file, placed, machine)
    warnings = [f"{path}:{w.line}: {w.text}" if w.line else f"{path}: {w.text}" for w in drill_file.warnings]
    if drill_file.routs:
        warnings.append(f"{path}: {drill_file.routs} milled cuts are not drilled")
    return Job(path.name, board_program(work, machine), machine, placed, work, tuple(warnings))


def names_of(machine: Machine) -> Names:
    """What a machine calls its axes, outputs and inputs."""
    return Names(machine.axis_names, dict(machine.outputs), {sensor.name: sensor.bit for sensor in machine.sensors})


def _queue_job(path: Path, machine: Machine) -> Job:
    try:
        if path.stat().st_size > LARGEST_QUEUE_BYTES:
            raise JobError([f"{path}: larger than {LARGEST_QUEUE_BYTES >> 20} MiB: not a queue"])
        program = parse_program(path.read_text("utf-8"), names_of(machine), str(path))
    except OSError as error:
        raise JobError([f"{path}: can't be read: {error.strerror}"]) from error
    except UnicodeDecodeError as error:
        raise JobError([f"{path}: not UTF-8 text, so not a .kmd queue"]) from error
    except KmdError as error:
        raise JobError([str(error)]) from error
    return Job(path.name, program, machine, transform(IDENTITY, np.zeros((1, 2))))
