"""What a screen asks of a board: its options for the machine in use, and the fit of measured holes."""

from drillctl.console.operator_state import Base
from drillctl.files.inputs import real_path
from drillctl.generation import alignment
from drillctl.generation.alignment import decompose
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.measured import AlignmentError
from drillctl.machine import Library, Machine
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole
from drillctl.viewmodel.jobs import AlignmentReport


def setup_of(options: JobOptions, machine: Machine, base: Base) -> JobSetup:
    """What the job is made by on this machine, from this working base. Raises msgspec.ValidationError for options that
    the command line would not take.
    """
    setup = JobSetup(_reference(machine), options, tick_hz=machine.tick_hz, base=base)
    return JobSetup.checked(setup.as_journalled())


def _reference(machine: Machine) -> str:
    """A machine's name where the standard library finds it by that, else its file."""
    file = real_path(machine.file)
    named = Library.standard().find("machines", machine.name)
    return machine.name if named is not None and real_path(named) == file else str(file)


def align(measured: tuple[MeasuredHole, ...], face_down: bool) -> tuple[AlignmentReport | None, Problems]:
    """Fits a placing to measured holes: the report, or None and the reasons why there is none."""
    try:
        found = alignment.fit([hole[:2] for hole in measured], [hole[2:] for hole in measured], mirrored=face_down)
    except AlignmentError as error:
        return None, error.messages
    parts = decompose(found.affine)
    residual_mm = tuple(found.residual_mm.tolist())
    scale = (parts.scale_x, parts.scale_y)
    report = AlignmentReport(
        found.kind, found.affine.matrix, residual_mm, parts.turn_deg, scale, found.warnings, found.rejected
    )
    return report, ()
