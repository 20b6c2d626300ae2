"""What one tick costs: CPU time with three axes moving, and with all of the eight-axis machine; memory kept by it.

Run as ``python -m benchmarks.tick_cost``. Targets: under 10 us a tick, so that 500 Hz is under 1 % of a core, and
nothing kept by any tick or command (over 20,000 ticks). The median of 7 runs stands beside the machine's load and
beside the cost of calling an empty Python function in the same loop, since microseconds alone say little about another
computer.

With ``--bytecodes`` it prints instead how many bytecodes of the interpreter a tick runs, by function. That count is the
same on a busy machine as on a quiet one, so two versions of the code can be compared by it.
"""

import argparse
import gc
import os
import sys
from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from statistics import median
from time import process_time_ns
from types import FrameType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.execution import Controller, tick
from drillctl.generation.job import names_of
from drillctl.kmd import Command, Queue, Requests, parse_program
from drillctl.machine import Library, Machine, shipped_tables

MACHINES = ("pcb-drill", "pcb-drill-ramp-lab", "eight-axis")
MOVING, MOST_MOVING = 3, 8  # axes
TARGET_US = 10.0
MOST_KEPT = 0.5  # blocks a command; what is kept by each command or tick would be 1 at the least
RUNS = 7
WINDOW_TICKS = 20_000
WARM_UP_TICKS = 3_000
COUNTED_TICKS = 4_000
LONG_STEPS, SHORT_STEPS = 600, 20
ROUNDS = 60  # there and back


class DeadCard:
    """A port without a machine: no input with an action is on, ever, so that only the tick is measured."""

    def __init__(self, machine: Machine):
        self.inputs = sum(1 << line.bit for line in machine.inputs if line.active_level == 0)

    def latch(self) -> int:
        return self.inputs

    def flush(self, image: int) -> None:
        pass

    def safe(self) -> None:
        pass

    def close(self) -> None:
        pass


def axes_moving(name: str, steps: int, count: int = MOVING) -> Controller:
    """A controller whose queue holds moves of its first axes, there and back, without an end."""
    machine = Library((shipped_tables(),)).machine(name)
    reach = min(steps, *(axis.span_steps - 10 for axis in machine.axes[:count]))
    there = "KMD_RUCHd " + " ".join(f"{axis}={reach}" for axis in machine.axis_names[:count])
    program = parse_program("\n".join([there, there.replace("=", "=-")] * ROUNDS), names_of(machine))[:-1]
    queue = EndlessQueue(program)
    return Controller(machine, queue, Requests(), DeadCard(machine))


class EndlessQueue(Queue):
    """A queue that begins again when it is empty."""

    def __init__(self, program: NDArray[np.void]):
        super().__init__()
        self.program = program
        self.taken = 0

    def take(self, command: Command) -> bool:
        if not len(self):
            self.put(self.program)
        self.taken += 1
        return super().take(command)


def ticks_us(name: str, count: int = MOVING) -> float:
    """CPU microseconds of one tick, with so many axes in long moves."""
    m = axes_moving(name, LONG_STEPS, count)
    spent_us = _per_call_us(lambda: tick(m))
    assert not m.fault, "the job ended before the measurement"
    return spent_us


def empty_call_us() -> float:
    """CPU microseconds of calling an empty function, in the same loop."""
    return _per_call_us(lambda: None)


def bytecodes(name: str) -> dict[str, float]:
    """Bytecodes that one tick runs with three axes in long moves, by the function they belong to."""
    m = axes_moving(name, LONG_STEPS)
    counted: Counter[str] = Counter()

    def trace(frame: FrameType, event: str, _argument: object) -> Any:
        if event == "call":
            frame.f_trace_lines, frame.f_trace_opcodes = False, True
        elif event == "opcode":
            counted[frame.f_code.co_qualname] += 1
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    for _ in range(COUNTED_TICKS):
        tick(m)
    sys.settrace(before)
    assert not m.fault, "the job ended before the measurement"
    return {function: count / COUNTED_TICKS for function, count in counted.most_common()}


def blocks_kept(name: str) -> float:
    """Memory blocks kept by 20,000 ticks of short moves, for each command: the least of three such windows.

    What a tick or a command keeps it keeps in every window, and is 1 at the least; the caches of the interpreter and
    of numpy still move by some blocks a window.
    """
    m = axes_moving(name, SHORT_STEPS)
    queue = m.queue
    assert isinstance(queue, EndlessQueue)
    marks = [(_blocks_after(m, ticks), queue.taken) for ticks in (WARM_UP_TICKS, *[WINDOW_TICKS] * 3)]
    return min((after - before) / (last - first) for (before, first), (after, last) in pairwise(marks))


def _blocks_after(m: Controller, ticks: int) -> int:
    for _ in range(ticks):
        tick(m)
    gc.collect()
    return sys.getallocatedblocks()


def _per_call_us(call: Callable[[], None]) -> float:
    started = process_time_ns()
    for _ in range(WINDOW_TICKS):
        call()
    return (process_time_ns() - started) / 1000 / WINDOW_TICKS


def print_bytecodes() -> None:
    """Prints the bytecodes of a tick, a line a machine, and those of each function that has more than one a tick."""
    for name in MACHINES:
        counts = bytecodes(name)
        print(f"{name:20} {sum(counts.values()):7.1f} bytecodes a tick")
        for function, count in counts.items():
            if count >= 1:
                print(f"    {function:32} {count:7.1f}")


def main() -> int:
    """Prints a line a machine; 1 where a target is missed."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.tick_cost", description="What one tick costs.")
    parser.add_argument("--bytecodes", action="store_true", help="count bytecodes instead of time")
    if parser.parse_args().bytecodes:
        print_bytecodes()
        return 0
    empty_us = median(empty_call_us() for _ in range(RUNS))
    print(f"python {sys.version.split()[0]}, numpy {np.__version__}, load {os.getloadavg()[0]:.2f}")
    print(f"an empty call {empty_us:.3f} us; {WINDOW_TICKS} ticks, median of {RUNS}")
    missed = False
    for name in MACHINES:
        cost_us = median(ticks_us(name) for _ in range(RUNS))
        kept = blocks_kept(name)
        missed = missed or cost_us >= TARGET_US or kept >= MOST_KEPT
        calls = cost_us / empty_us
        print(f"{name:20} {cost_us:6.2f} us a tick, {calls:4.0f} empty calls, {kept:.3f} blocks kept a command")
    cost_us = median(ticks_us(MACHINES[-1], MOST_MOVING) for _ in range(RUNS))
    missed = missed or cost_us >= TARGET_US
    print(f"{MACHINES[-1]}, {MOST_MOVING} axes {cost_us:6.2f} us a tick, {cost_us / empty_us:4.0f} empty calls")
    return int(missed)


if __name__ == "__main__":
    sys.exit(main())
