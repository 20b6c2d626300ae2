"""The clock's gate (TICKS): stops the ticks, lets a number of them through, and opens again.

Rule: a tick that does not come is no tick: nothing counts, nothing acts, and a run that was paused gives the same trace
as one that was not. Granted ticks that are left when the gate opens lapse. The ticker looks at the gate between ticks;
``tick`` knows nothing of it.
"""

from typing import Protocol


class TickGate(Protocol):
    """A gate in one process or between two: the desk grants ticks, the ticker counts those that it ran."""

    @property
    def paused(self) -> bool:
        """Whether the gate is shut: only granted ticks are run."""

    @property
    def left(self) -> int:
        """How many granted ticks have not been run yet."""

    def grant(self, ticks: int) -> None:
        """Shuts the gate, and lets so many more ticks through."""

    def open(self) -> None:
        """Opens the gate: all ticks are run."""

    def passed(self, ticks: int) -> None:
        """Counts so many granted ticks as run."""


class Gate:
    """A gate within one process; open at first."""

    def __init__(self) -> None:
        self.paused = False
        self.left = 0

    def grant(self, ticks: int) -> None:
        """Shuts the gate, and lets so many more ticks through."""
        self.paused = True
        self.left += ticks

    def open(self) -> None:
        """Opens the gate: all ticks are run."""
        self.paused = False
        self.left = 0

    def passed(self, ticks: int) -> None:
        """Counts so many granted ticks as run."""
        self.left = max(0, self.left - ticks)
