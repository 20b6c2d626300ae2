"""What a program will take on the ideal plant, to the tick, from the machine file's start position.

Rule: exact. The program is run by the fast engine, which gives the same ticks as the machine, and only the ticks of
each command are recorded.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.machine import Machine
from drillctl.ticker.ticker import TICK

Ticks = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Forecast:
    """``ticks`` (n,) of each command, as far as they are run; ``fault`` is the code that ends the program, or 0."""

    ticks: Ticks
    fault: int

    @property
    def total_ticks(self) -> int:
        """The ticks of the whole program."""
        return int(self.ticks.sum())


def forecast(
    program: NDArray[np.void],
    machine: Machine,
    engine: str | None = None,
    advance: Callable[[int, int], None] | None = None,
) -> Forecast:
    """Forecasts a program, dtype kmd.RECORD, numbered from 1; with the engine ``tick`` by running every tick of it.

    advance: is called with the number of commands that are done, and with that of all.
    """
    from drillctl.ticker.fast_ticker import FastTicker

    ticker = FastTicker.ideal(machine, capacity=len(program), in_batches=engine != TICK)
    ticker.queue.put(program)
    ticks, m = np.zeros(len(program), np.int64), ticker.controller
    for batch in ticker.batches():
        if batch is None:
            ticks[m.command.sequence - 1] = m.elapsed
        else:
            ticks[batch.commands["sequence"] - 1] = batch.ticks
        if advance is not None:
            advance(int(m.command.sequence), len(program))
    return Forecast(ticks, m.fault)
