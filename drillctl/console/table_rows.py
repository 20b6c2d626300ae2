"""Phase tables and ramps as rows: read from a text, and changed in it.

Rule: functions of texts; comments and layout stay. A text that can't be read has no rows, and is left as it is.
"""

from collections.abc import Callable, Sequence
from pathlib import Path

from drillctl.machine import TableError, intervals
from drillctl.machine.edit import (
    UNSAVED,
    set_pattern,
    set_reverse,
    set_state_row,
    with_rows,
    with_states,
    without_states,
)
from drillctl.machine.phase import phase_rows
from drillctl.machine.ramp_file import is_computed, parse_ramp, proposals, ramp_rows
from drillctl.machine.ramp_formula import MOST_STATES
from drillctl.machine.source import Source
from drillctl.machine.travel import stopping
from drillctl.viewmodel.tables import PhaseRow, RampDrawing, StateRow


class TableRows:
    """A RowEditing (viewmodel/tables.py). ``is_sound`` says whether the text of a ramp can be loaded."""

    def __init__(self, is_sound: Callable[[str], bool]):
        self._is_sound = is_sound

    def phase_rows(self, text: str) -> tuple[PhaseRow, ...]:
        """The rows of a phase table, sound or not; none where they can't be read."""
        try:
            return tuple(PhaseRow(*row) for row in phase_rows(source_of(text)))
        except TableError:
            return ()

    def with_phase_rows(self, text: str, rows: Sequence[PhaseRow]) -> str:
        """The text with these rows changed; comments and layout stay."""
        for row in rows:
            text = set_pattern(text, row.name, row.pattern)
        return set_reverse(text, {row.name: row.reverse for row in rows if row.reverse is not None})

    def ramp(self, text: str) -> RampDrawing:
        """The rows of a ramp, sound or not; of one that lands exactly also its drawing."""
        source = source_of(text)
        try:
            rows = ramp_rows(source)
        except TableError:
            return RampDrawing(())
        try:
            ramp = parse_ramp(source)
        except TableError:
            return RampDrawing(tuple(StateRow(*row) for row in rows))
        states = tuple(StateRow(*row, *stopping(ramp, row[0])) for row in rows)
        return RampDrawing(states, tuple(intervals(ramp, ramp.straight_from())))

    def with_state(self, text: str, state: int, field: str, value: int) -> str:
        """The text with a field of a state changed; comments and layout stay."""
        return set_state_row(_in_rows(text), state, field, value)

    def with_top(self, text: str, higher: bool) -> str:
        """The text with a state more on top, or a state less. For a new state numbers are tried until every move lands
        exactly; where none does, the first are taken, and the editor shows what is wrong.
        """
        try:
            rows = ramp_rows(source_of(text))
        except TableError:
            return text
        text = _in_rows(text)
        top = rows[-1][0]
        if not higher:
            return without_states(text, top) if top > 1 else text
        if top >= MOST_STATES:
            return text
        tried = [with_states(text, *row) for row in proposals(rows[-1])]
        return next((changed for changed in tried if self._is_sound(changed)), tried[0])


def source_of(text: str) -> Source:
    """A text as the readers of tables take it, of no file."""
    return Source(Path(UNSAVED), text)


def _in_rows(text: str) -> str:
    """The text with the rows of a computed ramp written out, so that single ones can be changed."""
    source = source_of(text)
    try:
        return with_rows(text, ramp_rows(source)) if is_computed(source) else text
    except TableError:
        return text  # figures that make no ramp: nothing to write out
