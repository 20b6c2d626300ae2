"""A recorder of the segment form: what is batched comes as tapes, what is ticked is wound onto one.

Rule: in the order of time; whatever was ticked since the last tapes is wound before the next ones are laid.
"""

from collections.abc import Iterable, Sequence

import numpy as np

from drillctl.ports import CARD_BITS
from drillctl.trace import Recorder, Segments, Signal
from drillctl.trace.segments import OUTPUT, without_outputs
from drillctl.trace.tapes import DARK, ImagePool, Images, Tape


class TapeRecorder(Recorder):
    """A Recorder whose outputs go onto ``tapes`` tapes of a pool."""

    def __init__(self, signals: Sequence[Signal], pool: ImagePool, tapes: int) -> None:
        super().__init__(signals)
        self._cards = {n: int(m[1]) for n, s in enumerate(signals) if (m := OUTPUT.fullmatch(s.name))}
        self._pool = pool
        self._tapes: list[list[Tape]] = [[] for _ in range(tapes)]
        self._until = 0  # what comes before is on the tapes
        self._images = [0]  # of the ticked stretch since then, and the ticks they begin at
        self._begins = [0]

    def set(self, index: int, tick: int, value: int) -> None:
        """Like the method of Recorder; a card's outputs are put into the image of the tick."""
        if index not in self._cards:
            super().set(index, tick, value)
            return
        shift, image = CARD_BITS * self._cards[index], self._images[-1]
        changed = image ^ (value ^ (image >> shift & (1 << CARD_BITS) - 1)) << shift
        if changed != image:
            self._images.append(changed)
            self._begins.append(tick)

    def lay(self, first: int, tapes: Sequence[Tape], end: int, image: int) -> None:
        """A batch's tapes, from tick ``first`` up to ``end``, which leaves this image standing."""
        self._wind(first)
        for kept, tape in zip(self._tapes, tapes, strict=True):
            kept.append(tape)
        self._until, self._images, self._begins = end, [image], [end]

    def lay_strip(self, first: int, shown: Images) -> None:
        """The images (ticks,) of ticks from ``first`` on."""
        self._wind(first)
        self._lay_strip(self._pool.add(shown), len(shown))
        self._until, self._images, self._begins = first + len(shown), [int(shown[-1])], [first + len(shown)]

    def segments(self, end: int, header: Iterable[tuple[str, str]]) -> Segments:
        """The run of ``end`` ticks."""
        self._wind(end)
        trace = self.finish(end, header)
        pool = self._pool.images.copy()
        return Segments(without_outputs(trace), trace.signals, pool, tuple(map(Tape.joined, self._tapes)))

    def _wind(self, end: int) -> None:
        """What was ticked up to ``end``, as one strip on the first tape."""
        ticks = end - self._until
        if not ticks:
            return
        shown_for = np.diff(np.array([*self._begins, end]))
        start = self._pool.add(np.repeat(np.array(self._images, np.uint64), shown_for))
        self._lay_strip(start, ticks)
        self._until, self._images, self._begins = end, self._images[-1:], [end]

    def _lay_strip(self, start: int, ticks: int) -> None:
        for number, tape in enumerate(self._tapes):
            tape.append(Tape.steady(self._pool.steady(DARK), ticks) if number else Tape.whole(start, ticks))
