"""What lies in each cell of the picture of a board: outline, way to go, holes, and over them the head and its trail.

Rule: every state has a sign of its own, so that nothing is told by colour alone. What is still is laid once and kept;
what moves is laid over it row by row. Of several things in a cell the sign of the last one laid is seen.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drillctl.ui.models.board_map import BoardMap, Dots, Places
from drillctl.ui.models.board_work import Work
from drillctl.ui.widgets.dots import BRAILLE, braille_cells
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import HolesView, MachineView

PlaceMm = tuple[float, float]
ROUTE_HOLES = 60  # of the way to go so many holes are joined: more of them would hide the board
MIXED = "*"  # holes of several tools in a cell
SMALLEST_MM = 0.0  # of a tool without a diameter


class Sign(NamedTuple):
    """How a cell is shown: its role, and its sign with and without UTF-8. An empty sign: the braille of its dots."""

    role: str
    sign: str
    plain: str


SIGNS = {
    "nothing": Sign("body", " ", " "),
    "outline": Sign("border", "", ":"),
    "route": Sign("dark", "", " "),
    "to do": Sign("body", "", "."),
    "of the tool": Sign("title", "", "."),
    "origin": Sign("accent", "⊕", "0"),
    "done": Sign("good", "○", "o"),
    "failed": Sign("danger", "×", "x"),
    "current": Sign("warning", "◎", "@"),
    "trail": Sign("accent", "", "~"),
    "real": Sign("warning", "◇", "%"),
    "head": Sign("lit", "+", "+"),
}
STATES = (*SIGNS,)


@dataclass(frozen=True)
class Head:
    """The head: where it is thought to be, where the carriages really are (None: not known), and its last places."""

    thought_mm: PlaceMm | None = None
    real_mm: PlaceMm | None = None
    trail_mm: tuple[PlaceMm, ...] = ()


@dataclass(eq=False)
class Layers:
    """The still layers of a board: ``dots`` (rows, columns in dots), ``states`` and ``signs`` a value for each cell."""

    placed: BoardMap
    plain: bool
    dots: NDArray[np.bool_]
    states: NDArray[np.int64]
    signs: NDArray[np.str_]
    lines: list[Line] = field(default_factory=list)
    _newest: "Layers | None" = None  # with the head over them, as they were drawn last

    @classmethod
    def of(cls, board: HolesView, placed: BoardMap, work: Work, tool: int, plain: bool, numbers: bool) -> "Layers":
        """Lays a board down. ``tool``: the number of the one in the spindle; ``numbers``: holes to do show theirs."""
        shape = placed.rows, placed.columns
        layers = cls(
            placed, plain, placed.grid(np.zeros((0, 2), np.int64)), np.zeros(shape, np.int64), np.full(shape, " ")
        )
        layers._lay("outline", placed.outline())
        route = board.xy_mm[work.done : work.done + ROUTE_HOLES]
        layers._lay("route", placed.path(route))
        layers._put("origin", placed.cells(np.zeros((1, 2))))
        layers._holes(board, work, tool, numbers)
        layers.lines = [layers._line(row) for row in range(placed.rows)]
        return layers

    def with_head(self, head: Head) -> list[Line]:
        """The lines of all cells with the head over them; only rows that changed since the last call are made anew."""
        over = Layers(self.placed, self.plain, self.dots.copy(), self.states.copy(), self.signs.copy())
        over._lay("trail", self.placed.path(np.array(head.trail_mm), every=1) if head.trail_mm else None)
        over._put("real", _cell(self.placed, head.real_mm))
        over._put("head", _cell(self.placed, head.thought_mm))
        before = self._newest or self
        changed = over._unlike(before)
        over.lines = [over._line(row) if other else before.lines[row] for row, other in enumerate(changed)]
        self._newest = over
        return over.lines

    def _unlike(self, other: "Layers") -> list[bool]:
        """For each row whether something in it is not as in other layers of the same sheet."""
        dots = (self.dots != other.dots).reshape(self.placed.rows, -1).any(axis=1)
        cells = ((self.states != other.states) | (self.signs != other.signs)).any(axis=1)
        unlike: list[bool] = (dots | cells).tolist()
        return unlike

    def _holes(self, board: HolesView, work: Work, tool: int, numbers: bool) -> None:
        """The holes: those to do as large as they are, the others as a sign where none to do is in their cell."""
        indices = np.arange(len(board.xy_mm))
        to_do = indices >= work.done
        of_tool = np.array([each.number == tool for each in board.tools])[board.tool]
        diameters = np.array([each.diameter_mm or SMALLEST_MM for each in board.tools])[board.tool]
        for state, chosen in (("to do", to_do & ~of_tool), ("of the tool", to_do & of_tool)):
            self._lay(state, self.placed.discs(board.xy_mm[chosen], diameters[chosen]))
        cells = self.placed.cells(board.xy_mm)
        if numbers:
            self._number(cells[to_do], board.tool[to_do], [str(each.number % 10) for each in board.tools])
        left = set(map(tuple, cells[to_do].tolist()))
        done = [cell for cell in cells[~to_do].tolist() if tuple(cell) not in left]
        self._put("done", np.array(done, np.int64).reshape(-1, 2))
        for state, index in (("failed", work.failed), ("current", work.current)):
            self._put(state, cells[index : index + 1] if index is not None else cells[:0])

    def _number(self, cells: Dots, tools: NDArray[np.int64], digits: Sequence[str]) -> None:
        """The last digit of the tool in each cell with holes to do."""
        for (row, column), tool in zip(cells.tolist(), tools.tolist(), strict=True):
            if 0 <= row < self.placed.rows and 0 <= column < self.placed.columns:
                other = self.signs[row, column] not in (" ", digits[tool])
                self.signs[row, column] = MIXED if other else digits[tool]

    def _lay(self, state: str, dots: Dots | None) -> None:
        """Lights dots; their cells have this state."""
        if dots is None or not len(dots):
            return
        lit = self.placed.grid(dots)
        down, across = lit.shape[0] // self.placed.rows, lit.shape[1] // self.placed.columns
        self.dots |= lit
        hit = lit.reshape(self.placed.rows, down, self.placed.columns, across).any(axis=(1, 3))
        self.states[hit], self.signs[hit] = STATES.index(state), " "

    def _put(self, state: str, cells: Dots) -> None:
        """Gives whole cells a state and its sign; those beyond the sheet are left out."""
        inside = cells[((cells >= 0) & (cells < np.array(self.states.shape))).all(axis=1)]
        sign = SIGNS[state]
        self.states[tuple(inside.T)] = STATES.index(state)
        self.signs[tuple(inside.T)] = sign.plain if self.plain else sign.sign

    def _line(self, row: int) -> Line:
        """A row as marked text, neighbours of one role together."""
        down = self.dots.shape[0] // self.placed.rows
        braille = braille_cells(self.dots[row * down : (row + 1) * down])[0]
        cells = zip(self.states[row].tolist(), self.signs[row].tolist(), braille, strict=True)
        drawn = [(SIGNS[STATES[state]].role, self._sign(STATES[state], sign, dots)) for state, sign, dots in cells]
        return [(role, "".join(sign for _role, sign in run)) for role, run in groupby(drawn, key=lambda cell: cell[0])]

    def _sign(self, state: str, sign: str, dots: str) -> str:
        if sign != " ":
            return sign
        if self.plain:
            return SIGNS[state].plain
        return " " if dots == chr(BRAILLE) else dots


def _cell(placed: BoardMap, place_mm: PlaceMm | None) -> Dots:
    places: Places = np.array([place_mm]) if place_mm else np.zeros((0, 2))
    return placed.cells(places)


def head_places(view: MachineView) -> tuple[PlaceMm | None, PlaceMm | None]:
    """Where the bit is thought to be, and where the simulated carriages have it; None for what is not known."""
    if len(view.axes) < 2:
        return None, None
    x, y = view.axes[:2]
    thought = x.position_mm, y.position_mm
    if x.behind_steps is None or y.behind_steps is None:
        return thought, None
    behind_mm = x.behind_steps / x.steps_per_mm, y.behind_steps / y.steps_per_mm
    return thought, (thought[0] - behind_mm[0], thought[1] - behind_mm[1])
