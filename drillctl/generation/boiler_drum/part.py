"""Part programs as jobs: a ``.sentences`` file, or a workpiece by its number."""

from pathlib import Path

from drillctl.generation.boiler_drum.names import is_sentences, number_of
from drillctl.generation.boiler_drum.program import part_program, tool_in_wall
from drillctl.generation.boiler_drum.stores import find_part, has_stores
from drillctl.generation.boiler_drum.text import Part, read_part
from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.waits import Waits
from drillctl.generation.work_settings import WorkSettings
from drillctl.language import Message
from drillctl.machine import Machine


def is_part_file(path: Path, machine: Machine) -> bool:
    """Returns whether a file is named as a part program."""
    return is_sentences(path)


def is_workpiece(path: Path, machine: Machine) -> bool:
    """Returns whether this is the number of a workpiece, on a machine that has stores of them."""
    return number_of(str(path)) is not None and has_stores(machine)


def part_of(path: Path, machine: Machine, ram: Path | None) -> Part:
    """Returns the part program of a file or a number; ``ram``: as ``read_ram``. Raises JobError."""
    number = number_of(str(path)) if is_workpiece(path, machine) else None
    if number is None:
        return read_part(path)
    if path.exists():
        raise JobError(Message("both a file and the number of a workpiece; give the file another name").at(path))
    return find_part(number, machine, ram)


def load_part(path: Path, machine: Machine, setup: JobSetup, settings: WorkSettings, waits: Waits) -> Job:
    """A part program as a job; nothing of it is placed or ordered. Raises JobError with file and line, or with the
    store and its cell.
    """
    return job_of(part_of(path, machine, settings.store), machine)


def job_of(part: Part, machine: Machine) -> Job:
    """Returns the job that runs a part program. Raises JobError with a line or a cell for each wrong sentence."""
    name = part.source if part.in_store else Path(part.source).name
    return Job(name, part_program(part, machine), machine, warnings=tuple(tool_in_wall(part, machine)))
