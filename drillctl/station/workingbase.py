"""The operator's working base: where millimetres count from. Used by station; execution has its own (KMD_BAZA)."""

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

    def take(self, position: list[int]) -> None:
        """Of all axes that position the board: where they are."""
        heads = self._machine.drill_axes
        self.steps = [0 if i in heads else position[i] for i in range(len(self._machine.axes))]
