"""The machine kept running for the screens (operating.py), and the boards that are drilled on it.

Rule: a Console (viewmodel/console.py): never blocks, never raises for what a person did. The machine runs in a process
of its own, so a screen that hangs disturbs no tick.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from drillctl.console.boards import Boards, align
from drillctl.console.machine_in_use import MachineInUse
from drillctl.console.operating import BUSY, OperatedMachine
from drillctl.console.operator_state import WorkingBase
from drillctl.console.views import machine_list, machine_view
from drillctl.generation.job import Job
from drillctl.generation.sequences import drill_up
from drillctl.jobs.runner import JobRunner
from drillctl.machine import Library, Machine
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.console import BoardView, MachineView, Problems
from drillctl.viewmodel.jobs import AlignmentReport, Asked, MeasuredHole, RecentJob, UnfinishedJob


class MachineConsole(OperatedMachine):
    """One operator, one machine. ``running``, ``tick_hz``, ``port_won``: as console/machine_in_use.py has them.

    tools  ask or assume, at a tool change; None: as the machine's file has it
    """

    def __init__(
        self, library: Library, machine: Machine, running: RunSettings, tools: str | None = None,
        tick_hz: int | None = None, port_won: bool = False,
    ):  # fmt: skip
        super().__init__(MachineInUse(library, machine, running, tick_hz, port_won), tools)
        self._library = library
        self._boards = Boards()

    def view(self) -> MachineView:
        """From the status record."""
        running = self._desk.job.program if self._desk else None
        first = int(self._desk.first["done"]) if self._desk else 0
        view = machine_view(
            self.machine, self._used.running.port, self.link, self.link.status(), running, first, self._base.steps
        )
        notices = (*self._used.notices(), *view.notices, *self._boards.troubles)
        return replace(
            view, tool_wanted=self._gate.wanted, real_wanted=self._used.real_wanted, notices=notices,
            at_work=self.at_work, local=bool(self._used.local), condition=self._hand.foreseen(view.condition),
        )  # fmt: skip

    def board(self) -> BoardView | None:
        """As planned."""
        return self._boards.plan.view if self._boards.plan else None

    def machines(self) -> Sequence[tuple[str, str]]:
        """Those that can be loaded."""
        return machine_list(self._library)

    def choose_machine(self, name: str) -> Problems:
        """The old one's outputs are safe before the new one starts."""
        return self.change(lambda used: used.choose(name))

    def go_real(self) -> Problems:
        """On the port that the machine's file configures."""
        return self.change(MachineInUse.go_real)

    def change(self, how: Callable[[MachineInUse], Problems]) -> Problems:
        """Another machine, or the same on another port: what was loaded is forgotten. Refused while something moves."""
        if not self.link.lost() and (problems := self.busy()):
            return problems
        before = self._used.link, self._used.machine
        problems = how(self._used)
        if (self._used.link, self._used.machine) != before:
            self._boards.forget()
            self._last = None
            self._base = WorkingBase(self.machine)
        return problems

    def load(self, file: str, asked: Asked) -> Problems:
        """Read, placed, ordered, checked against the reach, and foreseen; or nothing changes. Takes its time."""
        if self._desk is not None:
            return (BUSY,)
        return self._boards.load(Path(file), asked, self.machine, self._base.xy)

    def align(self, measured: tuple[MeasuredHole, ...], face_down: bool) -> tuple[AlignmentReport | None, Problems]:
        """By the same fit as ``--align``."""
        return align(measured, face_down)

    def recent(self) -> Sequence[RecentJob]:
        """From the user's state folder."""
        return self._boards.recent()

    def unfinished(self) -> Sequence[UnfinishedJob]:
        """From the user's state folder; not the one that runs."""
        return self._boards.unfinished(self._used.site)

    def go_on(self, journal: str, elsewhere: bool = False) -> Problems:
        """As ``drillctl resume`` does; ``elsewhere`` is its option."""
        if problems := self.busy() or self._boards.take_up(Path(journal), self.machine, self._used.site, elsewhere):
            return problems
        return self._drill()

    def give_up(self, journal: str) -> Problems:
        """Its journal goes."""
        return self._boards.give_up(Path(journal))

    def start(self, dry: bool) -> Problems:
        """The job's own program begins with an initialisation. A board that is drilled has a journal."""
        if self._boards.plan is None:
            return ("no board is loaded: open a drill file first",)
        if problems := self.busy() or self._boards.based(self.machine, self._base.xy):
            return problems
        return self._begin(_with_drill_up(self._boards.plan.left)) if dry else self._drill()

    def acknowledge(self) -> Problems:
        """A ticker that is gone is started anew."""
        if self.link.lost():
            return self.choose_machine(self.machine.name)
        return super().acknowledge()

    def close(self) -> None:
        """Everything that was started ends."""
        self._used.close()
        self._boards.close()

    def _drill(self) -> Problems:
        """From the base that the board was planned for, with its journal."""
        if problems := self._boards.begin(self._used.site):
            return problems
        plan = self._boards.plan
        assert plan is not None
        self._base.move(*plan.recipe.base)
        return self._begin(plan.left, self._boards.journal, plan.foreseen, plan.done_before)

    def _paced(self) -> None:
        """What a board takes is told by the rate in force."""
        self._boards.based(self.machine, self._base.xy)

    def _over(self, desk: JobRunner) -> None:
        """Its journal ends with it; a board is planned anew where its base has moved."""
        super()._over(desk)
        self._boards.ended(desk, self.machine)
        self._boards.based(self.machine, self._base.xy)


def _with_drill_up(job: Job) -> Job:
    """The same way over the board, with nothing drilled."""
    return replace(job, program=drill_up(job.program))
