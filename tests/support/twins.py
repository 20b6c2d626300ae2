"""Two tickers on one program and the same disturbances: one ticks, one goes as fast as may be. Used by tests/execution.

Rule: everything that either of them remembers is compared, and every tick's image by way of the trace.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.generation.job import names_of
from drillctl.kmd import Request, parse_program
from drillctl.machine import Machine
from drillctl.plant import IdealPlant
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.sampler import signals
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Recorder, Trace, first_difference, render
from tests.support.bench import shipped

OF_BOOKS = ("ramp", "followers", "least", "most")  # compared by ``been`` and ``led by``
Disturbances = Mapping[int, int]  # by tick: requests as bits of the mailbox, or below 0 a gap of so many periods
SHORTER = 10  # times: ways home and down, where down is a distance of thousands of steps
REQUESTS = [*(1 << r for r in (Request.HOLD, Request.RESUME, Request.STOP, Request.ESTOP, Request.ACK)), -3, -9, -60]
disturbances = st.dictionaries(st.integers(0, 9000), st.sampled_from(REQUESTS), max_size=3)


def ran(ticker: Ticker, program: NDArray[np.void], disturbances: Disturbances, ticks: int) -> Ticker:
    """The program fed as a desk does, disturbed at these ticks; to where nothing goes on, or for so many ticks."""
    m, put, times = ticker.controller, 0, sorted(disturbances)
    going_on = True
    while going_on and m.tick < ticks:
        put += ticker.queue.put(program[put:][: ticker.queue.room])
        if times and times[0] == m.tick:
            disturb(ticker, disturbances[times.pop(0)])
        before = m.tick
        ticker.turn(ticker.over, min([ticks, *times[:1]]))
        idle = ticker.over() and not times and (m.fault or not len(ticker.queue))
        going_on = m.tick > before and not idle
    return ticker


def disturb(ticker: Ticker, what: int) -> None:
    """Requests or a gap, before the next tick."""
    if what < 0:
        ticker.controller.gap = -what
    for request in Request:
        if what > 0 and what >> request & 1:
            ticker.requests.post(request)


def twins(machine: Machine, program: NDArray[np.void], disturbances: Disturbances, ticks: int
          ) -> tuple[Ticker, FastTicker]:  # fmt: skip
    """The law and the fast one, after the same; both keep columns, positions, states and the plant's lanes."""
    kept = signals(machine, IdealPlant.lanes, derived=True)
    fast = FastTicker.ideal(machine, traced=True, keeper=Recorder(kept), rotors=True)
    slow = Ticker.simulated(machine, traced=True, derived=True)
    return ran(slow, program, disturbances, ticks), ran(fast, program, disturbances, ticks)


def trace(ticker: Ticker) -> Trace:
    """The record of a ticker."""
    finished = ticker.finished_trace([])
    assert finished is not None
    return finished


def remembered(ticker: Ticker) -> dict[str, Any]:
    """All that a ticker, its controller and its plant would go on from."""
    m, plant = ticker.controller, ticker.plant
    assert plant is not None
    told = {name: value for name, value in vars(m).items() if isinstance(value, int)}
    told |= {f"command.{slot}": getattr(m.command, slot) for slot in m.command.__slots__}
    told |= {f"line.{slot}": getattr(m.line, slot) for slot in ("lead_reach", "reach", "error", "joins")}
    for number, axis in enumerate(m.axes):
        told |= {f"{number}.{slot}": getattr(axis, slot) for slot in Axis.__slots__ if slot not in OF_BOOKS}
        told[f"{number}.been"] = axis.been()
        told[f"{number}.led by"] = axis.followers is not None
        told[f"{number}.rotor"] = {k: v for k, v in vars(plant.rotors[number]).items() if k != "equilibrium"}
        told[f"{number}.sensors"] = [dict(vars(sensor)) for sensor in plant.carriages[number].sensors]
    told |= {name: value for name, value in vars(plant).items() if isinstance(value, int)}
    told |= {"holes": ticker.touched, "status": ticker.report().tobytes(), "waiting": len(ticker.queue)}
    return told


def check(machine: Machine, text: str, asked: Disturbances, ticks: int) -> FastTicker:
    """Runs a queue both ways, asserts that nothing differs, and returns the fast one. ``asked``: Disturbances."""
    program = parse_program(text, names_of(machine))
    program["tag"] = np.arange(len(program)) // 3
    slow, fast = twins(machine, program, asked, ticks)
    difference = first_difference(trace(slow), trace(fast))
    assert difference is None, render(difference)
    assert trace(slow) == trace(fast)
    assert remembered(slow) == remembered(fast)
    return fast


def small(name: str) -> Machine:
    """A machine whose ways home and down are short enough to be ticked through."""
    machine = shipped(name)
    if (machine.drill_down_steps or 0) < 1000:
        return machine
    return replace(
        machine,
        axes=tuple(replace(axis, start_steps=axis.start_steps // SHORTER) for axis in machine.axes),
        drill_down_steps=machine.drill_down_steps // SHORTER,
        drill_clear_steps=machine.drill_clear_steps and machine.drill_clear_steps // SHORTER,
        board_surface=tuple(steps and steps // SHORTER for steps in machine.board_surface),
    )
