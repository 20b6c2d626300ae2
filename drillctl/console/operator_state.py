"""What the operator has to do or has set: the tool change that is waited for, and the working base."""

from drillctl.generation.job import Job
from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.viewmodel.console import Problems, ToolWanted


class ToolChangePrompt:
    """A ToolChange (jobs/operator.py) answered on the screen. ``wanted`` is the tool that is waited for, if any."""

    def __init__(self) -> None:
        self.wanted: ToolWanted | None = None
        self._drills_mm: dict[int, float] = {}
        self._changed = False

    def open_for(self, job: Job) -> None:
        """A job begins: notes which drill serves each of its tools."""
        groups = job.work.groups if job.work else ()
        self._drills_mm = {group.number: group.drill.diameter_mm for group in groups if group.drill}
        self.close()

    def close(self) -> None:
        """The job is over: no tool is waited for any more."""
        self.wanted, self._changed = None, False

    def confirm(self) -> Problems:
        """The operator says that the tool is in. Refused where none is waited for."""
        if self.wanted is None:
            return (Message("no tool is waited for"),)
        self._changed = True
        return ()

    def __call__(self, tool: int, diameter_mm: float | None) -> bool:
        """True once, after the operator has confirmed this tool."""
        if self._changed:
            self.close()
            return True
        self.wanted = ToolWanted(tool, diameter_mm, self._drills_mm.get(tool))
        return False


def asks_for_tools(machine: Machine, simulated: bool, tools: str | None) -> bool:
    """Whether tool changes wait for the operator: by ``tools`` (the option: ask, assume), else by the machine's file.

    AUTOMATIC counts on a simulated machine only: this program drives no tool changer, and on a real machine a wrong
    drill spoils the board. A machine with parameters asks by its program only where an operator is needed.
    """
    if tools is not None:
        return tools == "ask"
    if machine.parameters is not None:
        return True
    return machine.configuration.tool_change == "MANUAL" or not simulated


Base = tuple[int, int]


class WorkingBase:
    """Where the working base lies: ``steps`` from machine zero by axis, always 0 for the heads."""

    def __init__(self, machine: Machine):
        self._machine = machine
        self.steps = [0] * len(machine.axes)

    @property
    def xy(self) -> Base:
        """The base of X and Y in steps; zeros on a machine without these axes."""
        x, y = (self._machine.axis_index(name) for name in ("x", "y"))
        return (0, 0) if x is None or y is None else (self.steps[x], self.steps[y])

    def move(self, x_steps: int, y_steps: int) -> None:
        """Moves the base of X and Y there; that of every other axis becomes 0."""
        places = {"x": x_steps, "y": y_steps}
        self.steps = [places.get(name, 0) for name in self._machine.axis_names]

    def commanded(self, axis: str, mm: float, base: list[int]) -> int:
        """A place in mm from this base, in steps from execution's ``base`` (by axis), from which commands count."""
        index = self._machine.axis_index(axis)
        if index is None:
            return 0
        return round(mm * self._machine.axes[index].steps_per_mm) + self.steps[index] - base[index]

    def take(self, base: list[int]) -> None:
        """Takes over execution's base, by axis."""
        self.steps = base[: len(self._machine.axes)]
