"""The holes CSV of ``--holes`` (docs/SPEC.md, section 3): a row for each hole that the simulated machine made.

Rule: columns are only ever added at the end, so that whoever reads them by their places goes on reading them. A value
that there is not stays empty.
"""

from collections.abc import Iterator
from math import hypot
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drillctl.files.outputs import Output
    from drillctl.generation.job import Job, MadeHole
    from drillctl.jobs.outcome import JobResult

MADE = ("tool", "diameter_mm", "x_mm", "y_mm")
WANTED = ("number", "wanted_x_mm", "wanted_y_mm", "error_mm")


def write_holes(job: "Job", done: "JobResult", output: "Output | None") -> None:
    """Writes the holes of a job that was run, where ``--holes`` was given."""
    if output is not None:
        output.write(lambda file: file.writelines(_lines(job, done)))


def _lines(job: "Job", done: "JobResult") -> Iterator[str]:
    """Yields the lines; the column ``spindle`` is left out where the machine has one."""
    several = len(job.machine.drill_axes) > 1
    yield ",".join((*MADE, *(["spindle"] if several else []), *WANTED)) + "\n"
    for hole in done.holes:
        diameter = "" if hole.diameter_mm is None else f"{hole.diameter_mm:.4f}"
        by = f",{hole.spindle}" if several else ""
        yield f"{hole.tool},{diameter},{hole.x_mm:.4f},{hole.y_mm:.4f}{by},{_wanted(job, hole)}\n"


def _wanted(job: "Job", hole: "MadeHole") -> str:
    """Number, place in the file and distance from it; nothing where the job wants no hole at a place, as a queue."""
    if job.work is None or not hole.number:
        return ",,,"
    x_mm, y_mm = job.file_place(hole.number)
    return f"{hole.number},{x_mm:.4f},{y_mm:.4f},{hypot(hole.x_mm - x_mm, hole.y_mm - y_mm):.4f}"
