"""What a picture of a recorded run shows: speed, lag, currents, the board as drilled, the pull-out curve.

Rule: here numbers become records of viewmodel/picture.py; drawing them is the work of ui.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from drillctl.lab.dynamic_rerun import AxisRun
from drillctl.lab.errors import LabError
from drillctl.lab.moves import move
from drillctl.lab.trials import FULL_STEPS_PER_CYCLE, Trial, errors_full_steps, lost
from drillctl.language import Message
from drillctl.machine import AxisTable, Dynamics
from drillctl.plant.rotor import FULL_TURN
from drillctl.viewmodel.reports import BoardPlan, Chart, Curve, Picture, Style

Floats = NDArray[np.float64]
STANDING_TICKS = 100  # no column for so long: it stands
RATES_HZ = range(100, 701, 25)
TIME = "time, s"
WAYS = {"forward": 1, "backward": -1}


@dataclass(frozen=True, slots=True)
class Window:
    """Ticks from ``first`` up to, not including, ``end`` (None: all)."""

    first: int = 0
    end: int | None = None

    def of(self, run: AxisRun) -> slice:
        """The ticks of a run that are shown. Raises LabError where there are none."""
        ticks = len(run.commanded)
        found = slice(self.first, ticks if self.end is None else min(self.end, ticks))
        if found.start >= found.stop:
            raise LabError(
                Message(
                    "no ticks from {start} to {stop}; the run has {ticks}",
                    start=found.start,
                    stop=found.stop,
                    ticks=ticks,
                )
            )
        return found


def speed(run: AxisRun, window: Window) -> Picture:
    """Speed over time, in mm/s: as commanded and of the rotor."""
    shown = window.of(run)
    motor_mm = run.table.motor.columns_per_cycle / run.columns_per_mm
    cycles_per_rad = _dynamics_cycles(run) / (2 * pi)
    sent = _sent_columns_per_tick(run.commanded) * run.machine.tick_hz / run.columns_per_mm
    real = run.rotor.speed * cycles_per_rad * motor_mm
    time_s = _time_s(run)[shown]
    curves = (Curve.of("rotor", time_s, real[shown]), Curve.of("commanded", time_s, sent[shown], Style.STAIRS))
    chart = Chart(TIME, "speed, mm/s", curves)
    fastest = f"fastest: {np.abs(sent[shown]).max():.1f} mm/s commanded, {np.abs(real[shown]).max():.1f} mm/s reached"
    return Picture(_title(run, "speed"), (chart,), (fastest, _whose(run)))


def lag(run: AxisRun, window: Window) -> Picture:
    """Where the axis was sent and where it was; and by how many full steps it was behind."""
    shown = window.of(run)
    time_s = _time_s(run)[shown]
    places = [(columns / run.columns_per_mm)[shown] for columns in (run.commanded, run.rotor.columns)]
    behind = _behind_full_steps(run)[shown]
    where = (Curve.of("rotor", time_s, places[1]), Curve.of("commanded", time_s, places[0], Style.STAIRS))
    late = (Curve.of("lag", time_s, behind),)
    charts = (Chart(TIME, "from the start, mm", where), Chart(TIME, "lag, full steps", late))
    notes = f"greatest lag {np.abs(behind).max():.2f} full steps, {behind[-1]:.2f} at the end"
    return Picture(_title(run, "lag"), charts, (notes, _whose(run)))


def motion(run: AxisRun, window: Window) -> Picture:
    """Speed, and by how many full steps the rotor was behind meanwhile, one above the other."""
    fast, late = speed(run, window), lag(run, window)
    return Picture(_title(run, "speed and lag"), (fast.charts[0], late.charts[1]), (fast.notes[0], *late.notes))


def currents(run: AxisRun, window: Window) -> Picture:
    """The currents of the windings, one phase above the other: of a unipolar motor two half windings each."""
    assert run.table.dynamics is not None
    shown = window.of(run)
    time_s = _time_s(run)[shown]
    names = {degrees % FULL_TURN: name for name, degrees in run.table.motor.windings}
    curves = [
        Curve.of(names[degrees], time_s, amperes[shown])
        for degrees, amperes in zip(run.table.dynamics.degrees, run.rotor.currents.T, strict=True)
    ]
    each = 2 if run.table.dynamics.kind == "unipolar" else 1
    phases = range(0, len(curves), each)
    charts = tuple(Chart(TIME, "current, A", tuple(curves[phase : phase + each])) for phase in phases)
    greatest = f"greatest current {run.rotor.currents[shown].max():.2f} A"
    return Picture(_title(run, "currents"), charts, (greatest, _whose(run)))


def board(run: AxisRun, _window: Window) -> Picture:
    """The holes of the whole run: where each was sent, and how far off it was drilled, enlarged. Raises LabError."""
    if not len(run.holes.tool):
        raise LabError(Message("the bit never met the board in this run: there is no hole to be shown"))
    return board_picture(f"{run.machine.name}: board as drilled", run.holes, (_whose(run),))


def board_picture(title: str, holes: BoardPlan, notes: tuple[str, ...] = ()) -> Picture:
    """Holes from above, and how far each is off."""
    sent, off_mm = holes.sent_mm, holes.error_mm
    by_hole = Curve.of("error", np.arange(1, len(off_mm) + 1), off_mm * 1000, Style.POINTS)
    worst = int(off_mm.argmax())
    count = "1 hole" if len(off_mm) == 1 else f"{len(off_mm)} holes"
    note = (
        f"{count}, off by {off_mm.mean() * 1000:.0f} um on average, {off_mm[worst] * 1000:.0f} um at most "
        f"(hole {worst + 1} at {sent[worst, 0]:.2f}, {sent[worst, 1]:.2f} mm)"
    )
    scale = f"errors are drawn {holes.times} times as long as they are" if off_mm.any() else "no hole is off"
    return Picture(title, (holes, Chart("hole", "error, um", (by_hole,))), (note, scale, *notes))


def pull_out_curve(run: AxisRun, _window: Window) -> Picture:
    """The pull-out curve of the axis's motor with its phase table; the run itself doesn't matter."""
    found = {name: pull_out(run.table, RATES_HZ, way) for name, way in WAYS.items()}
    curves = [Curve.of(name, each.rates_hz, each.torque_nm * 1000) for name, each in found.items()]
    hz = run.machine.tick_hz
    left = [f"{np.interp(hz, each.rates_hz, each.torque_nm) * 1000:.1f} mN m {name}" for name, each in found.items()]
    notes = (f"at {hz} Hz it carries besides its friction {' and '.join(left)}", "a constant load, ramps included")
    chart = Chart("interrupt frequency, Hz", "load carried, mN m", tuple(curves))
    return Picture(_title(run, "pull-out"), (chart,), notes)


Drawing = Callable[[AxisRun, Window], Picture]
PICTURES: dict[str, Drawing] = {
    "speed": speed,
    "lag": lag,
    "motion": motion,
    "board": board,
    "currents": currents,
    "pull-out": pull_out_curve,
}


def _title(run: AxisRun, what: str) -> str:
    return f"{run.machine.name}, {run.table.name}: {what} at {run.machine.tick_hz} Hz"


def _whose(run: AxisRun) -> str:
    if run.as_run:
        return "the plant as it was in the run"
    return "the run had no such motors: these are what the dynamic plant makes of its images"


def _time_s(run: AxisRun) -> Floats:
    """(ticks,): the time at the end of each tick."""
    return (np.arange(len(run.commanded)) + 1) / run.machine.tick_hz


def _dynamics_cycles(run: AxisRun) -> int:
    assert run.table.dynamics is not None
    return run.table.dynamics.cycles_per_turn


def _behind_full_steps(run: AxisRun) -> Floats:
    behind = run.commanded - run.rotor.columns
    return behind * FULL_STEPS_PER_CYCLE / run.table.motor.columns_per_cycle


def _sent_columns_per_tick(commanded: NDArray[np.int64]) -> Floats:
    """(ticks,): from a column to the next, one by the ticks between; 0 where none comes for long."""
    moved = np.diff(commanded, prepend=commanded[:1])
    ticks = np.flatnonzero(moved)
    waited = np.diff(ticks, prepend=-STANDING_TICKS - 1)
    rates = np.where(waited > STANDING_TICKS, 0.0, moved[ticks] / waited)
    until = np.append(ticks, len(commanded))
    return np.repeat(np.append(rates, 0.0), np.diff(until, prepend=0))


COLUMNS = 300  # of a trial's move
LEVELS = 12  # loads tried at once; then as many between the last that was carried and the first that was not
ROUNDS = 3


@dataclass(frozen=True, eq=False, slots=True)
class PullOut:
    """``torque_nm`` (rates,) by step rate; not a number where the move fails without any load."""

    rates_hz: NDArray[np.int64]
    torque_nm: Floats


def greatest_torque_nm(dynamics: Dynamics) -> float:
    """Two half windings on, at rest, both forced: no load above it is carried."""
    amperes = (dynamics.forcing_volts - dynamics.switch_volts) / dynamics.resistance_ohm
    return sqrt(2) * dynamics.torque_nm_per_a * amperes


def pull_out(table: AxisTable, rates_hz: Sequence[int], direction: int) -> PullOut:
    """The worst of the rests that a move can begin in, in one direction (+1, -1). The axis must have dynamics."""
    assert table.dynamics is not None
    carried = np.zeros(len(rates_hz))
    width_nm = greatest_torque_nm(table.dynamics)
    for _ in range(ROUNDS):
        width_nm /= LEVELS
        loads = carried[:, None] + width_nm * np.arange(LEVELS)
        held = np.cumprod(~_losing(table, rates_hz, loads, direction), axis=1).sum(axis=1)
        carried += np.where(held, (held - 1) * width_nm, np.nan)
    return PullOut(np.array(rates_hz), carried)


def _losing(table: AxisTable, rates_hz: Sequence[int], loads_nm: Floats, direction: int) -> NDArray[np.bool_]:
    """(rates, loads): whether a move loses steps, from any rest. A load that is no number is one that fails."""
    starts = range(table.phase.columns // table.motor.rests_per_cycle)
    moves = [move(table, direction * COLUMNS // table.columns_per_step, column) for column in starts]
    dynamics = table.dynamics
    assert dynamics is not None
    rows = zip(rates_hz, np.nan_to_num(loads_nm).tolist(), strict=True)
    trials = [Trial(each, hz, dynamics, load) for hz, loads in rows for load in loads for each in moves]
    errors = errors_full_steps(table, trials).reshape(*loads_nm.shape, len(moves))
    return lost(errors).any(axis=2) | np.isnan(loads_nm)
