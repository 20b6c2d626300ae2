"""The operator's working base: where millimetres count from, and boards are drilled. Used by station.

Rule: it changes once a base has been taken, not when that is asked. Execution has its own (KMD_BAZA), and they differ
after a board that was stopped before it had taken the operator's base again.
"""

from drillctl.machine import Machine

Base = tuple[int, int]


class WorkingBase:
    """``steps`` of every axis from machine zero; the heads always count from there."""

    def __init__(self, machine: Machine):
        self._machine = machine
        self.steps = [0] * len(machine.axes)

    @property
    def xy(self) -> Base:
        """X and Y; zero on a machine that has none."""
        x, y = (self._machine.axis_index(name) for name in ("x", "y"))
        return (0, 0) if x is None or y is None else (self.steps[x], self.steps[y])

    def move(self, x_steps: int, y_steps: int) -> None:
        """The base lies there."""
        places = {"x": x_steps, "y": y_steps}
        self.steps = [places.get(name, 0) for name in self._machine.axis_names]

    def commanded(self, axis: str, mm: float, base: list[int]) -> int:
        """A place that counts from here as a command has it, which counts from execution's ``base``, by axis."""
        index = self._machine.axis_index(axis)
        if index is None:
            return 0
        return round(mm * self._machine.axes[index].steps_per_mm) + self.steps[index] - base[index]

    def take(self, base: list[int]) -> None:
        """By axis, as execution has it now."""
        self.steps = base[: len(self._machine.axes)]
