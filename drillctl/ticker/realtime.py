"""What the operating system can do for punctual ticks, where it is allowed; and what to grant where not.

Rule: never fails; each measure that is refused becomes a sentence.
Measured under load at 500 Hz: real-time scheduling alone brings p99 lateness from some 9 ms to 0.3 ms; exact timers
halve the median where that is refused.
"""

import ctypes
import gc
import os
import sys
import time
from collections.abc import Callable

import numpy as np

from drillctl.execution.clock import PacedClock
from drillctl.kmd import RECORD, Op
from drillctl.language import Message, message_of
from drillctl.machine import Machine
from drillctl.ticker.ticker import Ticker

PRIORITY = 80  # of 99: above what a desktop runs in real time, below the kernel's own watchdogs
MCL_CURRENT = 1
PR_SET_TIMERSLACK = 29
TIMER_SLACK_NS = 1


def become_punctual() -> list[Message]:
    """Takes every measure that is allowed; returns a sentence for each that is not: empty means real-time.

    The garbage collector is off afterwards: for a process whose loop keeps nothing.
    """
    gc.collect()
    gc.freeze()
    gc.disable()
    refused = [(what, _refusal(take), remedy) for what, remedy, take in MEASURES]
    return [
        Message("{what}: {why} ({remedy})", what=what, why=why, remedy=remedy)
        for what, why, remedy in refused
        if why is not None
    ]


def _refusal(take: Callable[[], None]) -> Message | None:
    """Why a measure can't be taken here; None where it was."""
    try:
        take()
    except OSError as error:
        return message_of(error)
    except AttributeError:
        return Message("not on this system")
    return None


def _schedule() -> None:
    """SCHED_FIFO; a user without the right to PRIORITY may have an rtprio limit below it, which is nearly as good."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
    except PermissionError:
        import resource  # where there is such a scheduler there are its limits

        granted, _ = resource.getrlimit(resource.RLIMIT_RTPRIO)
        if not 0 < granted < PRIORITY:
            raise
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(granted))


def _lock_memory() -> None:
    """Locks the memory in use now. Not what is allocated later: within a memlock limit that would fail in mid-run."""
    _libc_call("mlockall", MCL_CURRENT)


def _sharpen_timers() -> None:
    """Without it the kernel may wake an ordinary process 50 us late, to save power."""
    _libc_call("prctl", PR_SET_TIMERSLACK, TIMER_SLACK_NS, 0, 0, 0)


def _libc_call(name: str, *arguments: int) -> None:
    if not sys.platform.startswith("linux"):
        raise OSError(0, Message("not on this system"))
    libc = ctypes.CDLL(None, use_errno=True)
    if getattr(libc, name)(*map(ctypes.c_ulong, arguments)) != 0:
        code = ctypes.get_errno()
        raise OSError(code, os.strerror(code))


MEASURES = (
    (
        Message("real-time scheduling"),
        Message("grant CAP_SYS_NICE, or an rtprio limit of {priority}", priority=PRIORITY),
        _schedule,
    ),
    (Message("locked memory"), Message("grant CAP_IPC_LOCK, or raise the memlock limit"), _lock_memory),
    (Message("exact timers"), Message("they need Linux"), _sharpen_timers),
)


RUNS = 8
TICKS_A_RUN = 50
AMPLE = 4  # times the rate that the ticks alone allow: then no trial is needed
SURE_HZ = 1000  # up to here it is lateness that counts, which each run tells, and not capacity
TRIAL_S = 0.1
MOST_LATE = 0.25  # of the ticks of a trial


def most_ticks_hz(machine: Machine) -> int:
    """Ticks a second that this computer carries with all axes moving, status record included. Beside other work: where
    the machine's rate is not far below what the ticks alone allow, it is tried by the clock, and halved until it goes.
    """
    ticker = _moving(machine)
    hz = int(1 / min(_seconds_a_tick(ticker) for _ in range(RUNS)))
    if hz >= AMPLE * machine.tick_hz:
        return hz
    hz = min(hz, machine.tick_hz)
    while hz > SURE_HZ and _late_share(ticker, hz) > MOST_LATE:
        hz //= 2
    return hz


def _moving(machine: Machine) -> Ticker:
    ticker = Ticker.simulated(machine)
    away = np.zeros(1, dtype=RECORD)
    away["opcode"], away["axes"] = Op.RUCH_D, (1 << len(machine.axes)) - 1
    away["args"][0, : len(machine.axes)] = [axis.span_steps for axis in machine.axes]
    ticker.queue.put(away)
    return ticker


def _seconds_a_tick(ticker: Ticker) -> float:
    begun_s = time.perf_counter()
    for _ in range(TICKS_A_RUN):
        ticker.run(1)
        ticker.report()
    return (time.perf_counter() - begun_s) / TICKS_A_RUN


def _late_share(ticker: Ticker, tick_hz: int) -> float:
    """The share of ticks that begin more than a period late, when paced by the clock for TRIAL_S."""
    clock, ticks = PacedClock(tick_hz), 0
    until_s = time.monotonic() + TRIAL_S
    while ticks == 0 or time.monotonic() < until_s:
        clock.wait()
        ticker.run(1)
        ticker.report()
        ticks += 1
    return clock.late / ticks
