"""Queues of commands (``.kmd``) as jobs: read from a file, and written as one."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.files.inputs import read_bytes
from drillctl.generation.errors import JobError
from drillctl.generation.job import Job, names_of
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.waits import Waits, reading
from drillctl.generation.work_settings import WorkSettings
from drillctl.kmd import KmdError, parse_program, program_texts
from drillctl.language import Message, message_of, one_line
from drillctl.machine import Machine

LARGEST_QUEUE_BYTES = 256 * 1024 * 1024
ENDING = ".kmd"
MOVED_STEPS = 600  # there, and as many back


def is_queue(path: Path, machine: Machine) -> bool:
    """Whether a file is named as a queue of commands."""
    return path.suffix.lower() == ENDING


def load_queue(path: Path, machine: Machine, setup: JobSetup, settings: WorkSettings, waits: Waits) -> Job:
    """A queue as a job, as it stands: nothing is placed or ordered. Raises JobError with file, line and column."""
    waits(reading(path.name))
    try:
        text = read_bytes(path, LARGEST_QUEUE_BYTES, Message("a queue")).decode()
        program = parse_program(text, names_of(machine), str(path))
    except OSError as error:
        raise JobError(Message("can't be read: {why}", why=message_of(error)).at(path)) from error
    except UnicodeDecodeError as error:
        raise JobError(Message("not UTF-8 text, so not a .kmd queue").at(path)) from error
    except KmdError as error:
        raise JobError(error.message) from error
    return Job(path.name, program, machine)


def there_and_back(machine: Machine) -> NDArray[np.void]:
    """Returns a program, dtype kmd.RECORD, that homes the machine and then moves all axes there and back again: those
    that drill half of the way back, as a sensor answers where they were homed. It has no end: from its second command
    on it can be repeated.
    """
    ways = [min(MOVED_STEPS, axis.span_steps // 2) for axis in machine.axes]
    far = " ".join(f"{axis.name}={way}" for axis, way in zip(machine.axes, ways, strict=True))
    back = [way // 2 if index in machine.drill_axes else 0 for index, way in enumerate(ways)]
    near = " ".join(f"{axis.name}={way}" for axis, way in zip(machine.axes, back, strict=True))
    return parse_program(f"KMD_INICJALIZACJA\nKMD_RUCH {far}\nKMD_RUCH {near}\n", names_of(machine))[:-1]


def queue_text(job: Job) -> str:
    """A job as a ``.kmd`` queue, one command a line."""
    names = names_of(job.machine)
    lines = [f"# {one_line(job.name)} on {job.machine.name}: {job.holes_total} holes"]
    lines += program_texts(job.program, names)
    return "\n".join([*lines, ""])
