"""The options of a job (reading, placing, order, drills) for the verbs that take a drill file; and the job made from
them.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import options, streams
from drillctl.cli.operating import waiting
from drillctl.files.inputs import real_path
from drillctl.language import Message
from drillctl.viewmodel.choices import AFTER_END, MIRRORED, MOST_ORDER_SECONDS, ORDERS, ORIGINS, PIN_PLACES

if TYPE_CHECKING:
    from drillctl.generation.alignment import Alignment
    from drillctl.generation.drillfile import DrillFile
    from drillctl.generation.job import Job
    from drillctl.generation.job_setup import JobSetup
    from drillctl.machine import Machine
    from drillctl.viewmodel.job_options import JobOptions, PinsOf

JOB_HELP = "a drill file, a queue of commands (.kmd), a part program (.sentences), or a workpiece (01..99)"


def add_job(verb: argparse.ArgumentParser) -> None:
    """Adds all options of a job to a verb, in two groups."""
    placing = verb.add_argument_group("placing the board")
    placing.add_argument(
        "--origin", choices=ORIGINS,
        help="base (default): lowest X and Y of the board at the working base; file: coordinates as they are",
    )  # fmt: skip
    placing.add_argument("--mirror", choices=MIRRORED, help="mirror for the bottom side: this axis changes sign")
    placing.add_argument("--rotate", type=float, default=0.0, metavar="DEG", help="turn the board counter-clockwise")
    placing.add_argument(
        "--offset", type=_pair, default=(0.0, 0.0), metavar="X,Y", help="shift the board in mm, after all else"
    )
    placing.add_argument("--align", type=Path, metavar="FILE", help="measured holes: file_x file_y machine_x machine_y")
    placing.add_argument("--panel", type=_panel, metavar="CxR:PX,PY", help="step and repeat, e.g. 3x2:40,30 (mm)")
    add_pins(placing)
    drilling = verb.add_argument_group("drilling")
    drilling.add_argument("--order", choices=ORDERS, default="file", help="order of each tool's holes")
    seconds = "let --order optimised look for a shorter way for S seconds at most; default: until none is found"
    drilling.add_argument("--order-seconds", type=_seconds, metavar="S", help=seconds)
    drilling.add_argument("--skip-tools", type=_numbers, default=frozenset(), metavar="N,N", help="tools not to drill")
    drilling.add_argument("--drills", type=Path, metavar="FILE", help="file of the drills at hand")
    drilling.add_argument("--peck", type=float, metavar="MM", help="drill in pecks of MM, retracting between them")
    drilling.add_argument("--spot", type=float, metavar="MM", help="first spot every hole of a tool, MM deep")
    add_mill(drilling)
    of_several = "spindles that drill, on a machine with several; default: all"
    drilling.add_argument("--spindles", type=_spindles, metavar="N,N", default=(), help=of_several)
    add_reading(drilling)
    add_store(verb)


def add_reading(verb: "argparse._ActionsContainer") -> None:
    """Adds the options that say how a drill file is read."""
    verb.add_argument("--format", metavar="F", help="read the drill file in this format, e.g. inch,2:4,leading")
    verb.add_argument(
        "--after-end", choices=AFTER_END, default="refuse",
        help="holes behind the end of the program (M30): refuse the file (default), leave them out, or drill them too",
    )  # fmt: skip


def add_pins(verb: "argparse._ActionsContainer") -> None:
    """Adds the option for registration pins to a verb: their diameter, and where they are."""
    where = (
        f"holes for registration pins of MM, so far outside the extent of all holes (default: 5 mm); WHERE: "
        f"{', '.join(PIN_PLACES)}. With --mirror they are there already: the board lies turned over on them"
    )
    verb.add_argument("--pins", type=_pins, metavar="MM[:WHERE[:MM]]", help=where)


def add_mill(verb: "argparse._ActionsContainer") -> None:
    """Adds the switch to a verb that has slots milled instead of drilled as holes in a row."""
    slots = (
        "mill slots, and straight cuts in rout mode, from end to end with the bit down: on a machine whose file says "
        "that it can, and in G-code; in an Excellon file such cuts become slots"
    )
    verb.add_argument("--mill", action="store_true", help=slots)


def read_drill_file(arguments: argparse.Namespace) -> "DrillFile":
    """Returns the drill file of a verb that reads it as it is, with the holes of ``--pins``, and straight cuts as slots
    by ``--mill``; shows how far it is.

    Raises JobError for a file that can't be read, PlacingError for pins.
    """
    from drillctl.generation.drillfile import DrillFileError, milled, read
    from drillctl.generation.waits import reading

    try:
        with waiting() as wait:
            advance = wait(reading(arguments.file.name))
            drill_file = read(arguments.file, fmt=arguments.format, after_end=arguments.after_end, advance=advance)
    except DrillFileError as error:
        from drillctl.generation.pcb_drill.board import refusal

        raise refusal(arguments.file, error) from error
    if arguments.mill:
        drill_file = milled(drill_file)
    if arguments.pins is None:
        return drill_file
    from drillctl.generation.pins import with_pins

    return with_pins(drill_file, arguments.pins).drill_file


def add_store(verb: argparse.ArgumentParser) -> None:
    """Adds ``--store`` to a verb."""
    where = "file of the RAM in which workpieces are looked up before the EPROM; default: the machine's own"
    verb.add_argument("--store", type=Path, metavar="FILE", help=where)


def job_setup(arguments: argparse.Namespace) -> "JobSetup":
    """Returns what the job is made by, as a journal keeps it, with absolute paths."""
    from drillctl.generation.job_setup import JobSetup

    machine = arguments.machine
    return JobSetup(
        machine=str(real_path(machine)) if machine.endswith(".toml") else machine,
        options=_job_options(arguments),
        tables=_absolute(arguments.tables),
        tick_hz=arguments.tick_hz,
    )


def _job_options(arguments: argparse.Namespace) -> "JobOptions":
    from drillctl.viewmodel.job_options import JobOptions, PanelOf

    return JobOptions(
        format=arguments.format,
        origin=arguments.origin,
        mirror=arguments.mirror,
        rotate_deg=arguments.rotate,
        offset_mm=arguments.offset,
        align=_absolute(arguments.align),
        panel=arguments.panel and PanelOf(*arguments.panel),
        pins=arguments.pins,
        mill=arguments.mill,
        order=arguments.order,
        order_seconds=arguments.order_seconds,
        skip_tools=tuple(sorted(arguments.skip_tools)),
        drills=_absolute(arguments.drills),
        peck_mm=arguments.peck,
        spot_mm=arguments.spot,
        after_end=arguments.after_end,
        store=_absolute(arguments.store),
        spindles=arguments.spindles,
    )


def _absolute(path: Path | None) -> str | None:
    return None if path is None else str(real_path(path))


def load(file: Path, chosen: "JobSetup", machine: "Machine") -> "Job":
    """Returns the job in a file, made by these options, and prints what the measured holes say. Raises JobError, also
    for options of a board beside a job that is none; PlacingError or AlignmentError.
    """
    from drillctl.generation.errors import JobError
    from drillctl.generation.readers import load_job

    if aligned := chosen.alignment():
        _show_alignment(aligned)
    with waiting() as wait:
        job = load_job(file, machine, chosen, wait)
    if job.work is None and (given := _board_options(chosen.options)):
        raise JobError(Message("only a drill file can be placed and ordered: leave out {options}",
                               options=" ".join(given)).at(file))  # fmt: skip
    return job


def _board_options(chosen: "JobOptions") -> list[str]:
    """Returns the options, as they are typed, that say how a board is read, placed and drilled."""
    from drillctl.viewmodel.job_options import JobOptions

    unset = JobOptions(store=chosen.store)
    names = zip(JobOptions.__struct_fields__, JobOptions.__struct_encode_fields__, strict=True)
    return [f"--{typed.replace('_', '-')}" for name, typed in names if getattr(chosen, name) != getattr(unset, name)]


def _show_alignment(alignment: "Alignment") -> None:
    """Prints what the measured holes say, and how well they agree, before anything is drilled."""
    from drillctl.generation.alignment import decompose

    parts = decompose(alignment.affine)
    residuals = " ".join(f"{residual_mm:.3f}" for residual_mm in alignment.residual_mm)
    print(
        f"drillctl: alignment ({alignment.kind}): turned {parts.turn_deg:.4f} deg, scale {parts.scale_x:.6f} "
        f"{parts.scale_y:.6f}, shear {parts.shear:.6f}; residuals {residuals} mm, RMS {alignment.rms_mm:.3f} mm, "
        f"{alignment.spare_holes} holes to spare, length error {alignment.length_error_mm:.3f} mm",
        file=sys.stderr,
    )
    for warning in alignment.warnings:
        streams.tell(f"warning: {warning}")


def _seconds(text: str) -> float:
    return options.number(text, 0.0, MOST_ORDER_SECONDS)


def _pair(text: str) -> tuple[float, float]:
    x, comma, y = text.partition(",")
    if not comma:
        raise argparse.ArgumentTypeError(f"{text!r} is not X,Y")
    return float(x), float(y)


def _numbers(text: str) -> frozenset[int]:
    return frozenset(int(part.upper().removeprefix("T")) for part in text.split(","))


def _spindles(text: str) -> tuple[int, ...]:
    numbers = sorted({int(part) for part in text.split(",")})
    if numbers[0] < 1:
        raise argparse.ArgumentTypeError("spindles are counted from 1")
    return tuple(numbers)


def _panel(text: str) -> tuple[int, int, float, float]:
    size, _, pitch = text.partition(":")
    columns, cross, rows = size.partition("x")
    if not cross:
        raise argparse.ArgumentTypeError(f"{text!r} is not COLUMNSxROWS:PITCH_X,PITCH_Y")
    return (int(columns), int(rows), *_pair(pitch))


def _pins(text: str) -> "PinsOf":
    from drillctl.viewmodel.job_options import PinsOf

    try:
        return PinsOf.typed(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


_pair.__name__, _numbers.__name__, _panel.__name__ = "X,Y", "list of tool numbers", "panel"
_spindles.__name__ = "list of spindles"
