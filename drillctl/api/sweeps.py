"""Sweeps for another program: many variants of a machine's axis on the dynamic plant, a row each."""

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from drillctl.api.arguments import Reals, Wholes, named, number, path_of, several, whole
from drillctl.api.jobs import MachineGiven, job
from drillctl.api.machines import DEFAULT, machine_of
from drillctl.lab.answers import chunks, head
from drillctl.lab.board import Board
from drillctl.lab.dynamic_rerun import plane_of
from drillctl.lab.question import FACTORS, FASTEST_HZ, GREATEST_LOAD_NM, LONGEST_STEPS, SLOWEST_HZ, Question
from drillctl.lab.tables import axis_index, phases, ramps
from drillctl.lab.workers import on_cores
from drillctl.language import Message, Refusal
from drillctl.machine import Library, Machine
from drillctl.plant.choice import GREATEST_SEED
from drillctl.viewmodel.choices import GREATEST_SPREAD, MOST_DRAWS, MOST_WORKERS

TEXTS = ("phase", "ramp", "fault")  # columns that are words
ValueT = TypeVar("ValueT", int, float)
COUNTS = ("tick_hz", "draw", "moves", "holes", "lost", "lost_steps")


def sweep(
    machine: MachineGiven = DEFAULT,
    *,
    axis: str | None = None,
    hz: Wholes | None = None,
    ramp: str | Sequence[str] | None = None,
    phase: str | Sequence[str] | None = None,
    vary: Mapping[str, Reals] | None = None,
    load_nm: Reals = (0.0,),
    steps: Wholes = (1, 10, 100),
    board: str | PathLike[str] | None = None,
    draws: int = 1,
    spread: float = 0.0,
    seed: int = 0,
    workers: int = 1,
    **options: Any,
) -> NDArray[np.void]:
    """Tries every machine of a grid; returns a record array (machines,), in the order of the grid.

    axis           by name; None: the first, or X and Y of a board
    hz             tick rates in Hz, 50 to 20,000; None: the machine's own
    ramp, phase    names of tables, as ``drillctl sweep`` takes them; None: the axis's own
    vary           factors for parameters of the dynamics, 0.001 to 1000: ``{"coulomb_nm": (0.5, 1, 2)}``
    load_nm        resisting torques in N m, 0 to 100
    steps          lengths of the moves that are tried, both ways, from every kind of rest; unipolar motors make them
    board          a drill file that is drilled whole in place of moves; ``options`` place it, as of ``job``
    draws, spread  machines at each point, each parameter drawn within ``spread`` (0.03: 3 %) of its value
    workers        processes; a script that asks for several needs ``if __name__ == "__main__":``

    Fields: ``phase, ramp, tick_hz``, the parameters varied, then ``load_nm, draw, moves, lost, worst_full_steps``, or
    of a board ``draw, holes, lost, lost_steps, worst_mm, seconds, fault`` (docs/SWEEPS.md). Raises Refused.

    >>> import drillctl
    >>> drillctl.sweep(hz=(300, 900), steps=(40,))["lost"].tolist()[0]  # none of the moves at 300 Hz
    0
    """
    wanted, library = machine_of(machine), Library.standard()
    if options and board is None:
        raise Refusal(Message("{names}: options of a job need board=FILE", names=", ".join(options)))
    rates = _wholes((wanted.tick_hz,) if hz is None else hz, "hz", SLOWEST_HZ, FASTEST_HZ)
    axes = _axes(wanted, axis, board is not None)
    table = wanted.axes[axes[0]]
    question = Question(
        table,
        rates,
        ramps(_listed(ramp, "ramp"), table, library),
        phases(_listed(phase, "phase"), table, library),
        tuple((name, _numbers(values, name, *FACTORS)) for name, values in named(vary or {}, "vary").items()),
        _numbers(load_nm, "load_nm", 0, GREATEST_LOAD_NM),
        () if board else _wholes(steps, "steps", 1, LONGEST_STEPS),
        whole(draws, "draws", 1, MOST_DRAWS),
        number(spread, "spread", 0, GREATEST_SPREAD),
        whole(seed, "seed", -GREATEST_SEED, GREATEST_SEED),
        None if board is None else _board(path_of(board, "board"), wanted, axes, rates, options),
    )
    done = on_cores(question, chunks(question), whole(workers, "workers", 1, MOST_WORKERS))
    *names, _ = head(question).split(",")
    return _records(names, [row for chunk in done for row in chunk])


def _axes(machine: Machine, name: str | None, of_board: bool) -> tuple[int, ...]:
    if name is not None:
        return (axis_index(machine, str(name)),)
    return plane_of(machine) if of_board else (0,)


def _board(file: Path, machine: Machine, axes: Sequence[int], rates: Sequence[int], options: dict[str, Any]) -> Board:
    programs = {hz: job(file, machine.at_rate(hz), **options).program for hz in rates}
    return Board.of(file.name, machine, axes, programs)


def _listed(names: object, what: str) -> str | None:
    """Names as the command line has them; one alone may be given as it is."""
    return names if isinstance(names, str | None) else ",".join(map(str, several(names, what)))


def _wholes(given: object, what: str, least: int, most: int) -> tuple[int, ...]:
    return _once(what, tuple(whole(value, what, least, most) for value in several(given, what)))


def _numbers(given: object, what: str, least: float, most: float) -> tuple[float, ...]:
    return _once(what, tuple(float(number(value, what, least, most)) for value in several(given, what)))


def _once(what: str, values: tuple[ValueT, ...]) -> tuple[ValueT, ...]:
    """The values. Raises Refused for one that comes twice."""
    if len(set(values)) < len(values):
        raise Refusal(Message("a value stands in the list twice").at(what))
    return values


def _records(names: Sequence[str], rows: Sequence[str]) -> NDArray[np.void]:
    """The rows of a results file as records, without the last column, which is the question's."""
    kinds = [(name, "U40" if name in TEXTS else "i8" if name in COUNTS else "f8") for name in names]
    return np.array([tuple(row.split(",")[:-1]) for row in rows], kinds)
