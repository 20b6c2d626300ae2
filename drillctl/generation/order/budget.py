"""How long an order may be improved: to the end, for so many steps, or for so many seconds.

Rule: the only clock of this package. A search that the clock has cut short says after how many steps, and that number
cuts it at the same place again, on any computer.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable


class Budget:
    """Asked before each step of a search. `steps`: how many were allowed; `cut`: whether one was refused.

    seconds     from now on, by `clock`
    most_steps  as another search made that was cut short
    """

    def __init__(
        self, seconds: float | None = None, most_steps: int | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.steps, self.cut = 0, False
        self._most_steps = math.inf if most_steps is None else most_steps
        self._clock = None if seconds is None else clock
        self._until_s = math.inf if seconds is None else clock() + seconds

    def allows(self) -> bool:
        """Count one more step, or say that there may be none."""
        late = self._clock is not None and self._clock() >= self._until_s
        if self.cut or late or self.steps >= self._most_steps:
            self.cut = True
            return False
        self.steps += 1
        return True
