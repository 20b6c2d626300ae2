"""What a frame of the scope costs: CPU time to draw a run of two million ticks at every zoom, and to follow a live one.

Run as ``python -m benchmarks.scope_frame``. Targets: a frame of the long run in under 10 ms at any zoom, and the scope
following a moving machine 20 times a second in under 10 % of a core. The long run is a real one, repeated.
"""

import os
import sys
import time
from collections.abc import Callable, Sequence
from statistics import median
from time import process_time

import numpy as np
import urwid

from drillctl.console.machine_console import MachineConsole
from drillctl.console.scope import RunScope
from drillctl.console.scope_runs import ScopeRuns
from drillctl.generation.job import names_of
from drillctl.kmd import parse_program
from drillctl.machine import Library, shipped_tables
from drillctl.ticker.launch import RunSettings
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Trace
from drillctl.ui.models.viewport import SignalRows, Viewport
from drillctl.ui.screens.scope import Scope
from drillctl.ui.screens.scope_view import ScopeLayout, ScopeLook, scope_lines
from drillctl.ui.widgets.texts import boxed

LONG_TICKS = 2_000_000
SIZES = ((80, 20), (160, 46))
TARGET_MS, TARGET_SHARE = 10.0, 0.10
RUNS = 15
LEVELS = 20  # of zoom: the last one shows all
FRAMES, FRAME_S = 100, 0.05
QUEUE = "KMD_INICJALIZACJA\nKMD_GOTO_X_Y 900 500\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\nKMD_LINIA x=300 y=100\n"
LIBRARY = Library((shipped_tables(),))


def one_run() -> Trace:
    """A short job with every signal."""
    machine = LIBRARY.machine("pcb-drill")
    ticker = Ticker.simulated(machine, traced=True, derived=True)
    ticker.queue.put(parse_program(QUEUE, names_of(machine)))
    ticker.run(10**6, ticker.over)
    trace = ticker.finished_trace(())
    assert trace is not None
    return trace


def long_run() -> RunScope:
    """The short one again and again."""
    trace = one_run()
    times = -(-LONG_TICKS // trace.end)
    starts = np.repeat(np.arange(times) * trace.end, len(trace.ticks))
    scope = RunScope("long", LIBRARY.machine("pcb-drill"), trace.signals, 10**9)
    scope.lanes.append(np.tile(trace.ticks, times) + starts, np.tile(trace.signal, times), np.tile(trace.values, times))
    scope.last_tick = times * trace.end - 1
    return scope


def frame_ms(scope: RunScope, level: int, columns: int, rows: int) -> float:
    """CPU milliseconds of one frame from the middle of the run, as far as a canvas."""
    view = Viewport().sized(ScopeLayout.of(scope.signals(), columns).waves).of_run(scope.first_tick, scope.last_tick)
    view = view.go(scope.last_tick // 2).zoomed(level - view.level)
    look = ScopeLook(view, SignalRows(len(scope.signals())))

    def once() -> float:
        started = process_time()
        boxed(scope_lines(scope, look, columns, rows)[0], columns, rows)
        return (process_time() - started) * 1000

    return median(once() for _ in range(RUNS))


def following_share(columns: int, rows: int) -> float:
    """The share of a core that the desk's process takes while two motors turn and the scope follows."""
    station = MachineConsole(LIBRARY, LIBRARY.machine("pcb-drill"), RunSettings(pace="real"))
    try:
        station.run_queue("KMD_RUCHd x=9000 y=9000\n")
        scope = Scope(station, Nobody(), ScopeRuns(LIBRARY, station))
        spent, began = process_time(), time.monotonic()
        for frame in range(FRAMES):
            station.turn()
            scope.refresh(station.view())
            for _row in scope.render((columns, rows), True).content():
                pass
            time.sleep(max(0.0, began + frame * FRAME_S - time.monotonic()))
        assert station.at_work, "the move was too short to be followed"
        return (process_time() - spent) / (time.monotonic() - began)
    finally:
        station.close()


class Nobody:
    """A shell that is asked for nothing."""

    def message(self, title: str, lines: Sequence[str]) -> None: ...

    def ask(self, question: str, yes: Callable[[], None]) -> None: ...

    def ask_text(self, title: str, prompt: str, text: str, accept: Callable[[str], None]) -> None: ...

    def open(self, screen: urwid.Widget) -> None: ...

    def back(self) -> None: ...


def main() -> int:
    """Prints a line a size; 1 where a target is missed."""
    print(f"python {sys.version.split()[0]}, numpy {np.__version__}, load {os.getloadavg()[0]:.2f}")
    scope = long_run()
    print(f"{scope.last_tick + 1} ticks, {len(scope.lanes)} changes in {len(scope.signals())} lanes; median of {RUNS}")
    missed = False
    for columns, rows in SIZES:
        costs = [frame_ms(scope, level, columns, rows) for level in range(LEVELS)]
        share = following_share(columns, rows)
        missed = missed or max(costs) >= TARGET_MS or share >= TARGET_SHARE
        told = f"{columns} x {rows}: {min(costs):.1f} to {max(costs):.1f} ms a frame, from 8 columns a tick to all"
        print(f"{told}; {share:.1%} of a core to follow a live one at {1 / FRAME_S:.0f} frames a second")
    return int(missed)


if __name__ == "__main__":
    sys.exit(main())
