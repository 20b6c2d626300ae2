"""A drill file as a job: read, placed, ordered, and made a program of. The reader of jobs for boards.

Rule: whatever is wrong with the file is found here, before a queue or a port exists.
"""

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from drillctl.generation.entered import check_entered
from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.pcb_drill.milling import check_mills
from drillctl.generation.pcb_drill.program import board_program
from drillctl.generation.pins import with_pins
from drillctl.generation.sequences import Records
from drillctl.generation.waits import ORDERING, Waits, reading
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import WorkList, build
from drillctl.language import Counted, Message
from drillctl.machine import Machine

if TYPE_CHECKING:
    from drillctl.generation.drillfile import DrillFile, DrillFileError


class ProgramMaker(Protocol):
    """What makes the program of a work list: one for each family of machines."""

    def __call__(self, work: WorkList, machine: Machine, settings: WorkSettings) -> Records:
        """Returns the program, dtype RECORD. Raises JobError."""


def load_board(
    path: Path,
    machine: Machine,
    setup: JobSetup,
    settings: WorkSettings,
    waits: Waits,
    program_of: ProgramMaker = board_program,
) -> Job:
    """A drill file as a job, read, placed and ordered by its options; ``program_of`` makes its program. Raises
    JobError or PlacingError, and JobError for a machine whose parameters are not all entered.
    """
    from drillctl.generation.drillfile import DrillFileError, milled, read

    check_entered(machine)
    check_mills(machine, settings)
    try:
        advance = waits(reading(path.name))
        found = read(path, fmt=setup.options.format, after_end=setup.options.after_end, advance=advance)
    except DrillFileError as error:
        raise refusal(path, error) from error
    found = replace(milled(found) if settings.mill else found, name=str(path))
    drill_file, settings = pinned(found, settings)
    programmed = partial(program_of, machine=machine, settings=settings)
    work = build(drill_file, settings, machine, waits(ORDERING))
    warnings = (*file_warnings(path, drill_file), *_life_warnings(path, work), *_order_warnings(path, settings, work))
    return Job(path.name, programmed(work), machine, work, warnings, programmed)


def pinned(drill_file: "DrillFile", settings: WorkSettings) -> "tuple[DrillFile, WorkSettings]":
    """The file with its pins, and the settings that leave them out where the board lies face down on them. Raises
    PlacingError.
    """
    if settings.pins is None:
        return drill_file, settings
    found, tool = with_pins(drill_file, settings.pins)
    skipped = settings.skip_tools | ({tool} if settings.face_down else set())
    return found, replace(settings, skip_tools=skipped)


def refusal(path: Path, error: "DrillFileError") -> JobError:
    """What is wrong with a drill file, a line a problem, by the path that was given."""
    return JobError(*(problem.reason.at(path, problem.line) for problem in error.problems))


def file_warnings(path: Path, drill_file: "DrillFile") -> list[Message]:
    """A line for each thing that was read with a doubt, and for what is not drilled."""
    warnings = [warning.reason.at(path, warning.line) for warning in drill_file.warnings]
    routs = drill_file.routs
    if routs:
        warning = Counted("{count} milled cut is not drilled", "{count} milled cuts are not drilled", routs)
        warnings.append(warning.at(path))
    return warnings


def _order_warnings(path: Path, settings: WorkSettings, work: WorkList) -> list[Message]:
    """A line where the seconds for the order were over before its search was."""
    if settings.order_seconds is None or work.order_steps is None:
        return []
    return [
        Message(
            "the order was improved for {seconds:g} s, as asked for, and may be longer than without --order-seconds; "
            "another run may find another order (a journal keeps this one)",
            seconds=settings.order_seconds,
        ).at(path)
    ]


def _life_warnings(path: Path, work: WorkList) -> list[Message]:
    """A line for each drill that will be blunt before its holes are made."""
    warnings = []
    for group in work.groups:
        left = group.drill.hits_left if group.drill else None
        if left is not None and group.stop - group.start > left:
            holes = group.stop - group.start
            warnings.append(
                Counted(
                    "tool T{number} makes {count} hole; its drill is good for {left} more",
                    "tool T{number} makes {count} holes; its drill is good for {left} more",
                    holes,
                    number=group.number,
                    left=left,
                ).at(path)
            )
    return warnings
