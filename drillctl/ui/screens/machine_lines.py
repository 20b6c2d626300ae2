"""Phases and tools as lines of text: what is on stands in brackets. An axis may be live or at a tick of a run.

Rule: brackets always mean on. The column that is put out stands in them where the wire is on; where it is off, as
forcing is at rest whatever the table has there, between bars: ``|x|``.
"""

from typing import Protocol

from drillctl.language.words import _
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import ToolWanted


class Phases(Protocol):
    """The phases of an axis: AxisView and AxisMoment both are one."""

    @property
    def name(self) -> str:
        """The axis as the machine's file names it, such as x."""

    @property
    def column(self) -> int:
        """The column of the phase table that is put out, from 1."""

    @property
    def state(self) -> int:
        """The state of the ramp, signed."""

    @property
    def top_state(self) -> int:
        """The greatest state of the ramp."""

    @property
    def wires(self) -> tuple[tuple[str, str, bool], ...]:
        """For each wire its name, its row of the phase table in x and ., and whether it is on."""


def phase_line(axis: Phases) -> Line:
    """The phases of an axis in one line: column, ramp state, and its wires."""
    wires = [lamp(name, lit) for name, _row, lit in axis.wires]
    state = f"{axis.state:+{len(str(axis.top_state)) + 1}d}"  # as wide in every state
    return [("title", f"{axis.name.upper():2} "), f"{axis.column:2} {state} ", *wires]


def phase_table(axis: Phases) -> list[Line]:
    """The table as printed, a wire a line, the column that is put out in brackets or between bars."""
    top = _("column {column}, ramp {state} of {top}").format(
        column=axis.column, state=f"{axis.state:+d}", top=axis.top_state
    )
    return [[("title", f"{axis.name.upper():2} "), top], *(_wire_line(axis.column - 1, *wire) for wire in axis.wires)]


def lamp(name: str, lit: bool) -> tuple[str, str]:
    """A name as marked text, in brackets while it is on."""
    return ("lit", f"[{name}]") if lit else ("dark", f" {name} ")


def _wire_line(column: int, name: str, row: str, lit: bool) -> Line:
    before, cell, after = row[:column], row[column : column + 1], row[column + 1 :]
    name_cell = f"[{name}]" if lit else f" {name} "
    look, here = ("lit", f"[{cell}]") if lit else ("dark", f"|{cell}|")
    return [(look, f"   {name_cell:8}"), ("dark", before), (look, here), ("dark", after)]


def tool_name(tool: ToolWanted) -> str:
    """``T3, 1.000 mm``, and the drill at hand that serves it where it is of another diameter."""
    name = f"T{tool.number}"
    if tool.diameter_mm is not None:
        name += f", {tool.diameter_mm:.3f} mm"
    if tool.drill_mm is not None:
        name += _(", the drill of {diameter:.3f} mm").format(diameter=tool.drill_mm)
    return name
