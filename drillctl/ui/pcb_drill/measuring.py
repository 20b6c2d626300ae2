"""Holes being measured on a board: which, where each was found, and what they say so far.

Rule: places are in millimetres from machine zero, whatever the working base is; nothing here moves or places anything.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from drillctl.ui.models.editing import History, Undoable
from drillctl.viewmodel.console import BoardView, Problems
from drillctl.viewmodel.job_options import MeasuredHole
from drillctl.viewmodel.jobs import AlignmentReport

PlaceMm = tuple[float, float]
Align = Callable[[tuple[MeasuredHole, ...], bool], tuple[AlignmentReport | None, Problems]]
MOST_HOLES = 12
LEAST_HOLES = 2


@dataclass(frozen=True)
class Spot:
    """A hole by its number from 1, in the file's coordinates, and where it was found, None as long as it was not."""

    number: int
    file_mm: PlaceMm
    found_mm: PlaceMm | None = None


class Measuring(Undoable[tuple[Spot, ...]]):
    """Begins with what was measured before, or with three holes that lie far apart.

    align  Console.align; ``alignment`` is what it says of the holes found, ``problems`` why it says nothing
    """

    def __init__(self, board: BoardView, measured: tuple[MeasuredHole, ...], face_down: bool, align: Align):
        self._board, self._face_down, self._align = board, face_down, align
        spots = [_spot_of(board, hole) for hole in measured]
        self._history = History(tuple(spots or map(self._spot, far_apart(board.file_xy_mm))))
        self._look()

    @property
    def spots(self) -> tuple[Spot, ...]:
        """The holes of the list."""
        return self._history.now

    @property
    def measured(self) -> tuple[MeasuredHole, ...]:
        """The holes that were found, as Console.align takes them."""
        return tuple(MeasuredHole(*spot.file_mm, *spot.found_mm) for spot in self.spots if spot.found_mm)

    @property
    def sound(self) -> bool:
        """Whether a board can be placed by them."""
        return self.alignment is not None and not self.alignment.rejected

    def add(self, number: int) -> bool:
        """Another hole; False where there is no such hole, or it is there already, or there are enough."""
        there = any(spot.number == number for spot in self.spots)
        if there or not 1 <= number <= len(self._board.xy_mm) or len(self.spots) >= MOST_HOLES:
            return False
        self._change((*self.spots, self._spot(number - 1)))
        return True

    def remove(self, index: int) -> None:
        """Takes a hole off the list, by its index."""
        self._change((*self.spots[:index], *self.spots[index + 1 :]))

    def find(self, index: int, place_mm: PlaceMm) -> None:
        """Notes the place where a hole was found, in mm from machine zero."""
        found = replace(self.spots[index], found_mm=place_mm)
        self._change((*self.spots[:index], found, *self.spots[index + 1 :]))

    def expected_mm(self, index: int, base_mm: PlaceMm) -> PlaceMm:
        """Where a hole should be: by what was found so far, else as the board is placed from this working base."""
        spot = self.spots[index]
        if self.alignment is not None:
            return self.alignment.place_mm(spot.file_mm)
        x_mm, y_mm = (self._board.xy_mm[spot.number - 1] + np.array(base_mm)).tolist()
        return x_mm, y_mm

    def residual_mm(self, index: int) -> float | None:
        """How far a hole was found from where the alignment has it; None where nothing can be said."""
        if self.alignment is None or self.spots[index].found_mm is None:
            return None
        row = sum(spot.found_mm is not None for spot in self.spots[:index])
        return self.alignment.residual_mm[row]

    def _spot(self, index: int) -> Spot:
        x_mm, y_mm = self._board.file_xy_mm[index].tolist()
        return Spot(index + 1, (x_mm, y_mm))

    def _restore(self) -> None:
        self._look()

    def _change(self, spots: tuple[Spot, ...]) -> None:
        self._history.do(spots)
        self._look()

    def _look(self) -> None:
        enough = len(self.measured) >= LEAST_HOLES
        self.alignment, self.problems = self._align(self.measured, self._face_down) if enough else (None, ())


def far_apart(xy_mm: NDArray[np.float64]) -> list[int]:
    """At most three of n holes (n, 2), by their rows: far from the middle, from each other, and from their line."""
    if len(xy_mm) < 2:
        return list(range(len(xy_mm)))
    first = int(np.hypot(*(xy_mm - xy_mm.mean(axis=0)).T).argmax())
    from_first = xy_mm - xy_mm[first]
    second = int(np.hypot(*from_first.T).argmax())
    along_x, along_y = from_first[second]
    off_line = np.abs(from_first[:, 0] * along_y - from_first[:, 1] * along_x)
    return list(dict.fromkeys((first, second, int(off_line.argmax()))))


def _spot_of(board: BoardView, hole: MeasuredHole) -> Spot:
    file_mm = (hole.file_x_mm, hole.file_y_mm)
    number = int(np.hypot(*(board.file_xy_mm - np.array(file_mm)).T).argmin()) + 1
    return Spot(number, file_mm, (hole.machine_x_mm, hole.machine_y_mm))
