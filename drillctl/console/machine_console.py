"""The machine kept running for the screens: a Console (viewmodel/console.py) made of the other modules of this room.

Rule: never blocks, and never raises for what a person did: it returns problems, and then nothing has changed. Nothing
is begun while something else is on its way, but stops are never refused. The machine runs in a process of its own.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from drillctl.console.boards import Boards
from drillctl.console.glance import holes_of
from drillctl.console.job_request import align
from drillctl.console.jogging import TOO_FAR, Jogging, way_left
from drillctl.console.machine_in_use import MachineInUse
from drillctl.console.operator_state import WorkingBase
from drillctl.console.readiness import BUSY, busy, occupied, ticks_change_something
from drillctl.console.running_job import RunningJob, took_a_base
from drillctl.console.scope import RunRecording
from drillctl.console.views import machine_list, machine_view, plant_in_words, with_changes
from drillctl.console.workpieces import StoredWorkpieces
from drillctl.generation.job import Job, names_of
from drillctl.generation.sequences import drill_up
from drillctl.generation.waits import unwatched
from drillctl.kmd import Condition, KmdError, Op, Request, is_idle, parse_program
from drillctl.language import Message
from drillctl.machine import Library, Machine
from drillctl.ticker.launch import RunSettings
from drillctl.ticker.link import Link
from drillctl.viewmodel.console import BoardView, HolesView, MachineView, Problems, Watch
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole
from drillctl.viewmodel.jobs import AlignmentReport, RecentJob, UnfinishedJob
from drillctl.viewmodel.production import Production
from drillctl.viewmodel.records import Progress
from drillctl.viewmodel.workpieces import Workpieces


class MachineConsole:
    """One operator, one machine. ``running``, ``tick_hz``, ``port_won`` go to MachineInUse, ``tools`` to RunningJob."""

    def __init__(
        self, library: Library, machine: Machine, running: RunSettings, tools: str | None = None,
        tick_hz: int | None = None, port_won: bool = False,
    ):  # fmt: skip
        self._library = library
        self.used = MachineInUse(library, machine, running, tick_hz, port_won)
        self._job = RunningJob(self.used, tools)
        self._boards = Boards()
        self._workpieces = StoredWorkpieces(self.used, self._job, self.busy, self.return_to_zero)
        self._base = WorkingBase(machine)
        self._jogs = Jogging(
            lambda axis, steps: self.run_queue(f"KMD_RUCHd {axis}={steps}\n"),
            lambda: self.link.post(Request.STOP),
            lambda axis, steps: way_left(self.machine, self.link.status(), axis, steps),
        )

    @property
    def machine(self) -> Machine:
        """The machine in use, at the tick rate in force."""
        return self.used.machine

    @property
    def link(self) -> Link:
        """The link to the machine in use."""
        return self.used.link

    @property
    def recording(self) -> RunRecording:
        """What the machine in use has done since it was started, for the scope."""
        return self.used.recording

    @property
    def at_work(self) -> bool:
        """Whether a job, a jog or an initialisation is on its way."""
        return self._job.at_work

    def turn(self) -> bool:
        """Lets the machine run for a moment; True where it runs free and further ticks change something."""
        ended = self._job.advance()
        if ended is not None:
            if took_a_base(ended):
                self._base.take(ended.status["base"].tolist())
            self._boards.ended(ended, self.machine)
            self._workpieces.ended(ended.job, int(ended.status["done"] - ended.first["done"]))
        if self.used.follow_rate() or ended is not None:
            self._boards.plan_again(self.machine, self._base.xy)
        if self.link.status()["condition"] == Condition.RETURNING:  # by the homing table, which ends at machine zero
            self._base.move(0, 0)
        self.recording.keep()
        self._jogs.carry_on(self.at_work, time.monotonic())
        self._workpieces.carry_on()
        works_on = self.at_work and self._job.prompt.wanted is None
        return self.used.runs_free and ticks_change_something(self.link, works_on)

    def view(self) -> MachineView:
        """The machine as its status record and the running job have it now."""
        program, done_before = self._job.program
        view = machine_view(
            self.machine, self.used.running.port, self.link, self.link.status(), program, done_before, self._base.steps
        )
        notices = (*self.used.notices(), *view.notices, *self._boards.troubles)
        tool_wanted = self._job.prompt.wanted
        waits = tool_wanted is not None or self.link.gate.paused or view.condition != "ready"
        return with_changes(
            view, tool_wanted=tool_wanted, real_wanted=self.used.real_wanted, notices=notices, at_work=self.at_work,
            local=bool(self.used.local), stores=self._workpieces.present, plant=plant_in_words(self.used.running.plant),
            condition=self._job.condition_forecast(view.condition),
            moving=view.moving or (self.at_work and not waits),
        )  # fmt: skip

    def progress(self) -> Progress | None:
        """How far the running job is, or how far the last one came."""
        return self._job.progress()

    def board(self) -> BoardView | None:
        """The board that was loaded, as it is planned; None for none."""
        return self._boards.plan.view if self._boards.plan else None

    def workpieces(self) -> Workpieces | None:
        """The stores of the machine in use, where it has them."""
        return self._workpieces if self._workpieces.present else None

    def production(self) -> Production | None:
        """The parameters and records of the machine in use, where it has parameters."""
        if self.machine.parameters is None:
            return None
        from drillctl.console.production import MachineProduction  # with it comes what edits files
        return MachineProduction(self, self._library)

    def machines(self) -> Sequence[tuple[str, str]]:
        """Name and description of every machine; for one that can't be loaded the reason in place of the latter."""
        return machine_list(self._library)

    def choose_machine(self, name: str) -> Problems:
        """Changes to the machine of this name, or takes the edited tables of the one in use."""
        return self.change(lambda used: used.choose(name))

    def go_real(self) -> Problems:
        """Changes to the port that the machine's file configures."""
        return self.change(MachineInUse.go_real)

    def change(self, how: Callable[[MachineInUse], Problems]) -> Problems:
        """Changes machine or port by ``how``, at rest; board and base are forgotten where another ticker runs then."""
        if not self.link.lost() and (problems := occupied(self.link, self.at_work)):
            return problems
        before = self.link, self.machine
        problems = how(self.used)
        if (self.link, self.machine) != before:
            self._boards.forget()
            self._workpieces.forget()
            self._job.forget()
            self._base = WorkingBase(self.machine)
        return problems

    def set_tick_hz(self, hz: int) -> Problems:
        """Asks for another tick rate; it is in force once the ticker has served the request."""
        return self.busy() or self.used.set_tick_hz(hz)

    def load(self, file: str, options: JobOptions, watch: Watch = unwatched) -> Problems:
        """Reads a drill file, places and orders its holes and checks them against the reach. May take seconds."""
        if self.at_work:
            return (BUSY,)
        return self._boards.load(Path(file), options, self.machine, self._base.xy, watch)

    def glance(self, file: str, options: JobOptions) -> HolesView | None:
        """The holes of a small drill file, for a picture of it before it is loaded."""
        return holes_of(Path(file), options)

    def align(self, measured: tuple[MeasuredHole, ...], face_down: bool) -> tuple[AlignmentReport | None, Problems]:
        """Fits a placing to measured holes, as ``--align`` does."""
        return align(measured, face_down)

    def recent(self) -> Sequence[RecentJob]:
        """The boards opened last, from the user's state folder, the newest first."""
        return self._boards.recent()

    def unfinished(self) -> Sequence[UnfinishedJob]:
        """The jobs that were cut off, from the user's state folder; without the one that runs."""
        return self._boards.unfinished(self.used.site)

    def take_up(self, journal: str, elsewhere: bool = False, watch: Watch = unwatched) -> Problems:
        """Plans what is left of a job, as ``drillctl resume`` does; ``elsewhere`` is its option. May take seconds."""
        return self.busy() or self._boards.take_up(Path(journal), self.machine, self.used.site, elsewhere, watch)

    def go_on(self) -> Problems:
        """Drills what was taken up, from the base that it was begun at."""
        return self.busy() or self._drill()

    def give_up(self, journal: str) -> Problems:
        """Deletes the journal of a job that was cut off."""
        return self._boards.give_up(Path(journal))

    def start(self, dry: bool) -> Problems:
        """Drills the board with a journal; ``dry``: follows its way with the drill up, without one."""
        if self._boards.plan is None:
            return (Message("no board is loaded: open a drill file first"),)
        if problems := self.busy() or self._boards.plan_again(self.machine, self._base.xy):
            return problems
        if not dry:
            return self._drill()
        left = self._boards.plan.left
        self._job.begin(replace(left, program=drill_up(left.program)))
        return ()

    def run_queue(self, text: str) -> Problems:
        """Runs commands as they would stand in a ``.kmd`` file."""
        try:
            program = parse_program(text, names_of(self.machine), "queue")
        except KmdError as error:
            return error.messages
        returns = Op(int(program["opcode"][0])) == Op.POWROT
        if problems := occupied(self.link, self.at_work) if returns else self.busy():
            return problems
        self._job.begin(Job("queue", program, self.machine))
        return ()

    def initialise(self) -> Problems:
        """Goes to machine zero, which becomes the working base."""
        return self.run_queue("KMD_INICJALIZACJA\n")

    def return_to_zero(self) -> Problems:
        """Goes back to machine zero, the heads first, by the count of steps."""
        return self.run_queue("KMD_POWROT\n")

    def set_base(self) -> Problems:
        """Makes the present place of X and Y the working base."""
        return self.run_queue("KMD_BAZA\n")

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        """Goes to a place that counts from the working base, the drill up."""
        base = self.link.status()["base"].tolist()
        x, y = (self._base.commanded(axis, mm, base) for axis, mm in (("x", x_mm), ("y", y_mm)))
        return self.run_queue(f"KMD_WIERTLO_GORA\nKMD_GOTO_X_Y {x} {y}\n")

    def jog(self, axis: str, steps: int) -> Problems:
        """Moves an axis by so many steps, at most its length. Refused while a jog is held, or anything else runs."""
        index = self.machine.axis_index(axis)
        if index is not None and abs(steps) > self.machine.axes[index].span_steps:
            return (TOO_FAR,)
        held = self.link.status()["condition"] != Condition.READY
        if self.at_work and (held or not self._jogs.under_way):
            return (BUSY,)
        return self._jogs.press((axis, steps), self.at_work, time.monotonic())

    def tool_changed(self) -> Problems:
        """Confirms that the tool which was waited for is in; the job goes on, unless it is held."""
        return self._job.prompt.confirm()

    def hold(self) -> Problems:
        """Holds the running job, down the ramps."""
        self._jogs.forget()
        return self._job.hold()

    def resume(self) -> Problems:
        """Ends a hold; a clock that was stopped goes on too."""
        return self._job.resume()

    def stop(self) -> Problems:
        """Ends the job. At rest nothing is asked: the stop would meet whatever is begun next."""
        self._jogs.forget()
        status = self.link.status()
        if self.at_work or not is_idle(status["condition"], status["job"], status["moving"]):
            self.link.post(Request.STOP)
        return ()

    def emergency_stop(self) -> Problems:
        """Stops all axes without a ramp and latches, whatever the machine does."""
        self._jogs.forget()
        self.link.post(Request.ESTOP)
        return ()

    def acknowledge(self) -> Problems:
        """Acknowledges a latched fault; a ticker that is gone is started anew."""
        if self.link.lost():
            return self.choose_machine(self.machine.name)
        if self.link.status()["condition"] != Condition.LATCHED:
            return (Message("there is nothing to acknowledge"),)
        self.link.post(Request.ACK)
        return ()

    def busy(self) -> Problems:
        """Why nothing new can be begun now; empty where it can."""
        return busy(self.link, self.at_work)

    def close(self) -> None:
        """Ends the machine's processes, its outputs safe, and closes the journal."""
        self.used.close()
        self._boards.close()

    def _drill(self) -> Problems:
        """Drills what is left of the planned board, from the base it was planned for, into its journal."""
        if problems := self.busy() or self._boards.begin(self.used.site):
            return problems
        plan, begun = self._boards.plan, self._boards.begun
        assert plan is not None
        assert begun is not None
        self._base.move(*plan.setup.base)
        self._job.begin(begun[0], self._boards.journal, plan.ticks, plan.done_before, begun[1])
        return ()
