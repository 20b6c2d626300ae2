"""The drilling machine a file programs: modal state, and what each order does to it.

Rule: positions are number triples (numbers.py), never millimetres; nothing here knows the format.
commands.py translates words into calls of these methods, program.py hands over whole runs of holes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .cuts import Router
from .errors import Complaint, Remark
from .facts import Fact, Facts, Voice
from .model import MM_PER_UNIT, Floats
from .numbers import Evidence, read_numbers
from .rows import ROW, Rows
from .tools import NO_TOOL, Toolbox

AXES = "XY"


class Machine:
    """State while a program runs. line is the source line being executed, set by program.py."""

    def __init__(self, facts: Facts) -> None:
        self.facts = facts
        self.rows = Rows()
        self.evidence = Evidence()
        self.tools = Toolbox(facts)
        self.remarks: list[Remark] = []
        self.line = 0
        self.at: Floats = np.zeros((2, 3))
        self.mm = 0.0  # millimetres per unit in force, 0 while undeclared
        self.headers = 0
        self.in_header = self.routing = self.cutting = self.incremental = False
        self.recognised = self.ended = self.stopped = False
        self.format_one = self.delete_blocks = self.in_message = False
        self.tool_in_rout = False  # a tool was chosen in rout mode: is the next bare coordinate line a hole?
        self.displaced = False  # a stop or a copied pattern left the table elsewhere than the last coordinates say
        self.ici: bool | None = None  # what the header says of incremental input
        self.zero: dict[str, float] = {}  # the last G92 or G93
        self.router = Router()

    @property
    def drilling(self) -> bool:
        """Whether a plain coordinate line is a hole."""
        return not (self.in_header or self.routing or self.ended or self.in_message)

    def remark(self, code: str, text: str = "") -> None:
        """A warning about the current line."""
        self.remarks.append(Remark(code, self.line, text))

    # -- header -----------------------------------------------------------------------------------

    def begin_header(self) -> None:
        """M48. A second one inside the program is two files in a row, or an old program's habit."""
        if self.headers and len(self.rows):
            self.remark("second-header", "M48")
        self.headers += 1
        self.in_header, self.routing = True, False

    def begin_next_program(self) -> None:
        """After M30, where a person asks for what follows too: a machine as if switched on, its holes kept."""
        self.ended = self.stopped = self.routing = self.cutting = self.incremental = self.displaced = False
        self.format_one = self.delete_blocks = self.tool_in_rout = False
        self.router.arc = self.router.compensated = False
        self.ici, self.zero = None, {}
        self.at = np.zeros((2, 3))
        self.tools.current = NO_TOOL

    def end_header(self) -> None:
        """Ends the header, at a line of ``%`` or ``M95``."""
        self.in_header = False

    def set_units(self, units: str, source: str) -> None:
        """INCH, METRIC, M71, M72: in force for coordinates from here on."""
        mm = MM_PER_UNIT[units]
        if self.mm and mm != self.mm:
            if self.in_header and self.headers < 2:
                raise Complaint("contradictory-units", source)
            self.remark("units-change-in-body", source)
            self.at *= self.facts.carried(_units_of(self.mm), units)
            if not len(self.rows):
                self.facts.replace_units(Fact(units, Voice.HEADER, self.line, source))
        else:
            self.facts.declare_units(Fact(units, Voice.HEADER, self.line, source))
        self.mm = mm

    def select(self, number: int) -> None:
        """Takes the tool of a T in the body as the one in hand."""
        self.tools.select(number, self.line)
        self.tool_in_rout = self.routing

    # -- motion -----------------------------------------------------------------------------------

    def move_or_drill(self, axes: Mapping[str, str]) -> None:
        """A line of coordinates alone: a hole, or in rout mode a way. Complaint where a tool change leaves it open."""
        if self.tool_in_rout:
            raise Complaint("rout-or-hole", "".join(axis + number for axis, number in axes.items()))
        if self.routing and not self.cutting:
            self.remark("rout-move")
        self.move(axes)

    def move(self, axes: Mapping[str, str]) -> None:
        """A coordinate line: a hole in drill mode, a travel of the router otherwise."""
        if not self.routing:
            self.drill(_columns(axes))
            return
        start = self.at.copy()
        for index, column in enumerate(_columns(axes)):
            self.at[index] = self._positions(column, self.at[index])[-1]
        if self.cutting:
            self.router.go(start, self.at.copy(), self.mm, self.tools.current, self.line, len(self.rows))

    def slot(self, start: Mapping[str, str], end: Mapping[str, str]) -> None:
        """G85: a slot from the line's first point (or where the machine stands) to its second."""
        self.drill([*_columns(start), *_columns(end)])

    def drill(self, columns: Sequence[Sequence[str]]) -> None:
        """Holes and slots of consecutive lines: the numbers of x and y, or of x, y, x, y where some are slots.

        '' is an axis not written. A row's two ends are two moves; a hole's second one moves nothing.
        """
        self._prepare(columns)
        lines = len(columns[0])
        self.rows.check_room(lines)
        block = np.zeros(lines, ROW)
        for axis in range(len(AXES)):
            ends = columns[axis :: len(AXES)]
            words = ends[0] if len(ends) == 1 else [word for pair in zip(*ends, strict=True) for word in pair]
            positions = self._positions(words, self.at[axis])
            block["at"][:, :, axis] = positions.reshape(lines, len(ends), 3)
        if len(columns) > len(AXES):
            block["slot"] = [bool(x or y) for x, y in zip(*columns[len(AXES) :], strict=True)]
        block["mm"], block["tool"] = self.mm, self.tools.current
        block["line"] = np.arange(self.line, self.line + lines)
        self.rows.append(block)
        self.at = block["at"][-1, 1].copy()

    def repeat(self, count: int, axes: Mapping[str, str]) -> None:
        """R: the last hole again, count times, each the same distance further.

        Complaint where the table, the mode or the tool is no longer that of the last hole.
        """
        if self.routing or self.displaced or self.rows.last_tool() != self.tools.current:
            raise Complaint("repeat-without-hole")
        self.at = self.rows.repeat(count, self._offset(axes), self.line)

    def repeat_pattern(self, count: int, axes: Mapping[str, str]) -> None:
        """M02: the pattern again, count times. Complaint in incremental mode, whose zero moves with the pattern."""
        if self.incremental:
            raise Complaint("unsupported-command", "M02 in incremental mode")
        self.displaced = True
        self.router.copied()
        self.rows.repeat_pattern(count, self._offset(axes), self.line)

    def cut(self, *, down: bool) -> None:
        """M14 and M15 begin a cut, also where G00 is missing; M16 and M17 end it."""
        if down:
            self.routing, self.tool_in_rout = True, False
        if down and not self.cutting:
            if not self.router.cuts:
                self.remark("routs-not-drilled")
            self.router.begin()
        self.cutting = down

    def _prepare(self, columns: Sequence[Sequence[str]]) -> None:
        """What a hole changes beside itself: the header is over, Allegro's first tool is taken."""
        if self.in_header:
            self.remark("header-not-closed")
            self.in_header = False
        if self.stopped:
            self.remark("holes-after-stop")
            self.stopped = False
        if self.displaced and (self.incremental or not all(column[0] for column in columns[: len(AXES)])):
            self.remark("place-from-before")
        self.displaced = False
        if self.tools.current == NO_TOOL:
            self.tools.first_announced()

    def _offset(self, axes: Mapping[str, str]) -> Floats:
        """The written axes as triples, 0 where not written."""
        written = [axis for axis in AXES if axis in axes]
        offset = np.zeros((2, 3))
        if written:
            triples = read_numbers([axes[axis] for axis in written], self.evidence)
            offset[[AXES.index(axis) for axis in written]] = triples
        return offset

    def _positions(self, words: Sequence[str], start: Floats) -> Floats:
        """Where n moves along one axis lead (n, 3), from start: an axis not written keeps its place."""
        if not self.incremental and "" not in words:
            return read_numbers(words, self.evidence)
        written = np.array([bool(word) for word in words])
        steps = np.zeros((len(words) + 1, 3))
        steps[0] = start
        if written.any():
            steps[1:][written] = read_numbers([word for word in words if word], self.evidence)
        if self.incremental:
            return np.cumsum(steps, axis=0)[1:]
        last_written = np.maximum.accumulate(np.where(written, np.arange(1, len(words) + 1), 0))
        return steps[last_written]

    # -- end --------------------------------------------------------------------------------------

    def finish(self) -> None:
        """The text is over: what must not stay open, and what is missing."""
        self.rows.close_pattern()
        self.tools.complete()
        if not (self.ended or self.stopped):
            self.remark("no-end-of-program")

    def toolless(self) -> bool:
        """Whether the whole program never named a tool (PCB Wizard, Vutrax)."""
        return not self.tools.entries and bool((self.rows.array()["tool"] == NO_TOOL).any())


def _units_of(mm: float) -> str:
    return next(units for units, factor in MM_PER_UNIT.items() if factor == mm)


def _columns(axes: Mapping[str, str]) -> list[Sequence[str]]:
    """X and Y of one line as columns of one number each, '' where not written."""
    return [[axes.get(axis, "")] for axis in AXES]
