"""``--board FILE`` of the verbs that try machines: a board to be drilled by each, in place of single moves."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import jobs
from drillctl.language import Message

if TYPE_CHECKING:
    from collections.abc import Sequence

    from drillctl.lab.board import Board
    from drillctl.machine import Machine


def add_board(verb: argparse.ArgumentParser) -> None:
    """Adds ``--board`` and the options of a job to a verb."""
    verb.add_argument("--board", type=Path, metavar="FILE", help="drill this board, whole, in place of single moves")
    jobs.add_job(verb)


def varied_axes(arguments: argparse.Namespace, machine: "Machine") -> tuple[int, ...]:
    """Returns the axis of ``--axis``, else those that carry the board. Raises LabError."""
    from drillctl.lab.dynamic_rerun import plane_of
    from drillctl.lab.errors import LabError
    from drillctl.lab.tables import axis_index

    axes = (axis_index(machine, arguments.axis),) if arguments.axis else plane_of(machine)
    if not axes:
        raise LabError(Message("no axis positions a board on {machine}", machine=machine.name))
    return axes


def board_of(
    arguments: argparse.Namespace, machine: "Machine", axes: "Sequence[int]", rates_hz: "Sequence[int]"
) -> "Board":
    """Returns the board of ``--board``, made into a program for each tick rate by the machine's own tables. Raises what
    ``run`` raises for such a job, and LabError for one that drills nothing.
    """
    from drillctl.lab.board import Board

    setup = jobs.job_setup(_without_rate(arguments))
    programs = {hz: jobs.load(arguments.board, setup, machine.at_rate(hz)).program for hz in rates_hz}
    return Board.of(arguments.board.name, machine, axes, programs)


def check_only_with_board(arguments: argparse.Namespace) -> None:
    """Raises LabError for options of a job where no board was given."""
    from drillctl.lab.errors import LabError
    from drillctl.viewmodel.job_options import JobOptions

    if arguments.board is None and jobs.job_setup(_without_rate(arguments)).options != JobOptions():
        raise LabError(Message("options of a job say how a board is drilled: name one by --board FILE"))


def _without_rate(arguments: argparse.Namespace) -> argparse.Namespace:
    return argparse.Namespace(**{**vars(arguments), "tick_hz": None})
