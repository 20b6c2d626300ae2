"""The clock's gate (TICKS): ticks may be stopped, let through one by one, and let go again.

Rule: a tick that does not come is no tick: nothing counts, nothing acts, and a run that was paused is the run that was
not. What was granted and is left when the gate opens lapses. Asked by the ticker between ticks, never by tick itself.
"""

from typing import Protocol


class TickGate(Protocol):
    """A gate in one process or between two: one side grants, the other counts."""

    @property
    def paused(self) -> bool:
        """Only granted ticks pass."""

    @property
    def left(self) -> int:
        """Granted ticks that have not passed yet."""

    def grant(self, ticks: int) -> None:
        """From now on only granted ticks pass, so many more."""

    def open(self) -> None:
        """All ticks pass again."""

    def passed(self, ticks: int) -> None:
        """So many of those granted were run."""


class Gate:
    """The gate of one process; open at first."""

    def __init__(self) -> None:
        self.paused = False
        self.left = 0

    def grant(self, ticks: int) -> None:
        """From now on only granted ticks pass, so many more."""
        self.paused = True
        self.left += ticks

    def open(self) -> None:
        """All ticks pass again."""
        self.paused = False
        self.left = 0

    def passed(self, ticks: int) -> None:
        """So many of those granted were run."""
        self.left = max(0, self.left - ticks)
