"""Options of the verbs that take a drill file to a job: placing, order, drills; and what they stand for."""

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from drillctl.generation.alignment import Alignment
    from drillctl.generation.placing import Panel, Placing
    from drillctl.generation.wishes import Wishes


def add_job(verb: argparse.ArgumentParser) -> None:
    """The options of a job, in two groups."""
    placing = verb.add_argument_group("placing the board")
    placing.add_argument(
        "--origin", choices=("base", "file"),
        help="base (default): lowest X and Y of the board at the working base; file: coordinates as they are",
    )  # fmt: skip
    placing.add_argument("--mirror", choices=("x", "y"), help="for the bottom side: this axis changes sign")
    placing.add_argument("--rotate", type=float, default=0.0, metavar="DEG", help="counter-clockwise")
    placing.add_argument("--offset", type=_pair, default=(0.0, 0.0), metavar="X,Y", help="mm, added last")
    placing.add_argument("--align", type=Path, metavar="FILE", help="measured holes: file_x file_y machine_x machine_y")
    placing.add_argument("--panel", type=_panel, metavar="CxR:PX,PY", help="step and repeat, e.g. 3x2:40,30 (mm)")
    drilling = verb.add_argument_group("drilling")
    orders = ("file", "nearest", "optimised")
    drilling.add_argument("--order", choices=orders, default="file", help="of the holes of a tool")
    drilling.add_argument("--skip-tools", type=_numbers, default=frozenset(), metavar="N,N", help="tools not to drill")
    drilling.add_argument("--drills", type=Path, metavar="FILE", help="the drills at hand, with tolerances and lives")
    drilling.add_argument("--peck", type=float, metavar="MM", help="in steps of so much, drawn out between them")
    drilling.add_argument("--spot", type=float, metavar="MM", help="first mark every hole of a tool so deep")
    drilling.add_argument("--format", metavar="F", help="settle the drill file's format, e.g. inch,2:4,leading")


def wishes(arguments: argparse.Namespace) -> "Wishes":
    """What was asked for. Raises JobError, PlacingError or AlignmentError."""
    from drillctl.generation.drills import read_drills
    from drillctl.generation.wishes import Wishes

    drills = read_drills(arguments.drills) if arguments.drills else None
    return Wishes(
        _placing(arguments), arguments.order, arguments.skip_tools, drills, arguments.peck, arguments.spot
    )


AS_GIVEN = (
    "machine", "tables", "tick_hz", "origin", "mirror", "rotate", "offset", "align", "panel", "order", "skip_tools",
    "drills", "peck", "spot", "format",
)  # fmt: skip
PATHS = ("tables", "align", "drills")


def as_given(arguments: argparse.Namespace) -> dict[str, Any]:
    """The options that make a job, as plain values for its journal; paths are made absolute."""
    told = {name: getattr(arguments, name) for name in AS_GIVEN}
    told["skip_tools"] = sorted(told["skip_tools"])
    if told["machine"].endswith(".toml"):
        told["machine"] = str(Path(told["machine"]).resolve())
    return {name: str(value.resolve()) if isinstance(value, Path) else value for name, value in told.items()}


def given_again(told: Mapping[str, Any]) -> argparse.Namespace:
    """The options of a journal as arguments. Raises JobError for a journal of another version."""
    from drillctl.generation.errors import JobError

    if set(told) != set(AS_GIVEN):
        raise JobError(["the journal was written by another version of this program"])
    arguments = argparse.Namespace(**told)
    arguments.skip_tools = frozenset(told["skip_tools"])
    arguments.offset, arguments.panel = tuple(told["offset"]), told["panel"] and tuple(told["panel"])
    for name in PATHS:
        setattr(arguments, name, Path(told[name]) if told[name] else None)
    return arguments


def _placing(arguments: argparse.Namespace) -> "Placing":
    from drillctl.generation.alignment import load
    from drillctl.generation.placing import Placing

    alignment = load(arguments.align, mirrored=arguments.mirror is not None) if arguments.align else None
    if alignment is not None:
        _show_alignment(alignment)
    return Placing(
        origin=arguments.origin,
        mirror=None if alignment else arguments.mirror,
        rotate_deg=arguments.rotate,
        offset_mm=arguments.offset,
        panel=_panel_of(arguments.panel),
        alignment=alignment.affine if alignment else None,
    )


def _show_alignment(alignment: "Alignment") -> None:
    """What the measured holes say, and how well they agree, before anything is drilled by them."""
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
        print(f"drillctl: warning: {warning}", file=sys.stderr)


def _panel_of(given: "tuple[int, int, float, float] | None") -> "Panel | None":
    from drillctl.generation.placing import Panel

    return None if given is None else Panel(*given)


def _pair(text: str) -> tuple[float, float]:
    x, comma, y = text.partition(",")
    if not comma:
        raise argparse.ArgumentTypeError(f"{text!r} is not X,Y")
    return float(x), float(y)


def _numbers(text: str) -> frozenset[int]:
    return frozenset(int(part.upper().removeprefix("T")) for part in text.split(","))


def _panel(text: str) -> tuple[int, int, float, float]:
    size, _, pitch = text.partition(":")
    columns, cross, rows = size.partition("x")
    if not cross:
        raise argparse.ArgumentTypeError(f"{text!r} is not COLUMNSxROWS:PITCH_X,PITCH_Y")
    return (int(columns), int(rows), *_pair(pitch))


_pair.__name__, _numbers.__name__, _panel.__name__ = "X,Y", "list of tool numbers", "panel"
