"""Part programs as jobs: a ``.sentences`` file, or a workpiece by its number."""

from pathlib import Path

from drillctl.generation.boiler_drum.names import is_sentences, number_of
from drillctl.generation.boiler_drum.program import gear_not_kept, part_program, tool_in_wall
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
    """Returns whether this is meant as the number of a workpiece, on a machine that has stores of them: two digits from
    01 to 99, or other digits that are no file's name.
    """
    text = str(path)
    meant = number_of(text) is not None or (text.isascii() and text.isdigit() and not path.exists())
    return meant and has_stores(machine)


def part_of(path: Path, machine: Machine, ram: Path | None) -> Part:
    """Returns the part program of a file or a number; ``ram``: as ``read_ram``. Raises JobError."""
    if not is_workpiece(path, machine):
        return read_part(path)
    number = number_of(str(path))
    if number is None:
        raise JobError(Message("{number!r} is no workpiece's number from 01 to 99", number=str(path)[:20]))
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
    warnings = (*tool_in_wall(part, machine), *gear_not_kept(part, machine))
    return Job(name, part_program(part, machine), machine, warnings=warnings)
