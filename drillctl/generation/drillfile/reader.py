"""The way of a drill file: bytes -> text -> program -> format -> millimetres -> checks -> `DrillFile`.

Rule: either a whole `DrillFile` or a `DrillFileError`; nothing else is ever raised for what a file holds.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO

import numpy as np

from drillctl.files.inputs import opened
from drillctl.generation.waits import Advance, ignored

from . import checks, sidefiles
from .afterend import REFUSE
from .errors import Complaint, DrillFileError, Remark
from .facts import Facts
from .intake import condense, to_text
from .machine import Machine
from .model import MM_PER_UNIT, DrillFile, Floats, Tool
from .program import run
from .recognise import Recognition, dialect, parse_option, recognise
from .spacing import meetings


def read(path: Path, *, fmt: str | None = None, after_end: str = REFUSE, advance: Advance = ignored) -> DrillFile:
    """The drill file at path, with the reports beside it (sidefiles.py).

    fmt: format settled by hand, 'inch,2:4,leading' or 'mm,decimal'; after_end: what becomes of holes behind M30
    (afterend.CHOICES); advance: is called with how much of the text is read. DrillFileError for anything that is no
    drillable file; OSError when the file cannot be opened.
    """
    with opened(path) as stream:
        return _decode(stream, path.name, sidefiles.beside(path), fmt, after_end, advance)


def decode(
    data: bytes,
    *,
    name: str,
    side_files: Mapping[str, bytes] = {},
    fmt: str | None = None,
    after_end: str = REFUSE,
) -> DrillFile:
    """Like `read`, from bytes alone: name is used in messages, side_files are reports by name."""
    return _decode(io.BytesIO(data), name, side_files, fmt, after_end)


def _decode(
    stream: BinaryIO,
    name: str,
    side_files: Mapping[str, bytes],
    fmt: str | None,
    after_end: str,
    advance: Advance = ignored,
) -> DrillFile:
    try:
        option = parse_option(fmt) if fmt else None
        condensed = condense(stream)
        text, remarks = to_text(condensed)
    except Complaint as refusal:
        raise DrillFileError(name, (Remark(refusal.code, None, refusal.text),)) from None
    facts = Facts()
    for side_name, side_data in side_files.items():
        sidefiles.hear(side_name, side_data, facts)
    machine, problems = run(text, facts, after_end, advance)
    if problems:
        raise DrillFileError(name, tuple(problems))
    found = recognise(machine, option)
    named = replace(found.choice, dialect=dialect(machine, found.choice, tape_code=condensed.tape_code))
    return _measured(name, machine, replace(found, choice=named), remarks)


def _measured(name: str, machine: Machine, found: Recognition, remarks: list[Remark]) -> DrillFile:
    """The program's rows in millimetres, checked."""
    mm_per_unit = MM_PER_UNIT[found.choice.units]
    ends_mm = _ends_mm(machine, found)
    remarks = [*remarks, *checks.slots_without_length(machine, ends_mm)]
    if problems := tuple(checks.faults(machine, mm_per_unit, ends_mm)):
        raise DrillFileError(name, tuple(sorted(problems, key=lambda problem: problem.line or 0)))
    tools = machine.tools.finished(mm_per_unit) or (Tool(1, None),) * machine.toolless()
    return _checked(_assembled(name, machine, found, ends_mm, tools), machine, found, remarks)


def _ends_mm(machine: Machine, found: Recognition) -> Floats:
    """Both ends of every row (n, 2, 2); rows keep the units in force where they were written."""
    rows = machine.rows.array()
    return found.choice.lengths_mm(rows["at"], rows["mm"])


def _assembled(name: str, machine: Machine, found: Recognition, ends_mm: Floats, tools: tuple[Tool, ...]) -> DrillFile:
    rows = machine.rows.array()
    slot = rows["slot"]
    tool = np.maximum(rows["tool"], 0)  # a program without tools drills everything with the one it has
    return DrillFile(
        name=name,
        tools=tools,
        hole_xy_mm=np.ascontiguousarray(ends_mm[~slot, 0]),
        hole_tool=tool[~slot],
        hole_line=rows["line"][~slot],
        slot_mm=ends_mm[slot].reshape(-1, 4),
        slot_tool=tool[slot],
        slot_line=rows["line"][slot],
        slot_at=np.cumsum(~slot)[slot],
        routs=len(machine.router.cuts),
        format=found.choice,
        confidence=found.confidence,
        runner_up=found.runner_up,
        reason=found.reason,
        warnings=(),
        cuts=machine.router.measured(found.choice, slot),
    )


def _checked(drill_file: DrillFile, machine: Machine, found: Recognition, remarks: list[Remark]) -> DrillFile:
    """The same with its warnings."""
    diameter = np.array([tool.diameter_mm or 0.0 for tool in drill_file.tools] or [0.0])
    overlapping, duplicate = meetings(drill_file.hole_xy_mm, diameter[drill_file.hole_tool])
    mm_per_unit = MM_PER_UNIT[found.choice.units]
    warnings = [
        *remarks,
        *machine.facts.remarks,
        *machine.remarks,
        *found.remarks,
        *checks.number_warnings(machine),
        *checks.tool_warnings(machine, mm_per_unit),
        *checks.hole_warnings(overlapping, duplicate, drill_file.hole_line),
    ]
    return replace(drill_file, warnings=checks.first_ones(warnings))
