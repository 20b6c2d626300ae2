"""The picture of a sweep: which share of its machines loses steps, against the factor with most values; of boards a
heat map over two factors.

Rule: a line (a row of the map) for each phase table, ramp or other value, as far as there is room; over the rest it is
the mean.
"""

from itertools import product
from math import prod
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.files.inputs import read_bytes
from drillctl.lab.answers import head
from drillctl.lab.question import MOST_MACHINES, Question
from drillctl.lab.sweep import LONGEST_ROW_BYTES
from drillctl.language import Message
from drillctl.viewmodel.reports import Chart, Curve, HeatMap, Picture, Style

LARGEST_RESULTS_BYTES = MOST_MACHINES * LONGEST_ROW_BYTES
MOST_LINES = 8
TICK_HZ = 2  # the first factor that is a number; the last, the draw, is none to look at
Factor = tuple[str, tuple[float, ...] | tuple[str, ...]]


def losing(path: Path, question: Question) -> NDArray[np.bool_]:
    """(machines,): which of them lost steps in any move or on the board, from a whole results file."""
    lost = head(question).split(",").index("lost")
    rows = read_bytes(path, LARGEST_RESULTS_BYTES, Message("a results file")).decode().splitlines()[1:]
    return np.array([row.split(",")[lost] != "0" for row in rows])


def sweep_picture(question: Question, lost: NDArray[np.bool_], machine: str, heat: bool = False) -> Picture:
    """The picture, from which machines lost steps (machines,); ``machine`` is the name of the one that was varied;
    ``heat``: the two factors with most values as a heat map, as it always is where a board is drilled.
    """
    factors = _factors(question)
    across = max(range(TICK_HZ, len(factors) - 1), key=lambda place: len(factors[place][1]))
    board = question.board
    heat = heat or board is not None
    beside = [_row_factor(factors, across)] if heat else _lines_by(factors, across)
    shares = _mean_but(lost.astype(np.float64).reshape(question.shape), across, beside)
    notes = [f"{int(lost.sum())} of {len(lost)} machines lose steps"]
    if mixed := [factors[n][0] for n in range(len(factors)) if n not in (across, *beside) and len(factors[n][1]) > 1]:
        notes.append(f"each point is the mean over all values of {', '.join(mixed)}")
    fixed = ", ".join(f"{name} {values[0]}" for name, values in factors[:-1] if len(values) == 1)
    notes += [f"with {fixed}"] * bool(fixed) + [f"the question: {question.digest}"]
    labels = _labels([factors[place] for place in beside])
    title = f"{machine}, axis {question.axis.name}: which machines lose steps"
    if board is not None:
        title = f"{machine}: which machines lose steps, or do not drill {board.name} to its end"
    drawn = _heat(factors[across], factors[beside[0]], shares) if heat else _lines(factors[across], labels, shares)
    return Picture(title, (drawn,), tuple(notes))


def _lines(across: Factor, labels: list[str], shares: NDArray[np.float64]) -> Chart:
    name, places = across
    style = Style.LINE if len(places) > 1 else Style.POINTS
    curves = (
        Curve.of(label, np.array(places, np.float64), 100.0 * share, style)
        for label, share in zip(labels, shares, strict=True)
    )
    return Chart(name, "machines that lose steps, %", tuple(curves))


def _heat(across: Factor, beside: Factor, shares: NDArray[np.float64]) -> HeatMap:
    names = (tuple(f"{value:g}" if isinstance(value, float) else str(value) for value in values)
             for _, values in (across, beside))  # fmt: skip
    columns, rows = names
    return HeatMap("machines that lose steps", across[0], beside[0], columns, rows, shares)


def _row_factor(factors: list[Factor], across: int) -> int:
    """The place of the factor with most values beside ``across``, and no draw."""
    others = [place for place in range(len(factors) - 1) if place != across]
    return max(others, key=lambda place: len(factors[place][1]))


def _factors(question: Question) -> list[Factor]:
    """Names and values, in the order of the question's shape."""
    return [
        ("phase", tuple(name for name, _ in question.phases)),
        ("ramp", tuple(ramp.name for ramp in question.ramps)),
        ("tick_hz", question.rates_hz),
        *((f"times {name}", values) for name, values in question.times),
        ("load_nm", question.loads_nm),
        ("draw", tuple(range(question.draws))),
    ]


def _lines_by(factors: list[Factor], across: int) -> list[int]:
    """Places of the factors whose values become lines: tables first, as many as there is room for, and no draw."""
    chosen: list[int] = []
    for place in range(len(factors) - 1):
        values = len(factors[place][1])
        room = MOST_LINES // prod(len(factors[each][1]) for each in chosen)
        if place != across and 1 < values <= room:
            chosen.append(place)
    return chosen


def _labels(factors: list[Factor]) -> list[str]:
    """A label for each line: the values that it has of these factors."""
    points = product(*([f"{name} {value}" for value in values] for name, values in factors))
    return [", ".join(point) or "all" for point in points]


def _mean_but(grid: NDArray[np.float64], across: int, beside: list[int]) -> NDArray[np.float64]:
    """(lines, places): the mean over all other factors."""
    lines = np.moveaxis(grid, (*beside, across), range(len(beside) + 1))
    means = lines.reshape(*lines.shape[: len(beside) + 1], -1).mean(axis=-1)
    return means.reshape(-1, grid.shape[across])
