"""The ramp of one axis of a machine's file, and its exact scale: by the ramp's name, or from the axis's parameters.

Rule: parameters that make no ramp, and a scale that they contradict, are errors at their line.
"""

from fractions import Fraction

from drillctl.language import Message
from drillctl.machine.drive_ramp import FROM_PARAMETERS, drive_ramp, pulses_per_mm
from drillctl.machine.model import MM_PER_INCH
from drillctl.machine.parameters import Parameters
from drillctl.machine.parts import Parts
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_formula import FormulaError
from drillctl.machine.shape import AxisRow, MachineFile
from drillctl.machine.source import Source


def ramp_and_scale(
    source: Source, raw: MachineFile, index: int, parts: Parts, parameters: Parameters | None
) -> tuple[RampTable, Fraction | None]:
    """Returns the ramp of the axis ``index``, and its pulses per millimetre where they follow from parameters. Raises
    TableError.
    """
    row, place = raw.axis[index], ("axis", index, "ramp")
    if row.ramp != FROM_PARAMETERS:
        return parts.ramp(row.ramp, (raw.tick_hz, MM_PER_INCH / row.columns_per_inch), source, place), None
    if parameters is None:
        reason = Message("axis {name}: no ramp is named, and the file has no [parameters]", name=row.name)
        raise source.error(reason, *place)
    entered = parameters.of_axis(row.name)
    scale = pulses_per_mm(entered)
    if scale is not None:
        _check_scale(source, row, index, scale)
    try:
        return drive_ramp(entered, raw.tick_hz, row.columns_per_step), scale
    except FormulaError as error:
        at = ("parameters", "axis", row.name)
        raise source.error(error.reason.at(".".join(at)), *at, error.key) from error


def _check_scale(source: Source, row: AxisRow, index: int, scale: Fraction) -> None:
    exact = scale * row.columns_per_step * Fraction(str(MM_PER_INCH))
    if abs(exact - row.columns_per_inch) > Fraction(1, 2):
        reason = Message(
            "axis {name}: columns_per_inch {given}, and pulse equivalent and gear make it {exact}",
            name=row.name,
            given=row.columns_per_inch,
            exact=f"{float(exact):.6g}",
        )
        raise source.error(reason, "axis", index, "columns_per_inch")
