"""A board as G-code for other machines: metric, absolute, one drilling move a line, pecks written out, a stop or a
change for each tool. What a hobby mill with Grbl, or one with LinuxCNC, takes.

Rule: only words that both know stand in a program (G0 G1 G21 G90 G94 M0 M2 M3 M5 and comments); what differs is a row
of STYLES. Heights count from the board's surface (Z0), depths are those of the machine that the job was made for.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.job import Job
from drillctl.generation.pcb_drill.strokes import CHIP_CLEARANCE_MM, depth_mm
from drillctl.generation.worklist import Group, WorkList, placed_mm
from drillctl.language import Message, Refusal, one_line
from drillctl.machine import Machine

SAFE_MM = 5.0  # above the board: between tools
TRAVEL_MM = 2.0  # above the board: between holes
SECONDS_PER_MINUTE = 60
DEFAULT_REV_MIN = 10_000
DEFAULT_MILL_MM_MIN = 120.0  # of slots, where the machine's file names none: a small cutter in 1.6 mm FR-4
Floats = NDArray[np.float64]


class Style(NamedTuple):
    """How a control wants its programs: what stands before and after, and how it asks for a tool."""

    head: tuple[str, ...]
    tool: tuple[str, ...]  # lines with {number} and {told}
    end: tuple[str, ...]


STYLES = {
    # Grbl 1.1 knows no T and no M6: it stops, and goes on by a cycle start once the tool is in.
    "grbl": Style(("G21", "G90", "G94"), ("M5", "({told})", "M0"), ("M5", "M2")),
    # LinuxCNC changes tools by T and M6, and takes their lengths from its own table.
    "linuxcnc": Style(
        ("G21", "G90", "G94", "G17", "G40", "G49", "G80"),
        ("M5", "({told})", "T{number} M6", "G43"),
        ("M5", "M2"),
    ),
}


class GcodeRefused(Refusal):
    """What can't be written as G-code."""

    kind = "job"


def gcode(job: Job, style: str, rev_min: int, peck_mm: float | None, spot_mm: float | None) -> Iterator[str]:
    """Yields the lines of a board's program. Raises GcodeRefused for a job that is no board, or a style that is
    none.
    """
    if job.work is None:
        raise GcodeRefused(Message("only a drill file can be written as G-code").at(job.name))
    if style not in STYLES:
        styles = ", ".join(STYLES)
        raise GcodeRefused(Message("no style {style!r} of G-code; there are {styles}", style=style, styles=styles))
    form, feed = STYLES[style], _feed_mm_min(job.machine)
    mill = job.machine.mill_mm_min or DEFAULT_MILL_MM_MIN
    depths = _depths(job.machine, peck_mm)
    yield f"({_comment(job.name)}: {len(job.work.steps)} holes, mm from the working base)"
    yield from form.head
    yield f"G0 Z{SAFE_MM:g}"
    for group in job.work.groups:
        yield from (line.format(number=group.number, told=_told(group)) for line in form.tool)
        yield f"M3 S{rev_min}"
        begun, ends = (places_mm(job.work, group, of) for of in (job.work.hits.xy_mm, job.work.hits.end_mm))
        if spot_mm is not None:
            yield from _holes(begun, begun, (spot_mm,), feed, mill)
        yield from _holes(begun, ends, depths, feed, mill)
        yield f"G0 Z{SAFE_MM:g}"
    yield "G0 X0 Y0"
    yield from form.end


def places_mm(work: WorkList, group: Group, of_mm: Floats) -> Floats:
    """Returns places of a tool's holes, of all holes (n, 2) in the file's millimetres, in millimetres from the working
    base, in drilling order.
    """
    return placed_mm(work.boards, work.hits, of_mm)[group.start : group.stop]


def _holes(
    begun: Floats, ends: Floats, depths_mm: tuple[float, ...], feed_mm_min: float, mill_mm_min: float
) -> Iterator[str]:
    """Each hole in so many pecks; between two of them the bit comes out to throw its chips. A slot in as many passes,
    each but the last there and back.
    """
    for (x_mm, y_mm), end_mm in zip(begun.tolist(), ends.tolist(), strict=True):
        there, back = f"X{_number(end_mm[0])} Y{_number(end_mm[1])}", f"X{_number(x_mm)} Y{_number(y_mm)}"
        yield f"G0 {back}"
        yield f"G0 Z{TRAVEL_MM:g}"
        for number, depth in enumerate(depths_mm, 1):
            last = number == len(depths_mm)
            yield f"G1 Z{_number(-depth)} F{_number(feed_mm_min)}"
            if there != back:
                yield f"G1 {there} F{_number(mill_mm_min)}"
                yield f"G0 Z{TRAVEL_MM:g}" if last else f"G1 {back} F{_number(mill_mm_min)}"
            else:
                yield f"G0 Z{TRAVEL_MM if last else CHIP_CLEARANCE_MM:g}"


def _depths(machine: Machine, peck_mm: float | None) -> tuple[float, ...]:
    """The depth of each peck; without pecks the whole depth."""
    whole = depth_mm(machine, machine.drill_axes[0])
    if peck_mm is None:
        return (whole,)
    return (*(number * peck_mm for number in range(1, int(np.ceil(whole / peck_mm)))), whole)


def _feed_mm_min(machine: Machine) -> float:
    """The speed at which the machine's own head drills: a column each shortest interval of its ramp."""
    head = machine.axes[machine.drill_axes[0]]
    steps_a_second = machine.tick_hz / (min(head.ramp.interval) * head.columns_per_step)
    return steps_a_second / head.steps_per_mm * SECONDS_PER_MINUTE


def _told(group: Group) -> str:
    size = "" if group.diameter_mm is None else f", {group.diameter_mm:g} mm"
    return f"put in T{group.number}{size}: {group.stop - group.start} holes"


def _comment(text: str) -> str:
    """In a comment no bracket may stand, and nothing but ASCII."""
    shown = one_line(text).encode("ascii", "replace").decode()
    return shown.translate(str.maketrans("()", "[]"))


def _number(value: float) -> str:
    """Four decimals, which is a tenth of a micrometre; no minus before nothing."""
    shown = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if shown in ("-0", "") else shown
