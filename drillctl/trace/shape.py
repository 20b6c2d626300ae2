"""A signal as a dense array, one value a tick.

Rule: memory grows with the ticks run, not with the changes; for one signal at a time.
"""

import numpy as np

from drillctl.trace.record import Trace
from drillctl.trace.values import Values


def dense(trace: Trace, name: str) -> Values:
    """Returns the signal's value in every tick: int64 (end,). Raises KeyError for a signal that was not recorded."""
    ticks, values = trace.changes_of(name)
    return np.repeat(values, np.diff(ticks, append=trace.end))
