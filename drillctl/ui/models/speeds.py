"""How fast each axis moves, found from its position in one view after the other.

Rule: a function of the views alone; time is the machine's own, so a slow screen shows the same speeds. While all axes
rest nothing is added, so that a screen at rest has nothing to draw.
"""

from collections import deque

from drillctl.viewmodel.console import AxisView, MachineView

KEPT = 120  # values of an axis


class Speeds:
    """``of`` an axis, by its name: the last speeds in steps a second, the newest last."""

    def __init__(self) -> None:
        self.of: dict[str, deque[float]] = {}
        self._before: MachineView | None = None

    def see(self, view: MachineView) -> bool:
        """Takes a view; returns whether it added something. Another machine begins anew."""
        before = self._before
        if before is None or before.machine != view.machine or view.tick < before.tick:
            self._before, self.of = view, {axis.name: deque(maxlen=KEPT) for axis in view.axes}
            return True
        if view.tick == before.tick:
            return False
        self._before = view
        ticks = view.tick - before.tick
        steps = {axis.name: _steps(axis, then, ticks) for axis, then in zip(view.axes, before.axes, strict=True)}
        speeds = {name: way * max(view.tick_hz, 1) / ticks for name, way in steps.items()}
        if not any(speeds.values()) and not any(map(self.now, speeds)):
            return False
        for name, speed in speeds.items():
            self.of[name].append(speed)
        return True

    def now(self, name: str) -> float:
        """The newest speed of an axis; 0 while there is none."""
        values = self.of.get(name)
        return values[-1] if values else 0.0


def _steps(axis: AxisView, then: AxisView, ticks: int) -> int:
    """How many steps an axis made in so many ticks. It makes at most one a tick: a place that is further away was
    counted from another base then (KMD_BAZA), and nothing has moved.
    """
    way = abs(axis.position_steps - then.position_steps)
    return way if way <= ticks else 0
