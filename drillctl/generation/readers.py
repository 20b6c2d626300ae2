"""The readers of jobs: each recognises the files that are its own, and makes a job of one for a machine.

Rule: the first reader that recognises a file reads it. A machine with jobs of a form of its own adds a row.
"""

import logging
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from drillctl.generation.boiler_drum.part import is_part_file, is_workpiece, load_part
from drillctl.generation.eight_axis.board import is_board_by_parameters
from drillctl.generation.eight_axis.board import load_board as load_board_by_parameters
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.pcb_drill.board import load_board
from drillctl.generation.queues import is_queue, load_queue
from drillctl.generation.waits import Waits, unwatched
from drillctl.generation.work_settings import WorkSettings
from drillctl.machine import Machine

LOG = logging.getLogger(__name__)


class Reader(NamedTuple):
    """``load`` raises JobError, PlacingError or AlignmentError, with a line for each problem."""

    what: str
    recognises: Callable[[Path, Machine], bool]
    load: Callable[[Path, Machine, JobSetup, WorkSettings, Waits], Job]


READERS = (
    Reader("a queue of commands", is_queue, load_queue),
    Reader("a part program", is_part_file, load_part),
    Reader("a workpiece", is_workpiece, load_part),
    Reader("a drill file, by parameters", is_board_by_parameters, load_board_by_parameters),
    Reader("a drill file", lambda path, machine: True, load_board),  # of any name
)


def load_job(path: Path, machine: Machine, setup: JobSetup, waits: Waits = unwatched) -> Job:
    """The job in a file, by the reader that recognises it; ``waits`` is called with how far the work is. Options that
    can't be meant are refused before any file of a job is read.
    """
    settings = setup.work_settings(machine)
    reader = next(reader for reader in READERS if reader.recognises(path, machine))
    LOG.info("%s is read as %s", path, reader.what)
    return reader.load(path, machine, setup, settings, waits)
