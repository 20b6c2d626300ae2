"""The fastest setting for a board: the tick rate and the ramp with which a machine drills it without loss, with a
margin of load.

Rule: the settings of a grid are tried from the fastest on, by the time that the board takes with ideal motors, so none
of the grid that is faster than the one found drills the board. The loads are those of ramp_trials.py.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from drillctl.lab.board import Board
from drillctl.lab.errors import LabError
from drillctl.lab.ramp_trials import LOAD
from drillctl.language import Message
from drillctl.machine.ramp import RampTable
from drillctl.plant import IDEAL_PLANT
from drillctl.ticker.program_run import run_program

SEED = 0
STEP, GREATEST_LOAD = 0.1, 5.0  # in which the margin of the setting found is measured
Report = Callable[[str], object]


@dataclass(frozen=True, slots=True)
class Setting:
    """A tick rate and a ramp (None: each axis its own), and how long the board takes with ideal motors."""

    tick_hz: int
    ramp: RampTable | None
    seconds: float

    def __str__(self) -> str:
        return f"{self.tick_hz} Hz, {'own ramp' if self.ramp is None else self.ramp.name}, {self.seconds:.2f} s"


@dataclass(frozen=True, slots=True)
class TunedBoard:
    """The fastest setting, which loses nothing up to ``load`` times the load; ``own`` the machine's as it is, and
    whether it loses steps there. ``tried``: settings of the grid, of which ``losing`` were faster and lost steps.
    """

    setting: Setting
    load: float
    own: Setting
    own_loses: bool
    tried: int
    losing: int


def tune_board(
    board: Board, ramps: Sequence[RampTable], margin: float, report: Report = lambda line: None
) -> TunedBoard:
    """The fastest of the board's tick rates and these ramps beside the machine's own; ``report`` is given a line for
    each setting that loses steps. Raises LabError where all of them do.
    """
    grid = sorted(_settings(board, ramps), key=lambda setting: (setting.seconds, setting.tick_hz))
    for number, setting in enumerate(grid):
        if all(_holds(board, setting, load) for load in dict.fromkeys((1.0, margin))):
            own = _setting(board, board.machine.tick_hz, None)
            return TunedBoard(
                setting, _margin(board, setting, margin), own, not _holds(board, own, 1.0), len(grid), number
            )
        report(f"{setting}: loses steps")
    raise LabError(
        Message(
            "each of {count} settings loses steps with a load of 1 to {margin:g}; give slower --hz, other ramps, or "
            "less margin",
            count=len(grid),
            margin=margin,
        ).at(board.name)
    )


def _settings(board: Board, ramps: Sequence[RampTable]) -> list[Setting]:
    """All of the grid that reach the board's end with ideal motors."""
    found = [_setting(board, hz, ramp) for hz in board.programs for ramp in (None, *ramps)]
    return [setting for setting in found if setting.seconds]


def _setting(board: Board, tick_hz: int, ramp: RampTable | None) -> Setting:
    """A setting; 0 seconds where it doesn't drill the board with ideal motors."""
    run = run_program(board.programs[tick_hz], board.on(tick_hz, ramp, None, {}), IDEAL_PLANT)
    return Setting(tick_hz, ramp, run.ticks / tick_hz if run.complete else 0.0)


def _holds(board: Board, setting: Setting, load: float) -> bool:
    """Whether nothing is lost with a load so many times as great."""
    heavier: Mapping[str, float] = dict.fromkeys(LOAD, load)
    machine = board.on(setting.tick_hz, setting.ramp, None, heavier)
    return board.drilled(machine, SEED, to_the_end=False).sound


def _margin(board: Board, setting: Setting, margin: float) -> float:
    """The greatest load, in steps from the margin on, up to which nothing is lost."""
    load = margin
    while load + STEP <= GREATEST_LOAD and _holds(board, setting, load + STEP):
        load += STEP
    return load


def board_lines(tuned: TunedBoard, board: Board, margin: float) -> list[str]:
    """What was found and tried, in lines for a person."""
    names = " and ".join(board.machine.axes[index].name for index in board.axes)
    setting, own = tuned.setting, tuned.own
    ramp = "" if setting.ramp is None else f', ramp = "{setting.ramp.name}" for {names}'
    state = "loses steps" if tuned.own_loses else "loses nothing"
    return [
        f"{board.name} on {board.machine.name}: {setting.seconds:.2f} s with tick_hz = {setting.tick_hz}{ramp}",
        f"Margin: nothing is lost with inertia and friction of {names} 1 to {tuned.load:.3g} times as great "
        f"(asked for: {margin:g}).",
        f"As the machine is: {own}; it {state}.",
        f"Tried: {tuned.losing + 1} of {tuned.tried} settings, the fastest first; {tuned.losing} of them lose steps.",
        f"On the dynamic plant, with sensors as they scatter with seed {SEED}, not on a machine.",
    ]
