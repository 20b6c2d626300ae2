"""A part of a longer piece of work, as a line of text: what is done, how much of it, and the time left."""

import time

from drillctl.language import Message, one_line
from drillctl.language.number_text import clock
from drillctl.language.words import _, translated

SURE_FROM = 0.01  # the share that must be done before the time left is worth showing


class WorkPart:
    """What is done in this part; a call keeps how much of it is done, and of how much."""

    def __init__(self, what: Message):
        self._what, self._began_s = what, time.monotonic()
        self._done = (0, 0)

    def __call__(self, done: int, total: int) -> None:
        """Keeps how much is done, and of how much."""
        self._done = (done, total)

    def line(self, now_s: float) -> str:
        """What is done, with the share and the time left as soon as they are known."""
        (done, total), elapsed_s = self._done, now_s - self._began_s
        what = one_line(translated(self._what))
        if not total * SURE_FROM <= done <= total or not done:
            return _("{what}, {time} so far").format(what=what, time=clock(elapsed_s))
        left = clock(elapsed_s * (total - done) / done)
        return _("{what}: {share:.0%}, {time} left").format(what=what, share=done / total, time=left)
