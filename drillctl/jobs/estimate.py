"""What a job will take, worked out before it is run, and what is left of it while it runs.

Rule: the ticks of every command come from ticker/forecast.py, which is exact on the ideal plant.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.job import Job
from drillctl.generation.sequences import tool_changes
from drillctl.generation.waits import FORECASTING, Waits, unwatched
from drillctl.ticker.forecast import Forecast, forecast
from drillctl.viewmodel.fault_texts import fault_report
from drillctl.viewmodel.records import Estimate, ToolEstimate


def estimate(job: Job, engine: str | None = None, waits: Waits = unwatched) -> Estimate:
    """The time of a job, also by tool: the first tool's share begins with the initialisation, the last one's ends with
    the job. ``engine``: ``tick`` to run every tick of it. ``waits`` is called with how far the work is.
    """
    return estimate_with_ticks(job, engine, waits)[0]


def estimate_with_ticks(
    job: Job, engine: str | None = None, waits: Waits = unwatched
) -> tuple[Estimate, NDArray[np.int64]]:
    """Like ``estimate``; also the ticks (n,) of each command."""
    found = forecast(job.program, job.machine, engine, waits(FORECASTING))
    return _estimate(job, found), found.ticks


def _estimate(job: Job, found: Forecast) -> Estimate:
    groups = job.work.groups if job.work else ()
    changes = tool_changes(job.program).tolist()
    shares = [int(ticks.sum()) for ticks in np.split(found.ticks, changes[1:])]
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
        ticks=found.total_ticks,
        tick_hz=job.machine.tick_hz,
        tools=tuple(tools),
        exact=found.fault == 0,
        fault=fault_report(found.fault, kept=False) if found.fault else None,
    )


class TimeLeft:
    """The time left of a program whose commands take ``ticks`` (n,) each; n may be less than the program has, where it
    was forecast to end early.
    """

    def __init__(self, ticks: NDArray[np.int64]):
        self._before = np.append(np.cumsum(ticks[::-1])[::-1], 0)  # ticks left as command k begins
        self._done, self._since = 0, 0

    def ticks(self, done: int, tick: int) -> int:
        """The ticks left at ``tick`` of the job, with so many commands done. While one takes longer than forecast, the
        time left doesn't fall.
        """
        if done != self._done:
            self._done, self._since = done, tick
        row = min(done, len(self._before) - 1)
        after = self._before[min(row + 1, len(self._before) - 1)]
        return int(max(self._before[row] - (tick - self._since), after))
