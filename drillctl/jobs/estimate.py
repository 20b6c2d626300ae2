"""What a job will take, before it is run. The lab foresees its program, generation knows its tools.

Called by the estimate verb.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.job import Job
from drillctl.generation.sequences import tool_changes
from drillctl.ticker.forecast import Forecast, forecast
from drillctl.viewmodel import Estimate, ToolEstimate, fault_report


def estimate(job: Job, engine: str | None = None) -> Estimate:
    """Exact on the ideal plant; the first tool's share begins with the initialisation, the last's ends at the end."""
    return foresee(job, engine)[0]


def foresee(job: Job, engine: str | None = None) -> tuple[Estimate, NDArray[np.int64]]:
    """As ``estimate``, with the ticks of each command."""
    told = forecast(job.program, job.machine, engine)
    return _estimate(job, told), told.ticks


def _estimate(job: Job, told: Forecast) -> Estimate:
    groups = job.work.groups if job.work else ()
    changes = tool_changes(job.program).tolist()
    shares = [int(ticks.sum()) for ticks in np.split(told.ticks, changes[1:])]
    tools = [
        ToolEstimate(
            number=group.number,
            diameter_mm=group.diameter_mm,
            holes=group.stop - group.start,
            ticks=share,
            drill_mm=group.drill.diameter_mm if group.drill else None,
            hits_left=group.drill.hits_left if group.drill else None,
        )
        for group, share in zip(groups, shares, strict=False)
    ]
    return Estimate(
        machine=job.machine.name,
        holes_total=job.holes_total,
        ticks=told.total_ticks,
        tick_hz=job.machine.tick_hz,
        tools=tuple(tools),
        exact=told.fault == 0,
        fault=fault_report(told.fault, kept=False) if told.fault else None,
    )


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
