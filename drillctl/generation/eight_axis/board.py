"""A drill file as a job for a machine with parameters. The reader of jobs for its boards."""

from pathlib import Path

from drillctl.generation.eight_axis.program import board_program
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.pcb_drill import board
from drillctl.generation.waits import Waits
from drillctl.generation.work_settings import WorkSettings
from drillctl.machine import Machine


def is_board_by_parameters(path: Path, machine: Machine) -> bool:
    """Returns whether a file, of any name, is a board for a machine whose parameters say how it is drilled."""
    return machine.parameters is not None


def load_board(path: Path, machine: Machine, setup: JobSetup, settings: WorkSettings, waits: Waits) -> Job:
    """A drill file as a job, read, placed and ordered by its options. Raises JobError or PlacingError."""
    return board.load_board(path, machine, setup, settings, waits, board_program)
