"""How punctual the ticks of an idle or a moving machine are on this computer, and whose fault it is when they are not.

    ticker   a process that ticks the machine as a paced run does, on the simulated card
    canary   a process on each processor used, with the same rights: sleeps to its deadlines and does nothing else

Rule: the canaries wake up twice a period. What delays them together with the ticker for a period, they notice as half a
period at least: such a late tick is the platform's fault, any other is ours. Every way out ends the children. Linux.
"""

import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.clock import PacedClock
from drillctl.lab.grades import GOOD_SHARE, Finding, carried_hz, grade
from drillctl.lab.wakeups import MOST_TEXT, WakeupLog, bars, covered_ns, lateness, overlapping, quantile_us
from drillctl.language import Message, Refusal
from drillctl.machine import Machine
from drillctl.ticker.child_process import ChildProcess
from drillctl.ticker.realtime import become_punctual
from drillctl.ticker.ticker import Ticker
from drillctl.viewmodel.reports import LatencyReport

MOST_PROCESSORS = 4  # the ticker stays on these, so that a canary sees whatever stops it
CANARY_WAKEUPS = 2  # a period
WARM_UP_TICKS = 200
TURN_S = 0.05
START_S = 10.0
LEAVE_S = 2.0


class LatencyError(Refusal):
    """Nothing could be measured on this computer; ``str()`` says why."""

    kind = "latency"


def a_moment() -> bool:
    """Sleeps for TURN_S and returns False: the default of ``measure``'s ``meanwhile``."""
    time.sleep(TURN_S)
    return False


def measure(
    machine: Machine, seconds: float, meanwhile: Callable[[], bool] = a_moment, moves: NDArray[np.void] | None = None
) -> LatencyReport:
    """Ticks ``machine`` for so long and reports. ``meanwhile`` is called over and over; True from it ends that early.
    ``moves``: commands that it runs all the time, from the second one on again and again; None: it is idle.

    Raises LatencyError.
    """
    if not sys.platform.startswith("linux"):
        raise LatencyError(Message("latency is measured on Linux only"))
    processors = sorted(os.sched_getaffinity(0))[:MOST_PROCESSORS]
    log, canaries = WakeupLog(), [WakeupLog() for _ in processors]
    interrupted = False
    with _children() as start:
        for processor, canary in zip(processors, canaries, strict=True):
            start(canary, partial(run_canary, canary, machine.tick_hz, seconds, processor))
        ticker = start(log, partial(run_ticker, log, machine, seconds, processors, moves))
        for each in (*canaries, log):
            each.record["go"] = 1
        while not ticker.gone and not interrupted:
            interrupted = meanwhile()
    if not log.wakeups or not log.record["to_ns"]:
        raise LatencyError(
            Message("no figures: the ticker's process was ended, or died, after {wakeups} ticks", wakeups=log.wakeups)
        )
    return _report(machine, log, canaries, interrupted, moves is not None)


@contextmanager
def _children() -> Iterator[Callable[[WakeupLog, Callable[[], None]], ChildProcess]]:
    """Yields a function that starts a child and waits until it is ready; ends all children afterwards."""
    children: list[tuple[ChildProcess, WakeupLog]] = []

    def start(log: WakeupLog, body: Callable[[], None]) -> ChildProcess:
        child = ChildProcess(body)
        children.append((child, log))
        until_s = time.monotonic() + START_S
        while not log.record["ready"]:
            if child.gone:
                raise LatencyError(Message("no figures: a process was ended, or died, before it began"))
            if time.monotonic() > until_s:
                raise LatencyError(
                    Message(
                        "a process did not begin within {start_s:.0f} s: is the computer overloaded?", start_s=START_S
                    )
                )
            time.sleep(TURN_S / 10)
        return child

    try:
        yield start
    finally:
        for _, log in children:
            log.record["leave"] = 1
        for child, _ in children:
            child.end(LEAVE_S)


def run_ticker(
    log: WakeupLog, machine: Machine, seconds: float, processors: list[int], moves: NDArray[np.void] | None
) -> None:
    """The body of the ticker's process."""
    ticker = Ticker.simulated(machine)
    ticker.run(WARM_UP_TICKS)
    if moves is not None:
        ticker.queue.put(moves)

    def tick_once() -> None:
        if moves is not None and not len(ticker.queue):
            ticker.queue.put(moves[1:])
        ticker.run(1)

    _prepare(log, processors)
    pace(log, machine.tick_hz, seconds, tick_once)


def run_canary(log: WakeupLog, tick_hz: int, seconds: float, processor: int) -> None:
    """The body of a canary's process, which runs until its parent wants it to leave."""
    _prepare(log, [processor])
    pace(log, tick_hz * CANARY_WAKEUPS, seconds + LEAVE_S, lambda: None)


def _prepare(log: WakeupLog, processors: list[int]) -> None:
    """Becomes real-time where allowed, on these processors, says ready and waits for go."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # the parent's handler is not for us
    os.sched_setaffinity(0, processors)
    log.record["refused"] = "\n".join(become_punctual()).encode()[:MOST_TEXT]
    log.record["ready"] = 1
    while log.wanted and not log.record["go"]:
        time.sleep(TURN_S / 10)


def pace(log: WakeupLog, tick_hz: int, seconds: float, body: Callable[[], object]) -> None:
    """Calls ``body`` at each deadline and logs the wakeups, for so long or until the parent is gone."""
    record = log.record
    spent_ns = time.process_time_ns()
    clock = PacedClock(tick_hz)
    until_ns = clock.begun_ns + int(seconds * 1e9)
    record["from_ns"] = clock.begun_ns
    while log.wanted and clock.deadline_ns <= until_ns:
        clock.wait()
        log.add(clock.begun_ns, clock.late_ns, clock.period_ns)
        body()
    record["cpu_ns"] = time.process_time_ns() - spent_ns
    record["to_ns"] = time.monotonic_ns()


def _report(
    machine: Machine, log: WakeupLog, canaries: list[WakeupLog], interrupted: bool, moving: bool = False
) -> LatencyReport:
    record, ticks = log.record, lateness([log])
    elapsed_ns, cpu_ns, late = log.elapsed_ns, int(record["cpu_ns"]), int(record["late_wakeups"])
    spans, held = log.late_spans(), np.concatenate([canary.late_spans() for canary in canaries])
    platform = int(overlapping(spans, held).sum())
    refused = tuple(bytes(record["refused"]).decode(errors="replace").splitlines())
    carries_hz = carried_hz(quantile_us(record["counts"], 1 - GOOD_SHARE), cpu_ns / 1000 / ticks.wakes)
    finding = Finding(
        late_share=late / ticks.wakes,
        longest_ms=ticks.max_us / 1000,
        real_time=not refused,
        platform_share=platform / max(1, len(spans)),
        tick_hz=machine.tick_hz,
        carries_hz=carries_hz,
    )
    return LatencyReport(
        machine=machine.name,
        tick_hz=machine.tick_hz,
        seconds=elapsed_ns / 1e9,
        ticker=ticks,
        canary=lateness(canaries),
        canary_late_share=covered_ns(held, int(record["from_ns"]), int(record["to_ns"])) / elapsed_ns,
        late=late,
        platform=platform,
        ours=len(spans) - platform,
        unlabelled=late - len(spans),
        cpu_share=cpu_ns / elapsed_ns,
        refused=refused,
        histogram=bars(record["counts"]),
        carries_hz=carries_hz,
        grade=grade(finding),
        interrupted=interrupted,
        moving=moving,
    )
