"""Where a board lies: maps from the drill file's millimetres to millimetres from the working base.

Rule: one map per board, made once from what the operator asked for, and the same map backwards tells
where in the file a hole that was made belongs. Units are millimetres throughout; steps come later.
`alignment.py` makes the maps that come from measured holes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drillctl.language import Message, Refusal
from drillctl.language.messages import listed
from drillctl.viewmodel.choices import ORIGINS
from drillctl.viewmodel.job_options import MAX_MM

MIRRORS = {
    None: ((1.0, 0.0), (0.0, 1.0)),
    "x": ((-1.0, 0.0), (0.0, 1.0)),  # x changes sign
    "y": ((1.0, 0.0), (0.0, -1.0)),  # y changes sign
}
# Cosine and sine of the quarter turns, exact: math.cos(math.radians(90)) is 6e-17, not 0.
QUARTER_TURNS = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0), 180.0: (-1.0, 0.0), 270.0: (0.0, -1.0)}
PANEL_ORDERS = ("serpentine", "rows")
MAX_BOARDS = 1000  # more than any bed holds; a slip of the finger must not fill the memory


class PlacingError(Refusal):
    """A placing that cannot be meant: the operator's options contradict each other or are out of range."""

    kind = "placing"


@dataclass(frozen=True, eq=False)
class Affine:
    """A map of the plane: `matrix` is 2x3 float64, (x, y) goes to matrix[:, :2] @ (x, y) + matrix[:, 2]."""

    matrix: NDArray[np.float64]

    def __post_init__(self) -> None:
        matrix = np.array(self.matrix, dtype=np.float64)
        if matrix.shape != (2, 3) or not np.isfinite(matrix).all():
            raise PlacingError(Message("a map needs 2 x 3 finite numbers, not {numbers!r}", numbers=self.matrix))
        matrix.flags.writeable = False
        object.__setattr__(self, "matrix", matrix)

    @classmethod
    def of(cls, linear: ArrayLike, shift_mm: ArrayLike = (0.0, 0.0)) -> Affine:
        """The map with the 2x2 matrix `linear`, then moved by `shift_mm`, a pair (x, y)."""
        return cls(np.column_stack([np.asarray(linear, np.float64), np.asarray(shift_mm, np.float64)]))

    @property
    def linear(self) -> NDArray[np.float64]:
        """The 2x2 part: mirror, turn, scale and shear, without the shift."""
        return self.matrix[:, :2]

    @property
    def shift_mm(self) -> NDArray[np.float64]:
        """Where the file's zero goes, (2,)."""
        return self.matrix[:, 2]

    def apply(self, xy_mm: ArrayLike) -> NDArray[np.float64]:
        """Map points, (n, 2) to (n, 2); n may be 0."""
        points_mm = np.asarray(xy_mm, np.float64).reshape(-1, 2)
        return points_mm @ self.linear.T + self.shift_mm

    def apply_one(self, x_mm: float, y_mm: float) -> tuple[float, float]:
        """Map one point: for many that come one by one."""
        a, b, c, d, e, f = self._numbers
        return a * x_mm + b * y_mm + c, d * x_mm + e * y_mm + f

    @cached_property
    def _numbers(self) -> list[float]:
        return self.matrix.ravel().tolist()

    def then(self, after: Affine) -> Affine:
        """This map first, `after` on its result."""
        return Affine.of(after.linear @ self.linear, after.linear @ self.shift_mm + after.shift_mm)

    def inverse(self) -> Affine:
        """The way back. Raises PlacingError if the map flattens the plane, so that there is none."""
        return self._inverse

    @cached_property
    def _inverse(self) -> Affine:
        if abs(np.linalg.det(self.linear)) < 1e-12:
            raise PlacingError(Message("the map flattens the board onto a line and can not be inverted"))
        back = np.linalg.inv(self.linear)
        return Affine.of(back, -back @ self.shift_mm)


@dataclass(frozen=True)
class Panel:
    """Step and repeat: `columns` boards along X, `rows` along Y, at these pitches (negative = the other way).

    `order` 'rows' drills every row in the same direction, 'serpentine' turns round at a row's end.
    """

    columns: int
    rows: int
    pitch_x_mm: float
    pitch_y_mm: float
    order: str = "serpentine"

    def __post_init__(self) -> None:
        _one_of(Message("panel order"), self.order, PANEL_ORDERS)
        _finite(Message("the panel's pitch"), self.pitch_x_mm, self.pitch_y_mm)
        if self.columns < 1 or self.rows < 1:
            raise PlacingError(
                Message(
                    "a panel of {columns} x {rows} boards has no board; give 1 or more",
                    columns=self.columns,
                    rows=self.rows,
                )
            )
        if self.columns * self.rows > MAX_BOARDS:
            raise PlacingError(
                Message(
                    "a panel of {columns} x {rows} boards; {most} are the most",
                    columns=self.columns,
                    rows=self.rows,
                    most=MAX_BOARDS,
                )
            )
        if (self.columns > 1 and self.pitch_x_mm == 0) or (self.rows > 1 and self.pitch_y_mm == 0):
            raise PlacingError(Message("a panel with pitch 0 would drill one board into another"))

    def shifts_mm(self) -> NDArray[np.float64]:
        """How far each board lies from the first, (columns * rows, 2), in drilling order, (0, 0) first."""
        return np.array(list(self._cells()), np.float64) * (self.pitch_x_mm, self.pitch_y_mm)

    def _cells(self) -> Iterator[tuple[int, int]]:
        for row in range(self.rows):
            turned = self.order == "serpentine" and row % 2 == 1
            columns = range(self.columns)
            yield from ((column, row) for column in (reversed(columns) if turned else columns))


@dataclass(frozen=True)
class Placing:
    """What the operator asked for. Applied in this order: mirror, rotate, origin, offset, panel.

    mirror     'x': x changes sign, as if the board were turned over like a page; 'y': y changes sign
    rotate_deg counter-clockwise, about the file's zero
    origin     'base' (meant when None): the lowest X and the lowest Y come to lie at the working base;
               'file': the file's own coordinates are kept
    offset_mm  (x, y), added last
    alignment  the map found from measured holes; it decides alone, so mirror, rotate, origin and
               offset are refused beside it
    pinned     the board has pins, in its extent, and is turned over on them: it is mirrored about the middle of its
               extent, whose corners alone count for origin 'base'. So both sides have the pins in the same places
    panel      repeats along the machine's axes; with an alignment along the measured axes of the sheet

    Raises PlacingError.
    """

    origin: str | None = None
    mirror: str | None = None
    rotate_deg: float = 0.0
    offset_mm: tuple[float, float] = (0.0, 0.0)
    panel: Panel | None = None
    pinned: bool = False
    alignment: Affine | None = None

    def __post_init__(self) -> None:
        _one_of(Message("origin"), self.origin, (None, *ORIGINS))
        _one_of(Message("mirror"), self.mirror, tuple(MIRRORS))
        _finite(Message("rotation and offset"), self.rotate_deg, *self.offset_mm)
        if self.alignment is not None and self._asked_beside_alignment():
            raise PlacingError(
                Message(
                    "{what} given together with an alignment: the measured holes already say where the board lies; "
                    "leave one of the two out",
                    what=listed(self._asked_beside_alignment()),
                )
            )

    def _asked_beside_alignment(self) -> list[Message]:
        asked = {
            Message("origin"): self.origin is not None,
            Message("mirror"): self.mirror is not None,
            Message("rotate"): self.rotate_deg != 0,
            Message("offset"): tuple(self.offset_mm) != (0.0, 0.0),
        }
        return [name for name, given in asked.items() if given]


def transform(placing: Placing, xy_mm: ArrayLike) -> Affine:
    """The first board's map, from file millimetres to millimetres from the working base.

    `xy_mm` (n, 2) are the points whose lowest corner counts for origin 'base': all holes and slot ends
    of all tools. With none of them the corner is the file's zero.
    """
    if placing.alignment is not None:
        return placing.alignment
    points_mm = np.asarray(xy_mm, np.float64).reshape(-1, 2)
    mirrored = Affine.of(MIRRORS[placing.mirror])
    if placing.pinned and len(points_mm):
        low, high = points_mm.min(axis=0), points_mm.max(axis=0)
        middle = (low + high) / 2
        mirrored = Affine.of(mirrored.linear, middle - mirrored.linear @ middle)
        points_mm = np.array([low, high, (low[0], high[1]), (high[0], low[1])])
    turned = mirrored.then(Affine.of(_rotation(placing.rotate_deg)))
    return turned.then(Affine.of(np.eye(2), _corner_shift_mm(placing, turned, points_mm) + placing.offset_mm))


def boards(placing: Placing, xy_mm: ArrayLike) -> tuple[Affine, ...]:
    """One map per board of the panel, in drilling order; a single board is a panel of one.

    `boards(...)[i].inverse()` takes a hole made on board i back to the file's coordinates.
    """
    first = transform(placing, xy_mm)
    if placing.panel is None:
        return (first,)
    shifts_mm = placing.panel.shifts_mm()
    if placing.alignment is not None:
        # The sheet is turned as a whole, so the way to the next board is turned with it.
        shifts_mm = shifts_mm @ placing.alignment.linear.T
    return tuple(first.then(Affine.of(np.eye(2), shift_mm)) for shift_mm in shifts_mm)


def _rotation(turn_deg: float) -> NDArray[np.float64]:
    angle_rad = math.radians(turn_deg)
    cosine, sine = QUARTER_TURNS.get(turn_deg % 360.0, (math.cos(angle_rad), math.sin(angle_rad)))
    return np.array([[cosine, -sine], [sine, cosine]])


def _corner_shift_mm(placing: Placing, turned: Affine, xy_mm: ArrayLike) -> NDArray[np.float64]:
    corners_mm = turned.apply(xy_mm)
    if placing.origin == "file" or not len(corners_mm):
        return np.zeros(2)
    return -corners_mm.min(axis=0)


def _one_of(what: Message, value: object, allowed: tuple[object, ...]) -> None:
    if value not in allowed:
        names = " or ".join(repr(name) for name in allowed if name is not None)
        raise PlacingError(Message("{what} {value!r} is not known; give {names}", what=what, value=value, names=names))


def _finite(what: Message, *values: float) -> None:
    if not all(abs(value) <= MAX_MM for value in values):  # which nan is not either
        raise PlacingError(
            Message("{what} must be plain numbers up to {most:g}, not {values}", what=what, most=MAX_MM, values=values)
        )
