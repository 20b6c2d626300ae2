"""What the guard's process runs: it makes the outputs safe when the ticker can't. Started before it, ends after it.

Rule: it does one thing. When the ticker's process has ended without saying so, or its heartbeat stands still, the
ticker is killed first and the driver's safe image written then, so that nobody writes after it.
"""

import os
import select
import signal
import time
from contextlib import suppress

from drillctl.files import system
from drillctl.kmd.channel import Channel
from drillctl.ports import Driver, make_safe

SILENCE_NS = 500_000_000
LOOK_EVERY_MS = 20
LONGEST_WAIT_S = 10.0
IGNORED = system.signals("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGTSTP")


def run_guard(channel: Channel, port: Driver, silence_ns: int = SILENCE_NS) -> None:
    """The body of the guard's process: watches until the ticker has ended, and makes the outputs safe if it had to.

    silence_ns  how long the ticker's heartbeat may stand still, beyond the length of a tick
    """
    for number in IGNORED:
        signal.signal(number, signal.SIG_IGN)
    ticker = _wait_for_ticker(channel)
    if ticker is None:
        _make_safe(channel, port)
        return
    while not channel["ended"]:
        channel["guard_beat_ns"] = time.monotonic_ns()
        if (_gone(ticker, LOOK_EVERY_MS) or _silent(channel, silence_ns)) and not channel["ended"]:
            channel["guarded"] = 1
            _end(ticker)
            _make_safe(channel, port)
            return


def _wait_for_ticker(channel: Channel) -> int | None:
    """A pidfd of the ticker's process, once the desk has published its id; None where that never comes."""
    until_s, desk = time.monotonic() + LONGEST_WAIT_S, os.getppid()
    while time.monotonic() < until_s and os.getppid() == desk:
        channel["guard_beat_ns"] = time.monotonic_ns()
        if channel["ticker_pid"]:
            with suppress(ProcessLookupError):
                return os.pidfd_open(channel["ticker_pid"])
            return None
        time.sleep(LOOK_EVERY_MS / 1000)
    return None


def _gone(ticker: int, wait_ms: int) -> bool:
    """Whether the process behind the pidfd has ended; waits so long for that."""
    poll = select.poll()
    poll.register(ticker, select.POLLIN)
    return bool(poll.poll(wait_ms))


def _silent(channel: Channel, silence_ns: int) -> bool:
    return time.monotonic_ns() - channel["ticker_beat_ns"] > silence_ns + channel["tick_ns"]


def _end(ticker: int) -> None:
    with suppress(ProcessLookupError):
        signal.pidfd_send_signal(ticker, signal.SIGKILL)
    _gone(ticker, int(LONGEST_WAIT_S * 1000))


def _make_safe(channel: Channel, port: Driver) -> None:
    """Writes the safe image. On a port that is gone that fails; the desk reports it (PORT_LOST, TICKER_LOST)."""
    with suppress(OSError):
        make_safe(port, channel["safe_image"])
