"""drillctl on a simulated card, killed in a step of a tool change: run as a program of its own.

    python tests/campaign/killed_in_step.py WITNESS STEP WHOM VERB ...     STEP 0: nobody is killed

Rule: nothing of the product is changed but the card behind the port, and that KMD_KROK tells it which step begins. The
witness is a file that the plant itself writes to: which chucks hold a bit, and that the blow came.
"""

import os
import signal
import sys
from functools import partial

from drillctl.cli import main
from drillctl.execution import commands
from drillctl.execution.controller import Controller
from drillctl.execution.tool_change import begin_step
from drillctl.kmd import Command, Op
from drillctl.machine import Library, shipped_tables
from drillctl.machine.head_lines import TOOL
from drillctl.plant import Plant
from drillctl.portio.mapped import MappedCard
from drillctl.portio.simulated import SimulatedCard
from drillctl.ticker import launch as machinery

TICKS_IN_STEP = 2  # from its KMD_KROK to the blow: its first command is on its way


class KillingCard(SimulatedCard):
    """Kills ``whom``, desk or ticker, ``TICKS_IN_STEP`` after a step of a change has begun, holes being done."""

    due = 0  # ticks to the blow, 0 while none is due

    def __init__(self, plant: Plant, witness: int, whom: str):
        super().__init__(plant)
        names = {line.name: 1 << line.bit for line in MACHINE.inputs}
        self._tools = [names[f"{TOOL}_{n}"] for n in range(1, 7)]
        self._witness, self._whom, self._held = witness, whom, ""

    def latch(self) -> int:
        """Only the process that ticks latches: the others' plants stand where they stood at the fork."""
        image = super().latch()
        held = "".join("1" if image & bit else "0" for bit in self._tools)
        if held != self._held:
            self._held = held
            os.write(self._witness, f"held {held}\n".encode())
        return image

    def flush(self, image: int) -> None:
        super().flush(image)
        if KillingCard.due:
            KillingCard.due -= 1
            if not KillingCard.due:
                os.write(self._witness, f"killed {self._whom}\n".encode())
                os.kill(os.getppid() if self._whom == "desk" else os.getpid(), signal.SIGKILL)


def run(witness_file: str, step: int, whom: str, arguments: list[str]) -> int:
    """One run of the program, to its exit code."""

    def begins(m: Controller, command: Command) -> int:
        on_card = isinstance(m.port, MappedCard)  # and no forecast of the desk's
        if step and on_card and m.holes_done and command.args[0] == step:
            KillingCard.due = TICKS_IN_STEP
        return begin_step(m, command)

    witness = os.open(witness_file, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    setattr(machinery, "SimulatedCard", partial(KillingCard, witness=witness, whom=whom))  # noqa: B010  of another type
    setattr(commands, "_STARTED", {**commands._STARTED, Op.KROK: begins})  # noqa: B010
    return main(arguments)


if __name__ == "__main__":
    MACHINE = Library((shipped_tables(),)).machine("eight-axis")
    sys.exit(run(sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4:]))
