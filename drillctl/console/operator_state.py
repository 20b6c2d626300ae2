"""The operator's hold and its end, from the key to the machine. Used by operating.

Rule: what was asked last counts, though the machine is a tick or two behind it, or has not begun.
"""

from drillctl.generation.job import Job
from drillctl.kmd import Request
from drillctl.machine import Machine
from drillctl.viewmodel.console import Problems, ToolWanted


class HoldRequest:
    """A desk.Operator: a hold that is pressed before the first command has begun is asked for until it is so.

    wish  what the operator asked last: to hold, or not; None where nothing was, or it is so
    """

    def __init__(self) -> None:
        self.wish: bool | None = None

    @property
    def held(self) -> bool:
        """See desk.Operator."""
        return bool(self.wish)

    def foreseen(self, condition: str) -> str:
        """The condition that the machine has, or is about to have: keys pressed in one breath mean the latter."""
        if self.wish and condition == "ready":
            return "holding"
        return "ready" if self.wish is False and condition in ("holding", "held") else condition

    def requests(self) -> tuple[Request, ...]:
        """None: the rest is posted when its key is pressed."""
        return ()


class ToolChangePrompt:
    """A ToolChange (jobs/runner.py). ``wanted`` is the tool that is waited for, None while there is none."""

    def __init__(self) -> None:
        self.wanted: ToolWanted | None = None
        self._drills_mm: dict[int, float] = {}
        self._changed = False

    def open_for(self, job: Job) -> None:
        """A job begins: its tools are known by the drills that serve them."""
        groups = job.work.groups if job.work else ()
        self._drills_mm = {group.number: group.drill.diameter_mm for group in groups if group.drill}
        self.close()

    def close(self) -> None:
        """The job is over: nothing is waited for any more."""
        self.wanted, self._changed = None, False

    def confirm(self) -> Problems:
        """The operator has put the tool in."""
        if self.wanted is None:
            return ("no tool is waited for",)
        self._changed = True
        return ()

    def __call__(self, tool: int, diameter_mm: float | None) -> bool:
        """True once, after the operator has confirmed this tool."""
        if self._changed:
            self.close()
            return True
        self.wanted = ToolWanted(tool, diameter_mm, self._drills_mm.get(tool))
        return False


def asks_for_tools(machine: Machine, simulated: bool, wish: str | None) -> bool:
    """Whether the operator is asked: as ``wish`` has it (``--tools``: ask, assume), else as the machine's file has it.

    AUTOMATIC is believed of a simulated machine only: no changer is driven by this program, and a wrong drill on a real
    machine spoils the board.
    """
    if wish is not None:
        return wish == "ask"
    return machine.configuration.tool_change == "MANUAL" or not simulated


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
