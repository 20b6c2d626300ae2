"""A console without a machine behind it: it keeps what it was asked, and moves nothing. And the program upon it."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import urwid
from msgspec.structs import replace

from drillctl.ui.app import App
from drillctl.viewmodel.console import AxisView, BoardView, HolesView, MachineView, Problems, ToolView, Watch
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole
from drillctl.viewmodel.jobs import AlignmentReport, RecentJob, UnfinishedJob
from drillctl.viewmodel.production import Production
from drillctl.viewmodel.records import Estimate, FaultReport, Progress, ToolEstimate

MOTIONS = {"go_on", "start", "run_queue", "initialise", "return_to_zero", "jog", "go_to", "set_base", "resume"}
FAULT = FaultReport(1, "EMERGENCY_STOP", "somebody pressed it", "look why", "lost")
WIRES = tuple(
    (name, row, name in ("1a", "24a"))
    for name, row in (("1a", "xxxxxx......"), ("1b", "......xxxxxx"), ("24a", "x.....x....."))
)


def axis(name: str) -> AxisView:
    return AxisView(name, 150, 3.175, 1559, 33.0, 3, 3, 7, WIRES, 1200 / 25.4)


VIEW = MachineView(
    machine="pcb-drill", port="simulated", tick=1, tick_hz=500, condition="ready", moving=False, position_known=True,
    command="", queued=0, tool=1, axes=(axis("x"), axis("y"), axis("z")),
    sensors=(("x_min", True), ("x_max", False)), outputs=(("spindle", False),), lost_steps=(0, 0, 0), late=0,
    late_worst_ms=0.0, fault=None, notices=(),
)  # fmt: skip
BOARD = BoardView(
    name="four.drl",
    file="/home/four.drl",
    file_xy_mm=np.array([[10.0, 10.0], [50.0, 10.0], [50.0, 30.0], [10.0, 30.0]]),
    xy_mm=np.array([[0.0, 0.0], [40.0, 0.0], [40.0, 20.0], [0.0, 20.0]]),
    tool=np.zeros(4, np.int64),
    tools=(ToolView(1, 0.8, 4),),
    format="mm decimal",
    dialect="Excellon decimal",
    confidence=0.9,
    reason="the numbers carry points",
    runner_up="inch decimal",
    warnings=("four.drl:3: no end of program", "four.drl:4: a hole twice"),
    estimate=Estimate("pcb-drill", 4, 5000, 500, (ToolEstimate(1, 0.8, 4, 5000),), True, None),
)


@dataclass
class FakeConsole:
    """``asked`` is every request, in order; ``answer`` is what each of them is told."""

    now: MachineView = VIEW
    loaded: BoardView | None = None
    job: Progress | None = None
    answer: Problems = ()
    made: Production | None = None
    asked: list[tuple[object, ...]] = field(default_factory=list)
    recent_jobs: list[RecentJob] = field(default_factory=list)
    unfinished_jobs: list[UnfinishedJob] = field(default_factory=list)
    glanced: list[tuple[str, JobOptions]] = field(default_factory=list)

    def turn(self) -> bool:
        """Nothing is new."""
        return False

    def view(self) -> MachineView:
        return self.now

    def board(self) -> BoardView | None:
        return self.loaded

    def progress(self) -> Progress | None:
        return self.job

    def workpieces(self) -> None:
        """A board's machine has no stores."""

    def production(self) -> Production | None:
        return self.made

    def machines(self) -> Sequence[tuple[str, str]]:
        return [("pcb-drill", "the paper's"), ("boiler-drum", "the large one")]

    def load(self, file: str, asked: JobOptions, watch: Watch) -> Problems:
        if not self.answer:
            self.loaded = replace(BOARD, file=file)
        return self._keep("load", file, asked)

    def glance(self, file: str, options: JobOptions) -> HolesView | None:
        """Files of this name are drawn before they are loaded."""
        self.glanced.append((file, options))
        return BOARD if file.endswith("seen.drl") else None

    def choose_machine(self, name: str) -> Problems:
        return self._keep("choose_machine", name)

    def align(self, measured: tuple[MeasuredHole, ...], face_down: bool) -> tuple[AlignmentReport | None, Problems]:
        """A shift by the first hole, and how far the others are off it."""
        if self.answer:
            return None, self.answer
        places = np.array([(hole.machine_x_mm, hole.machine_y_mm) for hole in measured])
        off = places - np.array([(hole.file_x_mm, hole.file_y_mm) for hole in measured])
        matrix = np.column_stack([np.eye(2), off[0]])
        residual_mm = tuple(np.hypot(*(off - off[0]).T).tolist())
        rejected = ("a hole is off",) if max(residual_mm) > 0.5 else ()
        return AlignmentReport("rigid", matrix, residual_mm, 0.0, (1.0, 1.0), rejected, rejected), ()

    def recent(self) -> Sequence[RecentJob]:
        return self.recent_jobs

    def unfinished(self) -> Sequence[UnfinishedJob]:
        return self.unfinished_jobs

    def take_up(self, journal: str, elsewhere: bool, watch: Watch) -> Problems:
        return self._keep("take_up", journal, elsewhere)

    def go_on(self) -> Problems:
        return self._keep("go_on")

    def give_up(self, journal: str) -> Problems:
        self.unfinished_jobs = []
        return self._keep("give_up", journal)

    def go_real(self) -> Problems:
        return self._keep("go_real")

    def start(self, dry: bool) -> Problems:
        return self._keep("start", dry)

    def run_queue(self, text: str) -> Problems:
        return self._keep("run_queue", text)

    def set_tick_hz(self, hz: int) -> Problems:
        return self._keep("set_tick_hz", hz)

    def initialise(self) -> Problems:
        return self._keep("initialise")

    def return_to_zero(self) -> Problems:
        return self._keep("return_to_zero")

    def jog(self, axis: str, steps: int) -> Problems:
        return self._keep("jog", axis, steps)

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        return self._keep("go_to", x_mm, y_mm)

    def set_base(self) -> Problems:
        return self._keep("set_base")

    def tool_changed(self) -> Problems:
        if not self.answer:
            self.now = replace(self.now, tool_wanted=None)
        return self._keep("tool_changed")

    def hold(self) -> Problems:
        return self._keep("hold")

    def resume(self) -> Problems:
        return self._keep("resume")

    def stop(self) -> Problems:
        return self._keep("stop")

    def emergency_stop(self) -> Problems:
        self.now = replace(self.now, condition="latched", fault=FAULT)
        return self._keep("emergency_stop")

    def acknowledge(self) -> Problems:
        self.now = replace(self.now, condition="ready", fault=None)
        return self._keep("acknowledge")

    def close(self) -> None:
        self._keep("close")

    def _keep(self, *request: object) -> Problems:
        self.asked.append(request)
        return self.answer


class Paper(urwid.display.raw.Screen):
    """A terminal of a fixed size, never started."""

    size = (80, 24)

    def get_cols_rows(self) -> tuple[int, int]:
        return self.size

    def clear(self) -> None:
        """There is nothing on it."""


class Program:
    """The whole program upon a console, driven by keys and read as text."""

    def __init__(self, console: FakeConsole, size: tuple[int, int] = (80, 24), plain: bool = False):
        self.console = console
        self.paper = Paper()
        self.paper.size = size
        self.app = App(console, plain=plain, terminal=self.paper)

    def press(self, *keys: str | tuple[str, int, int, int]) -> None:
        """As the loop does it: filter, widgets, and what is left."""
        self.app.loop.screen_size = self.paper.size
        self.app.loop.process_input(self.app.filtered(list(keys), []))
        self.app.turn()

    def canvas(self) -> urwid.Canvas:
        return self.app.loop.widget.render(self.paper.size, focus=True)

    def text(self) -> str:
        return "\n".join(row.decode() for row in self.canvas().text)
