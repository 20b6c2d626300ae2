"""What the ticker's process runs: the tick, paced by the clock, with a beat, a status and an eye on the desk.

Rule: a tick is run where there is something to do; else the inputs are looked at now and then, which is no tick. Every
wake publishes a beat. Whatever this process does to the machine of its own accord, it asks for as a request, so that
the trace has it. Forked by paced.
"""

import os
import signal
import struct
import time
from contextlib import suppress

from drillctl.execution import drop_forcing, look
from drillctl.execution.clock import PacedClock
from drillctl.execution.conditions import raise_fault
from drillctl.kmd import Condition, Fault, Request
from drillctl.kmd.channel import Channel, SharedGate, SharedQueue, SharedRequests
from drillctl.kmd.commands import MOST_AXES
from drillctl.machine import Machine
from drillctl.plant import Plant
from drillctl.ports import Driver, PortSlow
from drillctl.ticker.confirmed_status import VouchedStatus
from drillctl.ticker.realtime import become_punctual
from drillctl.ticker.table_loading import TableSlot, take_tables
from drillctl.ticker.ticker import Ticker
from drillctl.trace.ring import RingRecorder

DESK_HOLD_NS = 400_000_000  # the desk's silence after which a moving machine is held
DESK_SAFE_NS = 800_000_000  # and after which the outputs go off
LOOK_NS = 20_000_000  # at rest the sensors are looked at so often
DESK_IDLE_NS = 60_000_000_000  # a screen's, at rest and without a job, may be busy so long: a large board is planned
TOUCH = struct.Struct(f"<iiq{MOST_AXES}d")  # tool, tag, axes, places; below PIPE_BUF, so written whole
LONGEST_NOTICE = 1000  # characters; below PIPE_BUF, so written whole
IGNORED = (signal.SIGINT, signal.SIGHUP, signal.SIGQUIT, signal.SIGTSTP)  # they are the desk's


class PacedTicker:
    """The body of the ticker's process. Made by the desk, its parent; ``touches`` and ``notices`` are pipes' ends."""

    def __init__(self, machine: Machine, port: Driver, plant: Plant | None, channel: Channel, slot: TableSlot,
                 ring: RingRecorder | None, derived: bool, touches: int, notices: int, idle_ns: int):  # fmt: skip
        self.channel, self.port, self.slot = channel, port, slot
        self.touch_end, self.notice_end = touches, notices
        self.idle_ns = idle_ns
        self.queue, self.requests = SharedQueue(channel), SharedRequests(channel)
        self.gate = SharedGate(channel)
        self.ticker = Ticker(
            machine, port, plant, ring is not None, derived,
            queue=self.queue, requests=self.requests, gate=self.gate, keeper=ring,
        )  # fmt: skip
        self.vouched = VouchedStatus(port)
        self.looked_ns = 0
        self.spared = False  # a real machine's clock stands still, and its forcing was taken off
        self.desk = os.getpid()

    def run(self) -> None:
        """Until the desk gives leave, dies, or the port is lost. The outputs are safe afterwards."""
        for number in IGNORED:
            signal.signal(number, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, lambda number, frame: self.requests.own.post(Request.STOP))
        try:
            self._notice(*(f"not real-time: {reason}" for reason in become_punctual()))
            self._tick_on()
        finally:
            with suppress(OSError):  # then the guard tries too
                self.port.safe()
                self.channel["ended"] = 1

    def _tick_on(self) -> None:
        clock = PacedClock(self.ticker.machine.tick_hz)
        while not self.channel["leave"] and not self._desk_is_lost():
            gap = clock.wait()
            try:
                if self.slot.waiting:
                    self._load()
                elif self._is_wanted():
                    m = self.ticker.controller
                    harmless = min(axis.interval[0] for axis in m.axes)  # a gap so short is no news to any motor
                    m.gap = gap if gap > harmless else 0
                    if m.gap and self.ticker.plant is None:
                        self.requests.own.post(Request.PAUSE)  # real motors have stood still for so long
                    self.ticker.late(clock.late, clock.worst_ns)
                    self._go_on()
                    self.ticker.advance(1)
                    self._follow_rate(clock)
                else:
                    self._stand(clock.begun_ns)
            except OSError as error:
                self._notice(" ".join(str(error).split())[:LONGEST_NOTICE])
                self._end_by(Fault.PORT_SLOW if isinstance(error, PortSlow) else Fault.PORT_LOST)
                return
            self._publish()

    def _notice(self, *sentences: str) -> None:
        """For the operator, beside the status."""
        os.write(self.notice_end, "".join(f"{sentence}\n" for sentence in sentences).encode())

    def _stand(self, now_ns: int) -> None:
        """A wake that is no tick: the inputs are looked at now and then. The time of real motors can't be stopped."""
        if self.ticker.waits and self.ticker.plant is None and not self.spared:
            self.spared = True
            drop_forcing(self.ticker.controller)
        if now_ns - self.looked_ns >= LOOK_NS:
            self.looked_ns = now_ns
            look(self.ticker.controller)

    def _is_wanted(self) -> bool:
        """At rest, with nothing to do, the current is held and no tick is counted. What is latched takes no command."""
        if self.ticker.waits:
            return False
        takes = self.ticker.controller.condition != Condition.LATCHED
        asked = self.requests.waiting or self.gate.left > 0 or self.ticker.controller.hot_until > 0
        return not self.ticker.over() or asked or (takes and len(self.queue) > 0)

    def _follow_rate(self, clock: PacedClock) -> None:
        """After a PACE. Whoever watches the beat knows of a longer period before it is waited for."""
        period_ns = clock.period_ns
        clock.set_rate(self.ticker.machine.tick_hz)
        if clock.period_ns != period_ns:
            self.channel["tick_ns"] = clock.period_ns

    def _load(self) -> None:
        """Edited tables; the next tick, which has nothing else to do, tells the trace of them."""
        reason = take_tables(self.ticker, self.slot.text())
        if not reason:
            self.requests.own.post(Request.LOAD)
        self.slot.answer(reason)

    def _go_on(self) -> None:
        """A clock that stood still goes on."""
        if self.spared:
            self.spared = False
            self.requests.own.post(Request.PAUSE)

    def _publish(self) -> None:
        self.channel["ticker_beat_ns"] = time.monotonic_ns()
        if (status := self.vouched.newest(self.ticker.report())) is not None:
            self.channel.publish(status)
        self._tell_touches()

    def _tell_touches(self) -> None:
        for tool, tag, places in self.ticker.touched:
            padded = (*places, *[0.0] * (MOST_AXES - len(places)))
            os.write(self.touch_end, TOUCH.pack(tool, tag, len(places), *padded))
        self.ticker.touched.clear()

    def _desk_is_lost(self) -> bool:
        """Holds a moving machine first; True when the outputs must go off: of a dead desk as soon as nothing moves."""
        m = self.ticker.controller
        silent_ns = time.monotonic_ns() - self.channel["desk_beat_ns"]
        dead = os.getppid() != self.desk
        if (dead or silent_ns > DESK_HOLD_NS) and m.condition == Condition.READY and m.job:
            self.requests.own.post(Request.HOLD)
        patience_ns = DESK_SAFE_NS if m.job or m.moving else self.idle_ns
        if silent_ns <= patience_ns and not (dead and not m.moving):
            return False
        self._end_by(Fault.HEARTBEAT_LOST)
        return True

    def _end_by(self, fault: Fault) -> None:
        """A fault from beside the tick, which then has no further turn; the outputs go off in ``run``."""
        raise_fault(self.ticker.controller, fault)
        self.channel.publish(self.vouched.last(self.ticker.report()))
        self._tell_touches()
