"""How many ticks a second this computer can work off at all, for one machine: the tick on a throw-away simulation.

Rule: the least of several short runs, so that a busy computer refuses nothing that it can carry when it is left alone;
how punctual the ticks then are is another question (latency.py). Called by machinery before anything moves.
"""

import time

import numpy as np

from drillctl.kmd import RECORD, Op
from drillctl.machine import Machine
from drillctl.wiring.ticker import Ticker

RUNS = 8
TICKS_A_RUN = 50


def most_ticks_hz(machine: Machine) -> int:
    """Ticks a second with all axes moving, status record included."""
    ticker = Ticker.simulated(machine)
    away = np.zeros(1, dtype=RECORD)
    away["opcode"], away["axes"] = Op.RUCH_D, (1 << len(machine.axes)) - 1
    away["args"][0, : len(machine.axes)] = [axis.span_steps for axis in machine.axes]
    ticker.queue.put(away)
    return int(1 / min(_seconds_a_tick(ticker) for _ in range(RUNS)))


def _seconds_a_tick(ticker: Ticker) -> float:
    begun_s = time.perf_counter()
    for _ in range(TICKS_A_RUN):
        ticker.run(1)
        ticker.report()
    return (time.perf_counter() - begun_s) / TICKS_A_RUN
