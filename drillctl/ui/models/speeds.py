"""How fast each axis moves, found from its position in one view after the other.

Rule: a function of the views alone; time is the machine's own, so a slow screen shows the same speeds.
"""

from collections import deque

from drillctl.viewmodel.console import AxisView, MachineView

KEPT = 120  # values of an axis


class Speeds:
    """``of`` an axis, by its name: the last speeds in steps a second, the newest last."""

    def __init__(self) -> None:
        self.of: dict[str, deque[float]] = {}
        self._before: MachineView | None = None

    def see(self, view: MachineView) -> None:
        """Takes a view; one at the same tick says nothing new. Another machine begins anew."""
        before = self._before
        if before is None or before.machine != view.machine or view.tick < before.tick:
            self._before, self.of = view, {axis.name: deque(maxlen=KEPT) for axis in view.axes}
        elif view.tick > before.tick:
            seconds = (view.tick - before.tick) / max(view.tick_hz, 1)
            for axis, then in zip(view.axes, before.axes, strict=True):
                self.of[axis.name].append(_way(axis, then) / seconds)
            self._before = view

    def now(self, name: str) -> float:
        """The newest speed of an axis; 0 while there is none."""
        values = self.of.get(name)
        return values[-1] if values else 0.0


def _way(axis: AxisView, then: AxisView) -> int:
    return abs(axis.position_steps - then.position_steps)
