"""A phase table as a grid of cells: wires down, columns across, rows for motion backwards below where there are any;
and the bits that switch its wires, for each motor of a machine that uses it (paper, Table 1).

Rule: a grid never changes; every operation gives another one. In the text of a machine's file that new bits give, no
two wires share a bit.
"""

from collections.abc import Callable
from dataclasses import dataclass

from msgspec.structs import replace

from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.tables import FieldView, PhaseRow, TableEditing

ON, OFF = "x", "."
LEAST_COLUMNS = 2
Pattern = Callable[[str], str]


@dataclass(frozen=True, slots=True)
class GridLine:
    """A line of the grid: a wire's row, or its row for motion backwards."""

    name: str
    volts: float
    pattern: str
    backwards: bool


@dataclass(frozen=True, slots=True)
class PhaseGrid:
    """The rows of a phase table. Columns are counted from 0 here, from 1 on the screen."""

    rows: tuple[PhaseRow, ...]

    @property
    def columns(self) -> int:
        """The length of the longest row: a table being edited elsewhere may have uneven ones."""
        return max((len(row.pattern) for row in self.rows), default=0)

    @property
    def has_reverse(self) -> bool:
        """Whether motion backwards has rows of its own."""
        return any(row.reverse is not None for row in self.rows)

    @property
    def lines(self) -> tuple[GridLine, ...]:
        """The lines from top to bottom: every wire, then the rows for motion backwards."""
        forward = [GridLine(row.name, row.volts, row.pattern, False) for row in self.rows]
        back = [GridLine(row.name, row.volts, row.reverse, True) for row in self.rows if row.reverse is not None]
        return (*forward, *back)

    def toggle(self, line: int, column: int) -> "PhaseGrid":
        """The grid with one cell turned over; the same grid for a cell that does not exist."""
        lines = self.lines
        if not 0 <= line < len(lines) or not 0 <= column < len(lines[line].pattern):
            return self
        pattern = lines[line].pattern
        other = OFF if pattern[column] == ON else ON
        return self._with(lines[line], f"{pattern[:column]}{other}{pattern[column + 1 :]}")

    def insert(self, column: int) -> "PhaseGrid":
        """The grid with the column twice: the rotor is held there a tick longer, until its cells are toggled."""
        return self._each(lambda pattern: pattern[: column + 1] + pattern[column:])

    def remove(self, column: int) -> "PhaseGrid":
        """The grid without the column; the last two columns can't be removed."""
        if self.columns <= LEAST_COLUMNS:
            return self
        return self._each(lambda pattern: pattern[:column] + pattern[column + 1 :])

    def mirrored(self) -> "PhaseGrid":
        """With rows for motion backwards in which forcing comes first there too.

        A table is played backwards as it stands, so forcing that opens a phase forwards closes it backwards. Here the
        forcing wires (above the lowest voltage) are mirrored within every stretch of columns in which the other wires
        stay as they are.
        """
        if len({len(row.pattern) for row in self.rows}) != 1:
            return self  # rows of different lengths are no table yet
        lowest = min(row.volts for row in self.rows)
        stretches = self._stretches([row.pattern for row in self.rows if row.volts <= lowest])
        return PhaseGrid(
            tuple(
                replace(row, reverse=_mirrored(row.pattern, stretches) if row.volts > lowest else row.pattern)
                for row in self.rows
            )
        )

    def without_reverse(self) -> "PhaseGrid":
        """The grid without rows for motion backwards: the forward rows are played backwards."""
        return PhaseGrid(tuple(replace(row, reverse=None) for row in self.rows))

    def _stretches(self, patterns: list[str]) -> list[list[int]]:
        """The columns of each stretch in which these rows don't change; the last may go on at the first column."""
        columns = list(zip(*patterns, strict=True))
        count = len(columns)
        starts = [column for column in range(count) if columns[column] != columns[column - 1]] or [0]
        ends = [*starts[1:], starts[0] + count]
        return [[c % count for c in range(start, end)] for start, end in zip(starts, ends, strict=True) if count]

    def _each(self, change: Pattern) -> "PhaseGrid":
        return PhaseGrid(
            tuple(
                replace(row, pattern=change(row.pattern), reverse=None if row.reverse is None else change(row.reverse))
                for row in self.rows
            )
        )

    def _with(self, line: GridLine, pattern: str) -> "PhaseGrid":
        def changed(row: PhaseRow) -> PhaseRow:
            return replace(row, reverse=pattern) if line.backwards else replace(row, pattern=pattern)

        return PhaseGrid(tuple(changed(row) if row.name == line.name else row for row in self.rows))


def _mirrored(pattern: str, stretches: list[list[int]]) -> str:
    marks = list(pattern)
    for stretch in stretches:
        for column, opposite in zip(stretch, reversed(stretch), strict=True):
            marks[column] = pattern[opposite]
    return "".join(marks)


class WireBits:
    """``motors`` are the axes that use the phase table, in the order of the machine's file; none for no machine."""

    def __init__(self, tables: TableEditing, text: str, phase: str):
        self._tables, self._text = tables, text
        self._wires = {str(wire.place[-1]): wire for wire in tables.wires(text)}
        fields = tables.fields(text)
        self.motors = tuple(field.axis for field in fields if field.place[-1] == "phase" and field.value == phase)

    def of(self, axis: str, wire: str) -> FieldView | None:
        """The field of a motor's wire; None where the machine has no wire of this name."""
        return self._wires.get(f"{axis}.{wire}")

    def taken_by(self, typed: str, wire: FieldView) -> FieldView | None:
        """The other wire that a bit switches already; None for a free bit, and for what is no number."""
        bit = typed.strip()
        return next((other for other in self._wires.values() if other.value == bit and other != wire), None)

    def with_bit(self, wire: FieldView, typed: str, taken: FieldView | None) -> tuple[str, Problems]:
        """The machine's text with the new bit, and ``taken``, where given, on the old one; or as it was, with why."""
        text, problems = self._tables.with_field(self._text, wire.place, typed)
        if problems or taken is None:
            return (self._text if problems else text), problems
        exchanged, problems = self._tables.with_field(text, taken.place, wire.value)
        return (self._text if problems else exchanged), problems
