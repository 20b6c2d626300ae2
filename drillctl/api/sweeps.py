"""Sweeps for another program: many variants of a machine's axis on the dynamic plant, a row each."""

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.api.jobs import MachineGiven, job
from drillctl.api.machines import DEFAULT, machine_of
from drillctl.lab.answers import chunks, head
from drillctl.lab.board import Board
from drillctl.lab.dynamic_rerun import plane_of
from drillctl.lab.question import Question
from drillctl.lab.tables import axis_index, phases, ramps
from drillctl.lab.workers import on_cores
from drillctl.language import Message, Refusal
from drillctl.machine import Library

TEXTS = ("phase", "ramp", "fault")  # columns that are words
COUNTS = ("tick_hz", "draw", "moves", "holes", "lost", "lost_steps")


def sweep(
    machine: MachineGiven = DEFAULT,
    *,
    axis: str | None = None,
    hz: Sequence[int] | None = None,
    ramp: Sequence[str] | None = None,
    phase: Sequence[str] | None = None,
    vary: Mapping[str, Sequence[float]] | None = None,
    load_nm: Sequence[float] = (0.0,),
    steps: Sequence[int] = (1, 10, 100),
    board: str | PathLike[str] | None = None,
    draws: int = 1,
    spread: float = 0.0,
    seed: int = 0,
    workers: int = 1,
    **options: Any,
) -> NDArray[np.void]:
    """Tries every machine of a grid; returns a record array (machines,), in the order of the grid.

    axis           by name; None: the first, or X and Y of a board
    hz             tick rates in Hz; None: the machine's own
    ramp, phase    names of tables, as ``drillctl sweep`` takes them; None: the axis's own
    vary           factors for parameters of the dynamics: ``{"coulomb_nm": (0.5, 1, 2)}``
    load_nm        resisting torques in N m
    steps          lengths of the moves that are tried, both ways, from every kind of rest
    board          a drill file that is drilled whole in place of moves; ``options`` place it, as of ``job``
    draws, spread  machines at each point, each parameter drawn within ``spread`` (0.03: 3 %) of its value
    workers        processes; a script that asks for several needs ``if __name__ == "__main__":``

    Fields: ``phase, ramp, tick_hz``, the parameters varied, then ``load_nm, draw, moves, lost, worst_full_steps``, or
    of a board ``draw, holes, lost, lost_steps, worst_mm, seconds, fault`` (docs/SWEEPS.md). Raises Refused.

    >>> import drillctl
    >>> drillctl.sweep(hz=(300, 900), steps=(40,))["lost"].tolist()[0]  # none of the moves at 300 Hz
    0
    """
    wanted = machine_of(machine)
    rates = tuple(hz or (wanted.tick_hz,))
    axes = (axis_index(wanted, axis),) if axis else (plane_of(wanted) if board else (0,))
    table, library = wanted.axes[axes[0]], Library.standard()
    if options and board is None:
        raise Refusal(Message("{names}: options of a job need board=FILE", names=", ".join(options)))
    question = Question(
        table,
        rates,
        ramps(_listed(ramp), table, library),
        phases(_listed(phase), table, library),
        tuple((name, tuple(map(float, values))) for name, values in (vary or {}).items()),
        tuple(map(float, load_nm)),
        () if board else tuple(steps),
        draws,
        spread,
        seed,
        None if board is None else _board(Path(board), wanted, axes, rates, options),
    )
    rows = [row for chunk in on_cores(question, chunks(question), workers) for row in chunk]
    return _records(head(question).split(","), rows)


def _board(file: Path, machine: Any, axes: Sequence[int], rates: Sequence[int], options: dict[str, Any]) -> Board:
    programs = {hz: job(file, machine.at_rate(hz), **options).program for hz in rates}
    return Board.of(file.name, machine, axes, programs)


def _listed(names: Sequence[str] | None) -> str | None:
    return None if names is None else ",".join(names)


def _records(names: Sequence[str], rows: Sequence[str]) -> NDArray[np.void]:
    """The rows of a results file as records."""
    kinds = [(name, "U40" if name in TEXTS else "i8" if name in COUNTS else "f8") for name in names]
    return np.array([tuple(row.split(",")) for row in rows], kinds)
