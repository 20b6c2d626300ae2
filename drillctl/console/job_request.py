"""What a screen asks of a board, as options of a job and as a fit of measured holes.

Rule: ``options_of`` is the only place that knows which field of the request becomes which option.
"""

from drillctl.console.operator_state import Base
from drillctl.files.inputs import real_path
from drillctl.generation import alignment
from drillctl.generation.alignment import decompose
from drillctl.generation.job_options import JobOptions, MeasuredRow
from drillctl.generation.measured import AlignmentError
from drillctl.machine import Library, Machine
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.jobs import AlignmentReport, Asked, MeasuredHole


def options_of(asked: Asked, machine: Machine, base: Base) -> JobOptions:
    """The options of the screen as the command line has them, checked as it checks them: a list of recent jobs may hold
    anything. A board with measured holes is placed by these alone. Raises msgspec.ValidationError.
    """
    panel = asked.panel
    fields = {
        "machine": _reference(machine),
        "tick_hz": machine.tick_hz,
        "origin": None if asked.origin == "base" else asked.origin,
        "mirror": asked.mirror,
        "rotate": asked.rotate_deg,
        "offset": asked.offset_mm,
        "align": tuple(map(_row, asked.measured)) or None,
        "panel": (panel.columns, panel.rows, panel.pitch_x_mm, panel.pitch_y_mm) if panel else None,
        "order": asked.order,
        "skip_tools": tuple(sorted(asked.skip_tools)),
        "drills": asked.drills,
        "peck": asked.peck_mm,
        "spot": asked.spot_mm,
        "format": asked.format,
        "after_end": asked.after_end,
        "base": base,
    }
    return JobOptions.checked(fields)


def _reference(machine: Machine) -> str:
    """A machine's name where the standard library finds it by that, else its file."""
    file = real_path(machine.file)
    named = Library.standard().find("machines", machine.name)
    return machine.name if named is not None and real_path(named) == file else str(file)


def align(measured: tuple[MeasuredHole, ...], face_down: bool) -> tuple[AlignmentReport | None, Problems]:
    """Fits a placing to measured holes: the report, or None and the reasons why there is none."""
    rows = [_row(hole) for hole in measured]
    try:
        found = alignment.fit([row[:2] for row in rows], [row[2:] for row in rows], mirrored=face_down)
    except AlignmentError as error:
        return None, error.messages
    parts = decompose(found.affine)
    residual_mm = tuple(found.residual_mm.tolist())
    scale = (parts.scale_x, parts.scale_y)
    report = AlignmentReport(
        found.kind, found.affine.matrix, residual_mm, parts.turn_deg, scale, found.warnings, found.rejected
    )
    return report, ()


def _row(hole: MeasuredHole) -> MeasuredRow:
    return hole.file_x_mm, hole.file_y_mm, hole.machine_x_mm, hole.machine_y_mm
