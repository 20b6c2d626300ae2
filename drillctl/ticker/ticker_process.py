"""What the ticker's process runs: ticks paced by the clock; it publishes heartbeat and status, and watches the desk.

Rule: a tick is run where there is something to do; else the inputs are looked at now and then, which is no tick. Every
wake publishes a heartbeat. Whatever this process does to the machine of its own accord is made as a request, so that
the trace has it. Forked by paced_link.py.
"""

import os
import signal
import struct
import time
from contextlib import suppress

from drillctl.execution import drop_forcing, look
from drillctl.execution.clock import PacedClock
from drillctl.execution.conditions import raise_fault
from drillctl.files import system
from drillctl.kmd import Condition, Fault, Request
from drillctl.kmd.channel import Channel, SharedGate, SharedQueue, SharedRequests
from drillctl.kmd.commands import MOST_AXES
from drillctl.language import Message, message_of
from drillctl.machine import Machine
from drillctl.plant import Plant
from drillctl.ports import Driver, PortSlow, make_safe
from drillctl.ticker.confirmed_status import ConfirmedStatus
from drillctl.ticker.converter.card import carried
from drillctl.ticker.edited_tables import TableSlot, take_tables
from drillctl.ticker.message_text import message_text
from drillctl.ticker.realtime import become_punctual
from drillctl.ticker.sliced_clock import SlicedClock
from drillctl.ticker.ticker import Ticker
from drillctl.trace.ring import RingRecorder

DESK_HOLD_NS = 400_000_000  # the desk's silence after which a moving machine is held
DESK_SAFE_NS = 800_000_000  # and after which the outputs go off
SLICE_NS = 60_000_000  # a slice of ticks takes no longer, so that heartbeat and status go on
LOOK_NS = 20_000_000  # at rest the sensors are read so often
DESK_IDLE_NS = 60_000_000_000  # a screen's, at rest and without a job, may be busy so long: a large board is planned
STATUS_NS = 900_000  # the desk reads a hundred times a second: up to 1 kHz each tick has its record, above some
DESK_TURN_NS = 20_000_000  # a desk that lives has beaten since, mostly: its process need not be asked after
TOUCH = struct.Struct(f"<iiii{MOST_AXES}d")  # tool, tag, axis, axes, places; below PIPE_BUF, so written whole
IGNORED = system.signals("SIGINT", "SIGHUP", "SIGQUIT", "SIGTSTP")  # they are the desk's


class TickerProcess:
    """The body of the ticker's process, made by its parent, the desk, before the fork.

    touches, notices  file descriptors: ends of pipes to the desk
    idle_ns           how long the desk may be silent at rest, without a job
    sliced            by the simulated clock (sliced_clock.py): of a simulated machine on a screen
    """

    def __init__(self, machine: Machine, port: Driver, plant: Plant | None, channel: Channel, slot: TableSlot,
                 ring: RingRecorder | None, derived: bool, touches: int, notices: int, idle_ns: int,
                 sliced: bool = False):  # fmt: skip
        self.channel, self.port, self.slot = channel, port, slot
        self.touch_end, self.notice_end = touches, notices
        self.idle_ns, self.sliced = idle_ns, sliced
        self.queue, self.requests = SharedQueue(channel), SharedRequests(channel)
        self.gate = SharedGate(channel)
        self.ticker = Ticker(
            machine, port, plant, ring is not None, derived,
            queue=self.queue, requests=self.requests, gate=self.gate, keeper=ring,
        )  # fmt: skip
        self.vouched = ConfirmedStatus(carried(port))
        self.looked_ns = self.published_ns = 0
        self.spared = False  # a real machine's clock stands still, and its forcing was taken off
        self.desk = os.getpid()

    def run(self) -> None:
        """Ticks until the desk says leave or is lost, or the port is lost. Makes the outputs safe on every way out."""
        for number in IGNORED:
            signal.signal(number, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, lambda number, frame: self.requests.own.post(Request.STOP))
        try:
            self._notice(*(Message("not real-time: {why}", why=reason) for reason in become_punctual()))
            self._tick_on()
        finally:
            with suppress(OSError):  # then the guard tries too
                make_safe(self.port, self.ticker.controller.safe_image)
                self.channel["ended"] = 1

    def _tick_on(self) -> None:
        clock = self._clock()
        while not self.channel["leave"] and not self._desk_is_lost():
            gap = clock.wait()
            try:
                if self.slot.waiting:
                    self._load()
                elif self._is_wanted():
                    if gap:
                        self._note_gap(gap)
                    self.ticker.late(clock.late, clock.worst_ns)
                    self._go_on()
                    self._advance(clock)
                    self._follow_rate(clock)
                else:
                    self._stand(clock.begun_ns)
                    clock.rest()
            except OSError as error:
                self._notice(message_of(error))
                self._end_by(Fault.PORT_SLOW if isinstance(error, PortSlow) else Fault.PORT_LOST)
                return
            self._publish()

    def _note_gap(self, gap: int) -> None:
        """Has the next tick serve a gap of so many periods, unless it is so short that it is no news to any motor."""
        m = self.ticker.controller
        m.gap = gap if gap > min(axis.interval[0] for axis in m.axes) else 0
        if m.gap and self.ticker.plant is None:
            self.requests.own.post(Request.PAUSE)  # real motors have stood still for so long

    def _clock(self) -> PacedClock | SlicedClock:
        return (SlicedClock if self.sliced else PacedClock)(self.ticker.machine.tick_hz)

    def _advance(self, clock: PacedClock | SlicedClock) -> None:
        """One tick; by the simulated clock a slice of them, as long as they are wanted and the rate stays."""
        self.ticker.advance(1)
        if isinstance(clock, SlicedClock):
            self.ticker.status["pace_percent"] = clock.pace
            until_ns, tick_hz = time.monotonic_ns() + SLICE_NS, self.ticker.machine.tick_hz
            ran = 1
            while ran < clock.ticks and time.monotonic_ns() < until_ns:
                passed = self.ticker.pass_counting(clock.ticks - ran - 1)
                if not passed and (not self._is_wanted() or self.ticker.machine.tick_hz != tick_hz):
                    return
                self.ticker.advance(1)
                ran += passed + 1
            clock.ran(ran)

    def _notice(self, *messages: Message) -> None:
        """Sends messages for the operator, a line each."""
        for message in messages:
            os.write(self.notice_end, f"{message_text(message)}\n".encode())

    def _stand(self, now_ns: int) -> None:
        """A wake that is no tick: reads the inputs every LOOK_NS. While the clock of a real machine is stopped, its
        forcing is taken off, since its windings heat all the same.
        """
        if self.ticker.waits and self.ticker.plant is None and not self.spared:
            self.spared = True
            drop_forcing(self.ticker.controller)
        if now_ns - self.looked_ns >= LOOK_NS:
            self.looked_ns = now_ns
            look(self.ticker.controller)

    def _is_wanted(self) -> bool:
        """Whether this wake is to be a tick: there is a command, a request, a move, or a winding to be cooled."""
        if self.ticker.waits:
            return False
        if not self.ticker.over() or self.requests.waiting:
            return True
        takes = self.ticker.controller.condition != Condition.LATCHED
        return self.gate.left > 0 or self.ticker.controller.hot_until > 0 or (takes and len(self.queue) > 0)

    def _follow_rate(self, clock: PacedClock | SlicedClock) -> None:
        """Paces by the rate in force after a PACE. The period is published, as the guard's patience depends on it."""
        period_ns = clock.period_ns
        clock.set_rate(self.ticker.machine.tick_hz)
        if clock.period_ns != period_ns:
            self.channel["tick_ns"] = clock.period_ns

    def _load(self) -> None:
        """Takes edited tables and answers the desk; a request in the next tick marks them in the trace."""
        reason = take_tables(self.ticker, self.slot.text())
        if reason is None:
            self.requests.own.post(Request.LOAD)
        self.slot.answer(reason)

    def _go_on(self) -> None:
        """After a stopped clock, notes in the trace that real motors have stood still."""
        if self.spared:
            self.spared = False
            self.requests.own.post(Request.PAUSE)

    def _publish(self) -> None:
        """After each wake the heartbeat, what is safe now and the ticks; the status record where the last is old."""
        self.channel["ticker_beat_ns"] = now_ns = time.monotonic_ns()
        self.channel["safe_image"] = self.ticker.controller.safe_image
        self.channel["ticks"] = self.ticker.controller.tick
        self._tell_touches()
        if now_ns - self.published_ns >= STATUS_NS:
            self.published_ns = now_ns
            if (status := self.vouched.newest(self.ticker.report())) is not None:
                self.channel.publish(status)

    def _tell_touches(self) -> None:
        for tool, tag, places, axis in self.ticker.touched:
            padded = (*places, *[0.0] * (MOST_AXES - len(places)))
            os.write(self.touch_end, TOUCH.pack(tool, tag, axis, len(places), *padded))
        self.ticker.touched.clear()

    def _desk_is_lost(self) -> bool:
        """Whether the outputs must go off: the desk was silent for too long, or is dead and nothing moves any more.
        Holds the job before it comes to that.
        """
        m = self.ticker.controller
        silent_ns = time.monotonic_ns() - self.channel["desk_beat_ns"]
        dead = silent_ns > DESK_TURN_NS and os.getppid() != self.desk
        if (dead or silent_ns > DESK_HOLD_NS) and m.condition == Condition.READY and m.job:
            self.requests.own.post(Request.HOLD)
        patience_ns = DESK_SAFE_NS if m.job or m.moving else self.idle_ns
        if silent_ns <= patience_ns and not (dead and not m.moving):
            return False
        self._end_by(Fault.HEARTBEAT_LOST)
        return True

    def _end_by(self, fault: Fault) -> None:
        """Raises a fault outside a tick, and publishes it as the last status; the outputs go off in ``run``."""
        raise_fault(self.ticker.controller, fault)
        self.channel.publish(self.vouched.last(self.ticker.report()))
        self._tell_touches()
