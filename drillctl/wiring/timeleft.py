"""How long a job will still take, from what each of its commands was foreseen to take.

Rule: counted from the command in execution, so that a start from another place, a hold, or a wait for the operator
changes nothing of what comes after. Called by desk.
"""

import numpy as np
from numpy.typing import NDArray


class TimeLeft:
    """Of a program whose commands take ``foreseen`` ticks (n,) each; fewer of them where the end is not foreseen."""

    def __init__(self, foreseen: NDArray[np.int64]):
        self._before = np.append(np.cumsum(foreseen[::-1])[::-1], 0)  # ticks left as command k begins
        self._done, self._since = 0, 0

    def ticks(self, done: int, tick: int) -> int:
        """Left at ``tick`` of the job, ``done`` commands being done. One that takes longer stands at its end."""
        if done != self._done:
            self._done, self._since = done, tick
        row = min(done, len(self._before) - 1)
        after = self._before[min(row + 1, len(self._before) - 1)]
        return int(max(self._before[row] - (tick - self._since), after))
