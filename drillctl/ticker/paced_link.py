"""The desk's end of a ticker in a process of its own, paced by the wall clock, with a guard beside it. Linux.

Rule: no threads; the port is opened before the forks, so that desk, ticker and guard can each make it safe. Every way
out ends both children, by their ids, with the outputs safe. ticker/__init__.py has a picture of the three.
"""

import os
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import numpy as np

from drillctl.kmd import Fault, Request
from drillctl.kmd.channel import Channel, SharedGate, SharedQueue, SharedRequests
from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.machine.levels import POWER_ON
from drillctl.plant import Plant
from drillctl.ports import Driver, close_port
from drillctl.ticker.child_process import ChildProcess
from drillctl.ticker.converter.card import ConverterCard
from drillctl.ticker.converter.process import LOST, ConverterProcess
from drillctl.ticker.edited_tables import TableSlot
from drillctl.ticker.guard_process import SILENCE_NS, run_guard
from drillctl.ticker.link import Touch, header_of, held_inputs, hold_input
from drillctl.ticker.message_text import message_read
from drillctl.ticker.sampler import signals
from drillctl.ticker.ticker_process import DESK_IDLE_NS, TOUCH, TickerProcess
from drillctl.trace import Trace
from drillctl.trace.ring import CHANGE, RingRecorder

GUARD_SILENCE_NS = 2 * SILENCE_NS
START_NS = 5_000_000_000  # granted to the ticker before its first beat
TURN_S = 0.01
LEAVE_S = 3.0
LOAD_S = 2.0  # granted to the ticker for checking edited tables
UNGUARDED = Message("the guard's process was lost; the job was stopped")


class PacedLink:
    """A Link (link.Link) to a ticker in its own process. Raises OSError where it can't be started.

    file     the mapped file between the processes, made here
    keeper   a ring that takes the changes of all signals in place of ``trace``; whoever made it empties it
    idle_ns  how long the ticker tolerates the desk's silence at rest, without a job
    sliced   by the simulated clock, in slices of ticks; of a simulated machine
    waits    a turn sleeps for TURN_S; False: whoever calls it waits between two turns
    """

    def __init__(self, machine: Machine, port: Driver, plant: Plant | None, file: Path,
                 traced: bool, derived: bool, keeper: RingRecorder | None = None,
                 idle_ns: int = DESK_IDLE_NS, sliced: bool = False, waits: bool = True):  # fmt: skip
        self.measured = plant is not None
        self.plant_lanes = plant.lanes if plant else ()
        self.plant_header = header_of(plant)
        self._channel = Channel(file, create=True)
        self._status = self._channel.status()
        self.queue = SharedQueue(self._channel)
        self.gate = SharedGate(self._channel)
        self._slot = TableSlot()
        self._requests = SharedRequests(self._channel)
        self._signals = signals(machine, self.plant_lanes, derived) if traced else None
        self._ring = RingRecorder(len(self._signals)) if self._signals else None
        self._changes: list[np.ndarray] = []
        self._port = port
        self._waits = waits
        self._unguarded = False
        self._noticed: list[Message] = []
        self._half_line = b""
        self._channel["tick_ns"] = 1_000_000_000 // machine.tick_hz
        self._channel["safe_image"] = power_on = machine.switched_at(POWER_ON)
        if power_on:
            port.flush(power_on)
        now_ns = self._beat()
        self._channel["guard_beat_ns"], self._channel["ticker_beat_ns"] = now_ns, now_ns + START_NS
        self._guard = ChildProcess(lambda: run_guard(self._channel, port))
        self._touched, touch_end = os.pipe()
        self._notices, notice_end = os.pipe()
        for end in (self._touched, self._notices):
            os.set_blocking(end, False)
        ring, derived = keeper or self._ring, derived or keeper is not None
        body = TickerProcess(
            machine, port, plant, self._channel, self._slot, ring, derived, touch_end, notice_end, idle_ns, sliced
        )
        self._ticker = ChildProcess(body.run)
        self._channel["ticker_pid"] = self._ticker.pid
        self._converter = ConverterProcess(port, self._channel, notice_end) if isinstance(port, ConverterCard) else None
        os.close(touch_end)
        os.close(notice_end)

    def post(self, request: Request) -> None:
        """Makes a request; the next tick serves it."""
        self._requests.post(request)

    def set_output(self, bit: int, value: int) -> bool:
        """Makes the request OUTPUT; False where too many wait."""
        return self._requests.set_output(bit, value)

    def hold_input(self, bit: int, level: int | None) -> bool:
        """Holds an input of the card, in memory that the ticker's process shares."""
        return hold_input(self._port, bit, level)

    @property
    def held_inputs(self) -> int:
        """What is held on the card."""
        return held_inputs(self._port)

    def set_rate(self, tick_hz: int) -> bool:
        """Makes the request PACE; False where too many wait."""
        return self._requests.set_rate(tick_hz)

    def load(self, text: str) -> Message | None:
        """Hands edited tables to the ticker's process and waits for its answer, LOAD_S at most."""
        if not self._slot.offer(text):
            return Message("the tables are too long")
        until_s = time.monotonic() + LOAD_S
        while self._slot.waiting:
            if self._ticker.gone or time.monotonic() > until_s:
                return Message("the ticker does not answer")
            time.sleep(TURN_S)
            self._look()
        return self._slot.reply()

    def turn(self) -> None:
        """Sleeps for TURN_S, unless the caller waits itself, and looks at the processes."""
        if self._waits:
            time.sleep(TURN_S)
        self._look()

    def _look(self) -> None:
        """Beats the desk's heartbeat and checks on the guard. A lost guard stops the job; a ticker that falls silent
        after that is killed here.
        """
        now_ns = self._beat()
        self._drain()
        if self._converter is not None and self._converter.look():
            self.post(Request.STOP)
        if not self._unguarded and not self._channel["ended"] and self._guard_is_lost(now_ns):
            self._unguarded = True
            self._guard.end(patience_s=0)
            self.post(Request.STOP)
        if self._unguarded and now_ns - self._channel["ticker_beat_ns"] > SILENCE_NS + self._channel["tick_ns"]:
            self._ticker.end(patience_s=0)  # in the guard's place; close makes the outputs safe

    def status(self) -> np.void:
        """The newest status record; the one before while the newest is being written."""
        with suppress(OSError):
            self._status = self._channel.status()
        return self._status

    def touches(self) -> list[Touch]:
        """The holes that have come through the pipe since the last call."""
        found = []
        with suppress(BlockingIOError):
            while data := os.read(self._touched, TOUCH.size):
                tool, tag, axis, axes, *places = TOUCH.unpack(data)
                found.append(Touch(tool, tag, tuple(places[:axes]), axis))
        return found

    def lost(self) -> int:
        """TICKER_LOST once the ticker has gone without a fault that says why."""
        return Fault.TICKER_LOST if self._ticker.gone and not self.status()["fault"] else Fault.NONE

    def trace(self, header: Iterable[tuple[str, str]]) -> Trace | None:
        """The trace from the changes that came through the ring. Where some are missing it says so."""
        if self._ring is None or self._signals is None:
            return None
        self._drain()
        status, ticks = self.status(), self._channel["ticks"]
        changes = np.concatenate([np.zeros(0, CHANGE), *self._changes])
        changes = changes[changes["tick"] < ticks]  # a ticker that was killed in a tick has not counted it
        trailer = [f"late {status['late']} worst_ns {status['late_worst_ns']}"]
        overrun = [("overrun", "1")] if self._ring.overrun else []
        columns = (changes["tick"], changes["signal"], changes["value"])
        return Trace.of_changes([*header, *overrun], self._signals, *columns, ticks, trailer)

    def notices(self) -> list[Message]:
        """What the ticker has sent: measures for real time that were refused, why a port was lost; and a lost guard."""
        with suppress(BlockingIOError):
            *lines, self._half_line = (self._half_line + os.read(self._notices, 4096)).split(b"\n")
            self._noticed += map(message_read, lines)
        lost = [LOST] if self._converter is not None and self._converter.lost else []
        return [*self._noticed, *lost, *([UNGUARDED] if self._unguarded else ())]

    def close(self) -> None:
        """Asks the ticker to leave and kills it if it doesn't; the guard ends after it. Then closes the port."""
        self._channel["leave"] = 1
        for child in (self._ticker, self._guard):
            child.end(LEAVE_S, meanwhile=self._beat)
        if self._converter is not None:
            self._converter.end(self._beat)
        with suppress(OSError):  # a port that was lost; the outcome says so
            close_port(self._port, self._channel["safe_image"])
        os.close(self._touched)
        os.close(self._notices)

    def _guard_is_lost(self, now_ns: int) -> bool:
        """Whether the guard has gone or fallen silent while the ticker runs."""
        silent = now_ns - self._channel["guard_beat_ns"] > GUARD_SILENCE_NS
        return (silent or self._guard.gone) and not self._channel["guarded"]

    def _beat(self) -> int:
        now_ns = time.monotonic_ns()
        self._channel["desk_beat_ns"] = now_ns
        return now_ns

    def _drain(self) -> None:
        if self._ring is not None:
            self._changes.append(self._ring.drain())
