"""The tool change as the screen has it: what the desk asks again and again, answered by the operator when it is done.

Rule: without an answer the queue waits and the machine rests; nothing is taken for granted. Made by station for the
machine it runs.
"""

from drillctl.generation.job import Job
from drillctl.machine import Machine
from drillctl.panel.console import Problems, ToolWanted


class ToolGate:
    """A ToolChange (wiring/desk.py). ``wanted`` is the tool that is waited for, None while there is none."""

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
