"""Jobs for another program: what is to be run, what it will take, and what a file holds."""

from collections.abc import Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.api.arguments import Whole, path_of, unexpected
from drillctl.api.machines import DEFAULT, library_of, machine_of
from drillctl.api.options import check_choice, setup_of
from drillctl.generation.drillfile import DrillFile, DrillFileError, read
from drillctl.generation.job import Job, names_of
from drillctl.generation.pcb_drill.board import refusal
from drillctl.generation.readers import load_job
from drillctl.jobs.estimate import estimate as estimate_of
from drillctl.kmd import parse_program
from drillctl.language import Message, Refusal
from drillctl.machine import Machine
from drillctl.replay.compare import Verdict, replay
from drillctl.viewmodel.records import Estimate

Source = str | PathLike[str] | Sequence[str] | NDArray[np.str_] | Job
MachineGiven = Machine | str | PathLike[str]


def job(source: Source, machine: MachineGiven = DEFAULT, *, tick_hz: Whole | None = None, **options: Any) -> Job:
    """Returns what is to be run, made for a machine.

    source   a file as ``drillctl run`` takes it (a path), or the commands themselves: a string each in a list or tuple,
             or a text that begins with ``KMD_`` or has several lines, a command each; or a job that was made before
    options  of a drill file, by the names of the command line: ``order="optimised"``, ``rotate=90``, ``offset=(5, 5)``,
             ``mirror="x"``, ``origin="file"``, ``peck=0.5``, ``skip_tools=(3,)``, ``pins=(3, "corners", 5)``,
             ``mill=True``, ``format="mm,3:3,leading"``

    ``job.program`` has the commands as a numpy record array, ``job.work`` the holes of a drill file: ``steps`` (n, 2)
    from the working base, ``hits.xy_mm`` (n, 2) in the file. Raises Refused with file, line and reason; OSError for a
    file that can't be opened.

    >>> import drillctl
    >>> len(drillctl.job(["KMD_GOTOdXdY 30 0", "KMD_GOTOdXdY -30 0"]).program)  # with the KMD_KONIEC that is added
    3
    """
    if isinstance(source, Job):
        return _as_made(source, machine, {**options, **({} if tick_hz is None else {"tick_hz": tick_hz})})
    wanted = machine_of(machine, tick_hz)
    commands = _commands(source)
    if commands is not None:
        if options:
            raise Refusal(Message("commands can't be placed and ordered: leave out {names}", names=", ".join(options)))
        return Job("commands", parse_program(commands, names_of(wanted), "commands"), wanted)
    return load_job(path_of(source, "source"), wanted, setup_of(wanted, options))


def estimate(
    source: Source, machine: MachineGiven = DEFAULT, *, tick_hz: Whole | None = None, **options: Any
) -> Estimate:
    """Returns how long a job takes on the ideal plant, to the tick: ``ticks``, ``tick_hz``, ``holes_total``,
    ``tools``, and ``fault`` where it would end in one. Arguments as of ``job``. Raises Refused.

    >>> import drillctl
    >>> drillctl.estimate(["KMD_GOTOdXdY 30 0"]).ticks
    52
    """
    return estimate_of(job(source, machine, tick_hz=tick_hz, **options))


def inspect(file: str | PathLike[str], *, format: str | None = None, after_end: str = "refuse") -> DrillFile:
    """Returns what a drill file holds: ``hole_xy_mm`` (n, 2), ``hole_tool`` (n,) indexes into ``tools``, ``slot_mm``
    (k, 4), ``format`` and with which ``confidence`` it was recognised, ``warnings``. Raises Refused with file and line,
    OSError for a file that can't be opened.
    """
    path = path_of(file)
    if not isinstance(format, str | None):
        raise unexpected("format", "str", format)
    check_choice("after_end", after_end)
    try:
        return read(path, fmt=format, after_end=after_end)
    except DrillFileError as error:
        raise refusal(path, error) from error


def replay_trace(file: str | PathLike[str], *, tables: str | PathLike[str] | None = None) -> Verdict:
    """Runs a recorded trace (``.trace``, ``.seg``) again and compares it: ``failed()``, ``headline()``,
    ``message()``, the first ``difference``. Raises Refused for a file that is no trace, or a machine that is not there.
    """
    return replay(path_of(file), library_of(tables))


def _as_made(made: Job, machine: MachineGiven, others: dict[str, Any]) -> Job:
    """A job that is there. Raises Refused for what would make another one of it."""
    if machine not in (DEFAULT, made.machine):
        others = {"machine": machine, **others}
    if others:
        names = ", ".join(others)
        raise Refusal(Message("the job is made already: give {names} to drillctl.job", names=names))
    return made


def _commands(source: object) -> str | None:
    """The commands as a text, a line each; None for a file. Raises Refused for what is neither."""
    if isinstance(source, str):
        return source if source.lstrip().startswith("KMD_") or "\n" in source else None
    if isinstance(source, bytes | PathLike):
        return None
    wanted = "a path, a text or a list of commands"
    if not isinstance(source, Sequence | np.ndarray):
        raise unexpected("source", wanted, source)
    for command in source:
        if not isinstance(command, str):
            raise unexpected("source", f"{wanted}, each a text", command)
    return "\n".join(source)
