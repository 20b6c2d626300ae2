"""Which rows of a long list are shown, and which of them the bar is on. Rule: never changes; operations give another.

Used by the scope screen, for its signals.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace


@dataclass(frozen=True, slots=True)
class Rows:
    """Rows 0..count-1, less those ``hidden``; the bar is ``at`` one that is shown. One row always stays."""

    count: int
    hidden: frozenset[int] = frozenset()
    at: int = 0

    @property
    def shown(self) -> list[int]:
        """From top to bottom."""
        return [row for row in range(self.count) if row not in self.hidden]

    def move(self, by: int) -> "Rows":
        """The bar, over what is shown; it stops at the ends."""
        shown = self.shown
        if not shown:
            return self
        return replace(self, at=shown[max(0, min(shown.index(self.at) + by, len(shown) - 1))])

    def hide(self) -> "Rows":
        """The row under the bar, which goes to the one below, or at the end above."""
        if len(self.shown) < 2:
            return self
        below = self.move(1)
        next_at = below.at if below.at != self.at else self.move(-1).at
        return replace(self, hidden=self.hidden | {self.at}, at=next_at)

    def only(self, rows: Iterable[int]) -> "Rows":
        """These and the one under the bar."""
        return replace(self, hidden=frozenset(range(self.count)) - {*rows, self.at})

    def all(self) -> "Rows":
        """Nothing is hidden."""
        return replace(self, hidden=frozenset())

    def put(self, line: int, room: int) -> "Rows":
        """The bar on a line of the window of ``room`` lines; a line without a row changes nothing."""
        window = self.window(room)
        return replace(self, at=window[line]) if 0 <= line < len(window) else self

    def window(self, room: int) -> list[int]:
        """As many as there is room for, the bar in the middle where it can be."""
        shown = self.shown
        place = shown.index(self.at) if shown else 0
        top = max(0, min(place - room // 2, len(shown) - room))
        return shown[top : top + room]
