"""A ticker on the dynamic plant that runs stretches of known outputs in one call, with the same result to the byte.

Rule: the plant stops a stretch at the first tick that changes an input, and ``tick`` goes on from there, unless nothing
acts on that change. Only where nothing live is attached, and no derived signals are recorded.
"""

from collections.abc import Callable
from dataclasses import dataclass

from drillctl.execution.fastforward.stretch import Images, foresee, goes_on, leave
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.ticker.ticker import NEVER, Ticker

SHORTEST = 8  # ticks: a stretch of fewer is quicker ticked
MOST_TICKS = 1 << 16  # of a turn, about: whoever waits for the ticker is let in between


@dataclass
class StretchTicker(Ticker):
    """A Ticker with a simulated card and the dynamic plant behind it."""

    def __post_init__(self) -> None:
        super().__post_init__()
        assert isinstance(self.plant, DynamicPlant) and not self.derived
        self._dynamic = self.plant

    def turn(self, until: Callable[[], bool] | None = None, before: int = NEVER) -> int:
        """Like the method of Ticker; a stretch takes no command, so it may be longer than the queue."""
        m = self.controller
        first, wakes = m.tick, min(max(1, len(self.queue)), before - m.tick)
        if self.gate.paused:
            return super().turn(until, before)
        while wakes > 0 and m.tick < min(before, first + MOST_TICKS):
            shown = foresee(m, self._dynamic.inputs, before - m.tick)
            if len(shown) >= SHORTEST:
                self._pass(shown)
            else:
                ticks = min(wakes, max(1, len(shown)))
                self.run(ticks, until)
                wakes -= ticks
            if until is not None and until():
                break
        return m.tick - first

    def _pass(self, shown: Images) -> None:
        """Runs the plant on these output images (ticks,), up to the first tick after which an input is for ``tick``."""
        m, plant, first, done = self.controller, self._dynamic, self.controller.tick, 0
        while True:
            ran = plant.run(shown[done:])
            leave(m, ran)
            done += ran
            self.note_touch()
            if done == len(shown) or not goes_on(m, plant.inputs):
                break
            if self.sampler is not None:
                self.sampler.sample_inputs()
        if self.sampler is not None:
            self.sampler.sample_outputs(shown[:done], first)
