"""Wiring: the process that makes the outputs safe when the ticker can't. Started before it, ends after it.

Rule: it does one thing. When the ticker's process has ended without saying so, or its heartbeat stands still, the
ticker is killed first and the driver's safe image written then, so that nobody writes after it.
"""

import os
import select
import signal
import time
from contextlib import suppress

from drillctl.kmd.channel import Channel
from drillctl.ports import Driver

SILENCE_NS = 500_000_000
LOOK_EVERY_MS = 20
LONGEST_WAIT_S = 10.0
IGNORED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def run_guard(channel: Channel, port: Driver) -> None:
    """Watches until the ticker has ended, one way or the other. The body of the guard's process."""
    for number in IGNORED:
        signal.signal(number, signal.SIG_IGN)
    ticker = _wait_for_ticker(channel)
    if ticker is None:
        port.safe()
        return
    while not channel["ended"]:
        if _gone(ticker, LOOK_EVERY_MS) or _silent(channel):
            if not channel["ended"]:
                _make_safe(channel, ticker, port)
            return


def _wait_for_ticker(channel: Channel) -> int | None:
    """A handle on the ticker's process, once the desk has named it; None where it never came."""
    until_s = time.monotonic() + LONGEST_WAIT_S
    while time.monotonic() < until_s:
        if channel["ticker_pid"]:
            with suppress(ProcessLookupError):
                return os.pidfd_open(channel["ticker_pid"])
            return None
        time.sleep(LOOK_EVERY_MS / 1000)
    return None


def _gone(ticker: int, wait_ms: int) -> bool:
    """Whether the process behind the handle has ended; waits so long for that."""
    poll = select.poll()
    poll.register(ticker, select.POLLIN)
    return bool(poll.poll(wait_ms))


def _silent(channel: Channel) -> bool:
    return bool(channel["ready"]) and time.monotonic_ns() - channel["ticker_beat_ns"] > SILENCE_NS


def _make_safe(channel: Channel, ticker: int, port: Driver) -> None:
    with suppress(ProcessLookupError):
        signal.pidfd_send_signal(ticker, signal.SIGKILL)
    _gone(ticker, int(LONGEST_WAIT_S * 1000))
    port.safe()
    channel["guarded"] = 1
