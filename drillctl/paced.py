"""Wiring: a ticker in a process of its own, paced by the wall clock, with a guard beside it. Linux.

    desk  ──commands, requests──►  ticker        guard watches the ticker's heartbeat and holds the port too;
          ◄──status, touches─────                the ticker watches the desk's.

Rule: no thread anywhere; the ports are opened before the forks, so that both children can make them safe. Every way
out ends the children, by their ids, with the outputs safe.
"""

import os
import signal
import struct
import sys
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np

from drillctl.execution.clock import PacedClock
from drillctl.execution.stops import hold, raise_fault
from drillctl.guard import run_guard
from drillctl.kmd import STATUS, Fault, Request
from drillctl.kmd.channel import Channel, SharedQueue, SharedRequests
from drillctl.kmd.commands import MOST_AXES
from drillctl.link import Header, Touch
from drillctl.machine import Machine
from drillctl.plant import IdealPlant
from drillctl.ports import Driver
from drillctl.realtime import become_punctual
from drillctl.sampler import signals
from drillctl.ticker import Ticker
from drillctl.trace import Trace
from drillctl.trace.ring import RingRecorder

DESK_HOLD_NS = 400_000_000  # the desk's silence after which a moving machine is held
DESK_SAFE_NS = 800_000_000  # and after which the outputs go off
TURN_S = 0.01
LEAVE_S = 5.0
TOUCH = struct.Struct(f"<iiq{MOST_AXES}d")  # tool, tag, axes, places; below PIPE_BUF, so written whole


class PacedLink:
    """A Link (link.Link) to a ticker in its own process. Raises OSError where it can't be started."""

    def __init__(self, machine: Machine, port: Driver, plant: IdealPlant | None, file: Path, traced: bool, derived: bool):
        self.machine, self.measured = machine, plant is not None
        self._channel = Channel(file, create=True)
        self.queue = SharedQueue(self._channel)
        self._requests = SharedRequests(self._channel)
        self._signals = signals(machine, plant is not None, derived) if traced else None
        self._ring = RingRecorder(len(self._signals)) if self._signals else None
        self._changes: list[np.ndarray] = []
        self._pipe, touch_end = os.pipe()
        os.set_blocking(self._pipe, False)
        self._notices, notice_end = os.pipe()
        self._port = port
        self._channel["desk_beat_ns"] = time.monotonic_ns()
        self._guard = _fork(lambda: run_guard(self._channel, port))
        self._ticker = _fork(
            lambda: _Body(machine, port, plant, self._channel, self._ring, derived, touch_end, notice_end).run()
        )
        self._channel["ticker_pid"] = self._ticker
        os.close(touch_end)
        os.close(notice_end)
        self._lost = 0
        self._unguarded = False

    def post(self, request: Request) -> None:
        """Overtakes the queue."""
        self._requests.post(request)

    def turn(self) -> None:
        """A moment of wall-clock time; says that the desk lives, and sees whether the ticker does."""
        self._channel["desk_beat_ns"] = time.monotonic_ns()
        self._drain()
        if not self._lost and _ended(self._ticker) and not self._channel["ended"]:
            self._lost = Fault.TICKER_LOST
        if not self._unguarded and _ended(self._guard) and not self._channel["ended"]:
            self._unguarded = True
            self.post(Request.STOP)
        time.sleep(TURN_S)

    def status(self) -> np.void:
        """Whole, or the last that was whole."""
        try:
            return self._channel.status()
        except OSError:
            return np.zeros(1, dtype=STATUS)[0]

    def touches(self) -> list[Touch]:
        """From the pipe, as many as have come."""
        found = []
        with suppress(BlockingIOError):
            while data := os.read(self._pipe, TOUCH.size):
                tool, tag, axes, *places = TOUCH.unpack(data)
                found.append(Touch(tool, tag, tuple(places[:axes])))
        return found

    def lost(self) -> int:
        """TICKER_LOST once the ticker has gone without leave."""
        return self._lost

    def trace(self, header: Header) -> Trace | None:
        """What came through the ring. A trace with a hole says so in its trailer, and replay refuses it."""
        if self._ring is None or self._signals is None:
            return None
        self._drain()
        changes = np.concatenate(self._changes) if self._changes else np.zeros(0)
        status = self.status()
        trailer = [f"late {status['late']} worst_ns {status['late_worst_ns']}"]
        overrun = [("overrun", "1")] if self._ring.overrun else []
        columns = (changes["tick"], changes["signal"], changes["value"])
        return Trace.of_changes([*header, *overrun], self._signals, *columns, int(status["tick"]), trailer)

    def notices(self) -> list[str]:
        """What was refused of real-time running, once the ticker has said it."""
        os.set_blocking(self._notices, True)
        refused = [f"not real-time: {line}" for line in os.read(self._notices, 4096).decode().split("\n")[:-1]]
        return [*refused, "the guard's process died; the job was stopped"] if self._unguarded else refused

    def close(self) -> None:
        """Asks the ticker to leave; ends it where it does not; the guard follows it."""
        self._channel["leave"] = 1
        until_s = time.monotonic() + LEAVE_S
        while not _ended(self._ticker) and time.monotonic() < until_s:
            self._channel["desk_beat_ns"] = time.monotonic_ns()
            time.sleep(TURN_S / 5)
        for pid in (self._ticker, self._guard):
            _end(pid, LEAVE_S)
        self._port.close()
        os.close(self._pipe)
        os.close(self._notices)

    def _drain(self) -> None:
        if self._ring is not None:
            self._changes.append(self._ring.drain())


class _Body:
    """What the ticker's process runs: the tick, paced, with a beat, a status record and an eye on the desk."""

    def __init__(self, machine: Machine, port: Driver, plant: IdealPlant | None, channel: Channel,
                 ring: RingRecorder | None, derived: bool, touches: int, notices: int):  # fmt: skip
        self.channel, self.port = channel, port
        self.touch_end, self.notice_end = touches, notices
        self.ticker = Ticker(
            machine, port, plant, ring is not None, derived,
            queue=SharedQueue(channel), requests=SharedRequests(channel), keeper=ring,
        )  # fmt: skip
        self.stopping = False

    def run(self) -> None:
        """Until the desk gives leave, dies, or the port is lost. The outputs are safe afterwards."""
        for number in (signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, self._ask_to_stop)
        try:
            os.write(self.notice_end, "".join(f"{notice}\n" for notice in become_punctual()).encode() or b" ")
            os.close(self.notice_end)
            self._tick_on()
        except OSError:
            raise_fault(self.ticker.controller, Fault.PORT_LOST)
            self._publish()
        finally:
            with suppress(OSError):
                self.port.safe()
            self.channel["ended"] = 1

    def _tick_on(self) -> None:
        m, channel = self.ticker.controller, self.channel
        clock = PacedClock(m.machine.tick_hz)
        channel["ready"] = 1
        harmless = min(axis.interval[0] for axis in m.axes)  # a gap so short is no news to any motor
        begun = False
        while not channel["leave"]:
            gap = clock.wait()
            if not (begun and self.ticker.over()):  # then hold the current, and count no tick that is not the job's
                m.gap = gap if gap > harmless else 0
                self.ticker.run(1)
                self.ticker.late(clock.late, clock.worst_ns)
                begun = begun or m.job
            self._publish()
            if self._desk_is_silent():
                return

    def _publish(self) -> None:
        now_ns = time.monotonic_ns()
        self.channel["ticker_beat_ns"] = now_ns
        self.channel.publish(self.ticker.report())
        for tool, tag, places in self.ticker.touched:
            padded = (*places, *[0.0] * (MOST_AXES - len(places)))
            os.write(self.touch_end, TOUCH.pack(tool, tag, len(places), *padded))
        self.ticker.touched.clear()

    def _desk_is_silent(self) -> bool:
        """Holds a moving machine first; True when the outputs must go off."""
        m = self.ticker.controller
        silent_ns = time.monotonic_ns() - self.channel["desk_beat_ns"]
        if silent_ns > DESK_HOLD_NS and m.moving:
            hold(m)
        if silent_ns <= DESK_SAFE_NS:
            return False
        if m.job or m.moving:
            raise_fault(m, Fault.HEARTBEAT_LOST)
            self._publish()
        return True

    def _ask_to_stop(self, number: int, frame: object) -> None:
        self.ticker.requests.post(Request.STOP)


def _fork(body: Callable[[], None]) -> int:
    """A child that runs ``body`` and nothing else of this program. Returns its id."""
    sys.stdout.flush()
    sys.stderr.flush()
    pid = os.fork()
    if pid:
        return pid
    try:
        body()
        os._exit(0)
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(1)


def _ended(pid: int) -> bool:
    """Whether a child has ended; collects it then."""
    try:
        return os.waitpid(pid, os.WNOHANG) != (0, 0)
    except ChildProcessError:
        return True


def _end(pid: int, patience_s: float) -> None:
    """Waits for a child; kills it when it does not end by itself."""
    until_s = time.monotonic() + patience_s
    while not _ended(pid):
        if time.monotonic() > until_s:
            os.kill(pid, signal.SIGKILL)
        time.sleep(TURN_S / 5)
