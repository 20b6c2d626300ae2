"""Notices whether the board on the line was reset: asks it one question at a fixed beat.

A board that was reset (a dip in its supply, its button, a program that opened its line) has forgotten which pins are
inputs, reports nothing and has dropped its outputs. Its greeting shows that where it comes through; else the state of a
pin that a reset makes an output, or a missing answer.

Rule: one question at a time, 2 % of what the line carries, and only in a tick whose image leaves time for it. No line
and no waiting in here.
"""

import time
from collections.abc import Callable, Mapping
from itertools import cycle

from drillctl.language import Message
from drillctl.portio.firmata_protocol import BoardMessage, Firmware, PinState, Version, query_pin
from drillctl.ports import PortLost

SHARE_OF_LINE = 0.02
QUESTION_BYTES = 4
SHORTEST_BEAT_S = 0.01
# A board that starts anew is silent for a second and more; one that works answers at once, behind what waits for it.
# A byte may be lost on the way, so the question is asked more than once.
AGAIN_S, PATIENCE_S = 0.2, 0.8
WAITING_BYTES = 600  # of images in the kernel (firmata_line.MOST_WAITING_BYTES), the question and its answer


class Watch:
    """The watch over one board. ``vouched`` is how many images were put out before its last right answer.

    name     the port as the user named it; errors begin with it
    wanted   the pins that may be asked, with the answer of each, None for any answer (Pins.witnesses)
    byte_s   a byte on the line, in seconds
    tick_s   from one image to the next
    clock    seconds, monotonic
    """

    def __init__(
        self,
        name: str,
        wanted: Mapping[int, PinState | None],
        byte_s: float,
        tick_s: float,
        clock: Callable[[], float] = time.monotonic,
    ):
        self.vouched = 0
        self._name, self._clock = name, clock
        self._wanted = wanted
        self._turns = cycle(wanted)
        self._byte_s, self._tick_s = byte_s, tick_s
        self._beat_s = max(QUESTION_BYTES * byte_s / SHARE_OF_LINE, SHORTEST_BEAT_S)
        self._delay_s = WAITING_BYTES * byte_s
        self._patience_s = PATIENCE_S + self._delay_s
        self._due_s = clock() + self._beat_s
        self._asked: int | None = None  # the pin
        self._asked_s = self._repeat_s = 0.0
        self._asked_after = 0

    def question(self, images: int, image_bytes: int) -> bytes:
        """Returns the bytes to send after the image: a question where one is due, else nothing.

        images       put out so far, this one included
        image_bytes  bytes that this one took of its tick
        """
        now_s = self._clock()
        if self._asked is not None:
            return self._repeated(now_s)
        if now_s < self._due_s:
            return b""
        leaves_time = (image_bytes + QUESTION_BYTES) * self._byte_s <= self._tick_s
        if not leaves_time and now_s < self._due_s + self._beat_s:
            return b""
        self._asked = next(self._turns)
        self._asked_s, self._asked_after = now_s, images
        self._repeat_s = now_s + self._delay_s + AGAIN_S
        self._due_s = now_s + self._beat_s
        return query_pin(self._asked)

    def _repeated(self, now_s: float) -> bytes:
        """Returns the open question once more where its repetition is due, else nothing."""
        if self._asked is None or now_s < self._repeat_s:
            return b""
        self._repeat_s = now_s + self._delay_s + AGAIN_S
        return query_pin(self._asked)

    def hear(self, message: BoardMessage) -> None:
        """Judges a message. Raises PortLost for a greeting, and for a pin that is not as it was set."""
        if isinstance(message, Firmware | Version):
            raise self._lost(Message("the board reported a new start, so it was reset in mid-run"))
        if not isinstance(message, PinState):
            return
        wanted = self._wanted.get(message.pin)
        if wanted is not None and message != wanted:
            raise self._lost(
                Message("D{pin} is not as it was set, so the board was reset in mid-run", pin=message.pin)
            )
        if message.pin == self._asked:
            self.vouched, self._asked = self._asked_after, None

    def check(self) -> None:
        """Raises PortLost where the answer is overdue. Call it after ``hear`` had all messages."""
        if self._asked is not None and self._clock() - self._asked_s > self._patience_s:
            raise self._lost(Message("the board has not answered for {seconds:.1f} s", seconds=self._patience_s))

    def forget(self) -> None:
        """Stops waiting for the answer to a question that may have been dropped."""
        self._asked = None

    def _lost(self, reason: Message) -> PortLost:
        return PortLost(
            self._name, Message("{reason}; check its supply and its cable, then initialise again", reason=reason)
        )
