"""Ramp tables: files in which an automaton's rows stand one by one, or are computed from a few figures.

Rule: a ramp that would not land exactly on every distance is refused with the row to change.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal

import msgspec

from drillctl.language import Counted, Message
from drillctl.machine.phase import Name
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_formula import LONGEST_INTERVAL, MOST_STATES, Computed, FormulaError, computed_intervals
from drillctl.machine.source import Source

LONGEST_DISTANCE = 10_000
SAME_SCALE = 1e-4  # how far two lengths of a pulse may differ: as the rounding of a file's figures
Interval = Annotated[int, msgspec.Meta(ge=1, le=LONGEST_INTERVAL)]
Distance = Annotated[int, msgspec.Meta(ge=-LONGEST_DISTANCE, le=LONGEST_DISTANCE)]
Row = tuple[int, int, int, int]


class _Row(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    state: Annotated[int, msgspec.Meta(ge=-MOST_STATES, le=MOST_STATES)]
    accelerate: Distance
    brake: Distance
    interval: Interval


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    state: Annotated[list[_Row], msgspec.Meta(min_length=3, max_length=2 * MOST_STATES + 1)]
    description: str = ""
    short_strokes: Literal["triangle", "whole"] = "triangle"


class _ComputedFile(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    computed: Computed
    description: str = ""
    short_strokes: Literal["triangle", "whole"] = "triangle"


class _WrittenRow(msgspec.Struct, frozen=True):
    state: int
    accelerate: int
    brake: int
    interval: int


class _Written(msgspec.Struct, frozen=True):
    """The rows of an editor: any number is allowed, so that a wrong one can be shown and corrected."""

    state: list[_WrittenRow]


def read_ramp(file: Path) -> RampTable:
    """Reads and checks a ramp table. Raises TableError naming the file, the state and the reason."""
    return parse_ramp(Source.read(file))


def parse_ramp(source: Source) -> RampTable:
    """Like ``read_ramp``, from a text. Every distance must be landed on exactly."""
    return _from_figures(source) if is_computed(source) else _from_rows(source)


def is_computed(source: Source) -> bool:
    """Returns whether the file gives figures in place of rows. Raises TableError for what is not TOML."""
    return "computed" in source.tree()


def computed_figures(source: Source) -> Computed | None:
    """Returns the figures of a computed ramp, None of one that is written in rows. Raises TableError."""
    return source.records(_ComputedFile).computed if is_computed(source) else None


def scale_misfit(source: Source, tick_hz: int, pulse_mm: float) -> Message | None:
    """Returns why a ramp is not one for this scale: ticks a second, millimetres a pulse; None where it is. Rows of
    ticks fit every machine.
    """
    figures = computed_figures(source)
    if figures is None or (figures.tick_hz == tick_hz and abs(figures.pulse_mm / pulse_mm - 1) < SAME_SCALE):
        return None
    return Message(
        "{file} is computed for {made_hz} ticks a second and {made_mm} mm a pulse, and this axis has {hz} and {mm}; "
        "change them there",
        file=source.file.name,
        made_hz=figures.tick_hz,
        made_mm=f"{figures.pulse_mm:g}",
        hz=tick_hz,
        mm=f"{pulse_mm:.6g}",
    )


def _from_figures(source: Source) -> RampTable:
    """A state a step: so braking from state s takes s steps, and no distance is missed."""
    raw = source.records(_ComputedFile)
    try:
        intervals = computed_intervals(raw.computed)
    except FormulaError as error:
        raise source.error(error.reason, "computed", error.key) from error
    top = len(intervals) - 1
    states = tuple(map(abs, (*range(top + 1), *range(-top, 0))))
    return RampTable(
        raw.name,
        top,
        tuple(intervals[state] for state in states),
        states,
        tuple(state + 1 if state else 0 for state in states),
        raw.short_strokes == "whole",
    )


def _from_rows(source: Source) -> RampTable:
    raw = source.records(_File)
    for index, row in enumerate(raw.state):
        _check_row(source, index, row)
    rows = _rows_by_state(source, raw)
    top = max(rows)
    order = [raw.state[rows[state]] for state in (*range(top + 1), *range(-top, 0))]
    ramp = RampTable(
        raw.name,
        top,
        tuple(row.interval for row in order),
        tuple(abs(row.accelerate) for row in order),
        tuple(abs(row.brake) for row in order),
        raw.short_strokes == "whole",
    )
    _check_order(source, raw, rows)
    if (inexact := ramp.first_inexact()) is not None:
        state, steps = inexact
        reason = Counted(
            "state {state}: a move of {count} step is not landed on exactly; brake earlier",
            "state {state}: a move of {count} steps is not landed on exactly; brake earlier",
            steps,
            state=state,
        )
        raise source.error(reason, "state", rows[state], "brake")
    return ramp


def ramp_rows(source: Source) -> list[Row]:
    """Returns state, accelerate, brake and interval of each row by state: as written, right or wrong, or as computed.
    Raises TableError.
    """
    if is_computed(source):
        ramp = _from_figures(source)
        return [_row_of(ramp, state) for state in range(-ramp.top, ramp.top + 1)]
    rows = source.records(_Written).state
    return sorted((row.state, row.accelerate, row.brake, row.interval) for row in rows)


def _row_of(ramp: RampTable, state: int) -> Row:
    sign = -1 if state < 0 else 1
    return state, sign * ramp.accelerate[state], sign * ramp.brake[state], ramp.interval[state]


def proposals(top_row: Row) -> Iterator[Row]:
    """Yields rows for the state above the top one, for an editor to try: as fast as that one, braking ever earlier."""
    state, accelerate, brake, interval = top_row
    for further in range(1, 2 * state + 2):
        yield state + 1, accelerate + 1, brake + further, interval


def _rows_by_state(source: Source, raw: _File) -> dict[int, int]:
    """Returns the index of each state's row; every state from -n to n must have just one."""
    rows: dict[int, int] = {}
    for index, row in enumerate(raw.state):
        if row.state in rows:
            raise source.error(
                Message("state {state}: a second row of this state", state=row.state), "state", index, "state"
            )
        rows[row.state] = index
    top = max(map(abs, rows))
    if missing := [state for state in range(-top, top + 1) if state not in rows]:
        reason = Message(
            "no row for state {states}; a ramp has all from {lowest} to {top}",
            states=", ".join(map(str, missing)),
            lowest=-top,
            top=top,
        )
        raise source.error(reason, "state", 0)
    return rows


def _check_row(source: Source, index: int, row: _Row) -> None:
    for key, distance in (("accelerate", row.accelerate), ("brake", row.brake)):
        if distance * row.state < 0 or (row.state == 0) != (distance == 0):
            reason = Message(
                "state {state}: {key} distance {distance} must have the state's sign (0 for state 0)",
                state=row.state,
                key=key,
                distance=distance,
            )
            raise source.error(reason, "state", index, key)


def _check_order(source: Source, raw: _File, rows: dict[int, int]) -> None:
    for state, index in rows.items():
        below = state - (state > 0) + (state < 0)
        if state and abs(raw.state[index].brake) < abs(raw.state[rows[below]].brake):
            distance = raw.state[index].brake
            reason = Message(
                "state {state}: brake distance {distance} is below state {below}'s",
                state=state,
                distance=distance,
                below=below,
            )
            raise source.error(reason, "state", index, "brake")
