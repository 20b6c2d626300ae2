"""The converter's process: follows the wanted speed some eight times a second, and stops the motor on every way out.

Rule: what it finds goes into the shared memory, and from there into the next tick's inputs; it decides nothing about
the job. It outlives ticker and guard until the motor was told to stop, and the desk stops the motor where it can't.
"""

import os
import signal
import time
from collections.abc import Callable
from contextlib import suppress

from drillctl.files.system import signals
from drillctl.kmd.channel import Channel
from drillctl.language import Message
from drillctl.ticker.child_process import ChildProcess
from drillctl.ticker.converter.card import ACTUAL, BEAT, FIRST_TRIES, LEAVE, STOPPED, WANTED, WRONG, ConverterCard
from drillctl.ticker.converter.follower import Follower
from drillctl.ticker.converter.lines import ConverterError
from drillctl.ticker.message_text import message_text

PERIOD_S = 0.12
TICKER_LOST_NS = 2_000_000_000  # neither ticker nor guard: then no speed is wanted any more
LAST_TRIES_S = 3.0  # at the end, to a motor that does not stop or a line that is silent
IGNORED = signals("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGTSTP")
LOST = Message("the converter's process was lost; the job was stopped, see that the spindle stands")


class ConverterProcess:
    """The process of one card's converter, started when this is made.

    notices  file descriptor: an end of a pipe to the desk
    """

    def __init__(self, card: ConverterCard, channel: Channel, notices: int):
        self._card = card
        self._child = ChildProcess(lambda: _run(card, channel, notices))
        self._told = False

    def look(self) -> bool:
        """Returns whether it was lost just now; then the motor is stopped from here."""
        if self._told or not self._child.gone:
            return False
        self._told = True
        self._stop_from_here()
        return True

    @property
    def lost(self) -> bool:
        """Whether it was lost at some time."""
        return self._told

    def end(self, meanwhile: Callable[[], object]) -> None:
        """Lets it stop the motor and leave. To be called after the ticker has ended."""
        self._card.shared[LEAVE] = 1
        self._child.end(LAST_TRIES_S + 1, meanwhile)
        if not self._card.shared[STOPPED]:
            self._stop_from_here()
        self._card.line.close()

    def _stop_from_here(self) -> None:
        self._card.shared[WRONG] = 1
        for _ in range(FIRST_TRIES):
            with suppress(ConverterError):
                self._card.line.stop()
                return
            with suppress(ConverterError):
                self._card.line.reopen()


def _run(card: ConverterCard, channel: Channel, notices: int) -> None:
    """The body of the process."""
    for number in IGNORED:
        signal.signal(number, signal.SIG_IGN)
    desk, shared = os.getppid(), card.shared
    follower = Follower(card.line, card.spindle, card.greatest_hz, time.monotonic())
    told: Message | None = None
    leaving_s: float | None = None
    while True:
        begun_s = time.monotonic()
        ends = shared[LEAVE] or _alone(channel, desk)
        said = follower.turn(0 if ends else shared[WANTED], begun_s)
        shared[ACTUAL], shared[WRONG], shared[STOPPED] = said.rev_min, said.wrong is not None, said.stopped
        shared[BEAT] = time.monotonic_ns()
        if said.wrong != told:
            told = said.wrong
            wrong = Message("converter: {why}; a job is held", why=told) if told else None
            _tell(notices, wrong or Message("converter: it answers as it should again; a job that was held can go on"))
        if ends:
            leaving_s = leaving_s or begun_s
            if said.stopped or begun_s - leaving_s > LAST_TRIES_S:
                return
        time.sleep(max(0.0, begun_s + PERIOD_S - time.monotonic()))


def _alone(channel: Channel, desk: int) -> bool:
    """Whether nobody wants a speed any more: the ticker has ended or was killed, or stands still and no guard acts."""
    if os.getppid() == desk and not channel["guarded"]:
        return False
    silent_ns = time.monotonic_ns() - channel["ticker_beat_ns"] - channel["tick_ns"]
    return bool(channel["ended"] or channel["guarded"] or silent_ns > TICKER_LOST_NS)


def _tell(notices: int, message: Message) -> None:
    with suppress(OSError):  # the desk is gone
        os.write(notices, f"{message_text(message)}\n".encode())
