"""Reads the holes CSV of a run (``--holes``): where each hole was wanted and made, its tool and diameter.

Rule: columns are found by their names, so that further ones do no harm. What is no number is refused with its line.
"""

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.files.inputs import read_bytes
from drillctl.lab.errors import LabError
from drillctl.language import Message
from drillctl.viewmodel.reports import BoardPlan

LARGEST_BYTES = 16 * 2**20  # some 250,000 rows
MOST_TOOL = 10**9
NAMES = ("tool", "diameter_mm", "x_mm", "y_mm", "wanted_x_mm", "wanted_y_mm")


def read_holes(file: Path) -> BoardPlan:
    """The holes of a run, in mm of the drill file; a queue wants its holes where it made them. Raises LabError for a
    file that is no holes CSV, or has no holes; OSError.
    """
    text = read_bytes(file, LARGEST_BYTES, Message("a holes CSV")).decode("utf-8", "replace")
    rows = csv.DictReader(text.splitlines())
    try:
        if missing := [name for name in NAMES if name not in (rows.fieldnames or ())]:
            raise LabError(Message("is no holes CSV: column {name} is missing", name=missing[0]).at(file, 1))
        found = np.array([_numbers(row, file, line) for line, row in enumerate(rows, 2)]).reshape(-1, len(NAMES))
    except csv.Error as error:
        raise LabError(Message("not a row of a holes CSV: {reason}", reason=error).at(file, rows.line_num)) from error
    if not len(found):
        raise LabError(Message("has no hole to be shown").at(file))
    made = found[:, 2:4]
    wanted = np.where(np.isfinite(found[:, 4:6]), found[:, 4:6], made)
    return BoardPlan(wanted, made, found[:, 1], found[:, 0].astype(np.int64))


def diameters(holes: BoardPlan) -> dict[int, float]:
    """The diameter of each tool, in mm, as far as they are known."""
    return {tool.number: tool.diameter_mm for tool in holes.tools if tool.diameter_mm is not None}


def with_diameters(holes: BoardPlan, by_tool: dict[int, float]) -> BoardPlan:
    """The same holes with the diameters of their tools."""
    known: NDArray[np.float64] = np.array([by_tool.get(tool, np.nan) for tool in holes.tool.tolist()], np.float64)
    return BoardPlan(holes.sent_mm, holes.made_mm, known, holes.tool)


def _numbers(row: "dict[str, str | None]", file: Path, line: int) -> list[float]:
    """The values of NAMES; an empty one is not a number. Tool and place made must be there, a diameter is none or more
    than nothing.
    """
    try:
        found = [float(row[name] or "nan") for name in NAMES]
    except ValueError as error:
        raise LabError(Message("not a row of a holes CSV: {reason}", reason=error).at(file, line)) from error
    if not (0 <= found[0] <= MOST_TOOL and np.isfinite(found[2:4]).all()) or found[1] <= 0:
        raise LabError(Message("a hole without tool or place, or of no width").at(file, line))
    return found
