"""What a screen may see and ask. The screens know this protocol and these records, and nothing else of the program.

Rule: asking never blocks and never raises for what a person did: it answers with problems, a line each; an empty tuple
means it was accepted. Millimetres are from the working base, as the operator counts.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol

import msgspec
import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole
from drillctl.viewmodel.jobs import AlignmentReport, RecentJob, UnfinishedJob
from drillctl.viewmodel.records import Estimate, FaultReport, Progress

if TYPE_CHECKING:
    from drillctl.viewmodel.production import Production
    from drillctl.viewmodel.workpieces import Workpieces

Problems = tuple[Message, ...]


class AxisView(msgspec.Struct, frozen=True):
    """One axis: where it is and goes, its ramp state, its phases as they stand on the wires, the whole table."""

    name: str
    position_steps: int
    position_mm: float
    target_steps: int
    target_mm: float
    state: int
    top_state: int
    column: int  # from 1
    wires: tuple[tuple[str, str, bool], ...]  # name, row of the phase table (x on, X on and forcing, . off), lit now
    steps_per_mm: float
    behind_steps: float | None = None  # by which a simulated carriage is behind position_steps; None on a real port


class ToolWanted(msgspec.Struct, frozen=True):
    """A tool that the job waits for, the machine at rest; ``drill_mm``: the drill at hand that serves it."""

    number: int
    diameter_mm: float | None
    drill_mm: float | None = None


class MachineView(msgspec.Struct, frozen=True):
    """The machine at this moment. ``condition``: ready, holding, held, stopping, returning, latched."""

    machine: str
    port: str
    tick: int
    tick_hz: int
    condition: str
    moving: bool  # also between two moves of a job that waits for nobody: rest means that the next request is taken
    position_known: bool
    command: str  # in execution, as text; empty when there is none
    queued: int
    tool: int
    axes: tuple[AxisView, ...]
    sensors: tuple[tuple[str, bool], ...]
    outputs: tuple[tuple[str, bool], ...]
    lost_steps: tuple[int, ...] | None
    late: int
    late_worst_ms: float
    fault: FaultReport | None
    notices: tuple[Message, ...]
    tool_wanted: ToolWanted | None = None
    real_wanted: str = ""  # the port that the machine's file asks for (mode REAL) while a simulated one is in use
    at_work: bool = False  # a job, a jog or an initialisation is on its way
    local: bool = False  # some of its tables are neither the shipped ones nor named by the operator
    hot_s: float = 0.0  # after which what was switched on by hand and would burn a winding goes off; 0: nothing is
    cut_off: bool = False  # that has happened, and no output was set since
    pace: float = 0.0  # machine time over wall time, of a simulated machine by the simulated clock; 0: of another
    following: tuple[str, ...] = ()  # the commands of the program that follow ``command``, at most three
    plant: str = ""  # the dynamic plant with its faults, ``dynamic blunt=20``; empty for another
    stores: bool = False  # its jobs are workpieces in stores (viewmodel/workpieces.py)
    words: tuple[tuple[str, int], ...] = ()  # numbers on several bits of a card: those put out, then those read
    production: bool = False  # it has parameters and records (viewmodel/production.py)
    change_step: int = 0  # the step of a tool change that is carried out, or that failed; 0: none
    paused: bool = False  # ticks come only as they are granted (viewmodel/signals.py)


class ToolView(msgspec.Struct, frozen=True):
    """A tool of the board: its number, diameter, and how many holes it drills."""

    number: int
    diameter_mm: float | None
    holes: int


class HolesView(msgspec.Struct, frozen=True, eq=False):
    """Holes as a picture shows them: xy_mm (n, 2) from the working base, tool (n,) index into tools."""

    xy_mm: NDArray[np.float64]
    tool: NDArray[np.int64]
    tools: tuple[ToolView, ...]


class BoardView(HolesView, frozen=True, eq=False):
    """The board that is loaded, in drilling order: file_xy_mm (n, 2) are its holes as its file has them. ``format`` is
    how its digits are read, ``dialect`` what such a file is called.
    """

    name: str
    file: str
    file_xy_mm: NDArray[np.float64]
    format: Message
    dialect: str
    confidence: float
    reason: Message
    runner_up: Message | None
    warnings: tuple[Message, ...]
    estimate: Estimate


Watch = Callable[[Message], Callable[[int, int], None]]
"""Is called with what is done next, and returns what is called with how much of that is done, and of how much."""


class Console(Protocol):
    """The operator's desk, as screens use it. ``turn`` is called some twenty times a second."""

    def turn(self) -> bool:
        """Lets the machine's news in; returns at once. True: a machine that runs free is at work, so call again."""

    def view(self) -> MachineView:
        """The machine as it is now."""

    def board(self) -> BoardView | None:
        """The board that is loaded; None for none."""

    def progress(self) -> Progress | None:
        """The progress of the job that runs, or ran last; None before the first."""

    def workpieces(self) -> "Workpieces | None":
        """The stores of workpieces; None for a machine that has none."""

    def production(self) -> "Production | None":
        """The parameters and records of a production machine; None for a machine that has none."""

    def machines(self) -> Sequence[tuple[str, str]]:
        """Name and description of every machine that can be chosen."""

    def choose_machine(self, name: str) -> Problems:
        """Changes to another machine, at its start position. Refused while something moves."""

    def go_real(self) -> Problems:
        """Changes to the machine on the port that its file asks for. Refused while something moves."""

    def load(self, file: str, options: JobOptions, watch: Watch) -> Problems:
        """Reads a drill file and plans it; ``watch`` is called with how far that is, maybe from another thread, and may
        raise. Refused with its reasons. The board loaded before stays in both cases.
        """

    def glance(self, file: str, options: JobOptions) -> HolesView | None:
        """The holes of a drill file that is read within a tenth of a second, placed as ``load`` would place a single
        board, in the order of the file; None for any other file. Changes nothing.
        """

    def align(self, measured: tuple[MeasuredHole, ...], face_down: bool) -> tuple[AlignmentReport | None, Problems]:
        """What measured holes say about where the board lies; changes nothing."""

    def recent(self) -> Sequence[RecentJob]:
        """The drill files opened last, with their settings; the newest first."""

    def unfinished(self) -> Sequence[UnfinishedJob]:
        """Jobs that were interrupted, the newest first. Reads their journals from the disk."""

    def take_up(self, journal: str, elsewhere: bool, watch: Watch) -> Problems:
        """Makes an interrupted job again and plans what is left of it; ``watch`` as for ``load``. Refused where
        anything is not the same; ``elsewhere``: but for port, pace and plant.
        """

    def go_on(self) -> Problems:
        """Drills what was taken up: initialises and goes to the same base first."""

    def give_up(self, journal: str) -> Problems:
        """Gives an unfinished job up for good: its journal is removed."""

    def start(self, dry: bool) -> Problems:
        """Drills the board; ``dry``: goes to every hole with the drill raised."""

    def run_queue(self, text: str) -> Problems:
        """Runs a queue of KMD commands, given as text."""

    def set_tick_hz(self, hz: int) -> Problems:
        """So many ticks a second, at rest; the position stays. ``view`` has the rate in force. Refused where the port
        or this computer can't carry it, with the rate that they can.
        """

    def initialise(self) -> Problems:
        """Raises the head, then moves to X=0, Y=0 by the limit sensors."""

    def return_to_zero(self) -> Problems:
        """Goes back to machine zero by the count of steps, the heads first."""

    def jog(self, axis: str, steps: int) -> Problems:
        """So many steps from here, with ramps; one further step waits. Asked as fast as a key held down repeats, it
        is one move, until the asking ends.
        """

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        """Moves to a place in mm from the working base, the drill raised."""

    def set_base(self) -> Problems:
        """Takes the position as the working base."""

    def tool_changed(self) -> Problems:
        """Confirms that the tool the job waits for is in."""

    def hold(self) -> Problems:
        """Brakes the machine; the job can be resumed."""

    def resume(self) -> Problems:
        """Resumes the job after a hold."""

    def stop(self) -> Problems:
        """Ends the job; the position is kept."""

    def emergency_stop(self) -> Problems:
        """Stops the machine as its file says: outputs off, current held, or down the ramps. Never refused."""

    def acknowledge(self) -> Problems:
        """Acknowledges the fault, so that the machine can be used again."""

    def close(self) -> None:
        """Makes the outputs safe and ends every process that was started."""
