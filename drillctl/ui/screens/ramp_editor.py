"""The ramp editor (Tests): a row a state, its numbers typed over; the speed of a long move drawn as you type.

Rule: a number goes into the text with every digit, so that profile, stopping distances and exactness are always those
of what is on the screen; an unfinished number goes nowhere.
"""

from collections.abc import Sequence

from drillctl.language.words import N_, _, ngettext
from drillctl.ui.models.bench_lines import chart
from drillctl.ui.screens.table_editor import TABLE_KEYS, Size, TableEditor
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.texts import Line, around
from drillctl.viewmodel.tables import StateRow

FIELDS = ("accelerate", "brake", "interval")  # as in the file
HEADINGS = (N_("state"), N_("accelerate"), N_("brake"), N_("interval"), N_("stop steps"), N_("stop ticks"))
CELL_COLUMNS = 12
SIGNS = tuple("-0123456789")
MOST_DIGITS = 7
PROFILE_ROWS, WIDEST_BAR = 5, 4  # rows, and columns of a step
LEAST_STATES = 3


class RampEditor(TableEditor):
    """The editor of a ramp."""

    kind = "ramp"
    title = N_("Ramp")
    keys = (
        Key(("left",), N_("Left"), "sideways", N_("a number to the left"), argument=-1),
        Key(("right", "tab"), N_("Right"), "sideways", N_("a number to the right"), argument=1),
        Key(("up",), N_("Up"), "upwards", N_("a state up"), argument=-1),
        Key(("down",), N_("Down"), "upwards", N_("a state down"), argument=1),
        Key(("backspace",), "Backspace", "rub_out", N_("takes the last digit away")),
        Key(("insert",), "Ins", "more", N_("a pair of states more; numbers are proposed"), N_("Add")),
        Key(("delete",), "Del", "fewer", N_("takes the outermost pair of states away"), N_("Remove")),
        Key((), "0-9 -", "type", N_("types over the number"), N_("Number")),  # which one: see keypress
        *TABLE_KEYS,
    )
    columns = 74
    _line = _field = 0  # the cursor, before the first look
    _typed: str | None = None  # the number being typed; None: the file's

    def keypress(self, size: Size, key: str) -> str | None:
        """Types a digit or a sign; any other key is handled as in every editor of tables."""
        if key not in SIGNS:
            return super().keypress(size, key)
        self.type(key)
        return None

    def type(self, sign: str) -> None:
        """Adds a digit or a leading minus to the number; the first one replaces the number."""
        typed = (self._typed or "") + sign
        if len(typed) <= MOST_DIGITS and "-" not in typed[1:]:
            self._take(typed)

    def rub_out(self) -> None:
        """Removes the last digit of the number being typed."""
        self._take(self._shown()[:-1])

    def more(self) -> None:
        """Adds a pair of states; the cursor stays on its state."""
        self._reach(higher=True)

    def fewer(self) -> None:
        """Removes the outermost pair of states; the last three states stay."""
        self._reach(higher=False)

    def sideways(self, by: int) -> None:
        """Moves the cursor by so many numbers; it stops at the ends."""
        self._go(self._line, self._field + by)

    def upwards(self, by: int) -> None:
        """Moves the cursor down by so many states; it stops at the ends."""
        self._go(self._line + by, self._field)

    def undo(self) -> None:
        """Takes the last change back, and a half-typed number with it."""
        self._typed = None
        super().undo()

    def redo(self) -> None:
        """Makes the change again that was undone last."""
        self._typed = None
        super().redo()

    def drawing(self, columns: int, rows: int) -> list[Line]:
        """The lines of the states, those around the cursor where there is no room for all, and the profile."""
        if not self._ramp.states:
            return [[("danger", _("no ramp: its rows can't be read"))]]
        cells = min(columns // CELL_COLUMNS, len(HEADINGS))  # the others are left out
        heading = "".join(f"{_(word):>{CELL_COLUMNS}}" for word in HEADINGS[:cells])
        profile = [] if self._beside_table else self._profile(columns, PROFILE_ROWS)
        window = around(self._line, len(self._ramp.states), max(rows - len(profile) - 2, LEAST_STATES))
        states = [self._row(line, self._ramp.states[line])[:cells] for line in window]
        return [[("dark", heading)], *states, [""], *profile]

    def _look(self) -> None:
        self._ramp = self._tables.rows.ramp(self.text)
        self._line = max(0, min(self._line, len(self._ramp.states) - 1))  # undone, there may be fewer
        super()._look()

    def _reach(self, higher: bool) -> None:
        state = self._ramp.states[self._line].state if self._ramp.states else 0
        self.edit(self._tables.rows.with_top(self.text, higher))
        states = [row.state for row in self._ramp.states]
        self._go(states.index(state) if state in states else 0 if state < 0 else len(states) - 1, self._field)

    def _take(self, typed: str) -> None:
        """Shows what is typed, and puts it into the text as soon as it is a number."""
        if not self._ramp.states:
            return
        self._typed = typed
        if typed.lstrip("-"):
            state = self._ramp.states[self._line].state
            self.edit(self._tables.rows.with_state(self.text, state, FIELDS[self._field], int(typed)))
        self._invalidate()

    def _go(self, line: int, field: int) -> None:
        self._typed = None
        self._line = max(0, min(line, len(self._ramp.states) - 1))
        self._field = max(0, min(field, len(FIELDS) - 1))
        self._invalidate()

    def _shown(self) -> str:
        """The text of the number under the cursor."""
        if self._typed is not None or not self._ramp.states:
            return self._typed or ""
        return str(getattr(self._ramp.states[self._line], FIELDS[self._field]))

    def _row(self, line: int, state: StateRow) -> Line:
        cells = [self._cell(line, field, getattr(state, name)) for field, name in enumerate(FIELDS)]
        stopping = ("?" if value is None else value for value in (state.stop_steps, state.stop_ticks))
        return [f"{state.state:>{CELL_COLUMNS}}", *cells, *(f"{value:>{CELL_COLUMNS}}" for value in stopping)]

    def _cell(self, line: int, field: int, value: int) -> str | tuple[str, str]:
        if (line, field) != (self._line, self._field):
            return f"{value:>{CELL_COLUMNS}}"
        return "focus", f"{'[' + self._shown() + ']':>{CELL_COLUMNS}}"

    def picture(self, columns: int, rows: int) -> list[Line]:
        """The profile over the steps, then the way over the time, each with its extremes."""
        ticks = self._ramp.intervals
        if not ticks:
            return self._profile(columns, rows)
        way = [step for step, waited in enumerate(ticks) for _tick in range(waited)]
        drawn = chart(_("way in steps, over the ticks"), way, (columns, rows), self._plain)
        return [*self._profile(columns, rows), [""], *drawn]

    def _profile(self, columns: int, rows: int) -> list[Line]:
        ticks = self._ramp.intervals
        if not ticks:
            return folded([[("warning", _("no profile: a ramp is drawn when every move lands exactly"))]], columns)
        lasting = ngettext("{count} tick", "{count} ticks", sum(ticks)).format(count=sum(ticks))
        caption = ngettext(
            "speed of each step in a move of {count} step, {ticks}",
            "speed of each step in a move of {count} steps, {ticks}",
            len(ticks),
        ).format(count=len(ticks), ticks=lasting)
        wide = max(min(columns // len(ticks), WIDEST_BAR), 1)
        speeds = [1 / interval for interval in ticks for _column in range(wide)]
        bars = bar_rows(speeds, columns, rows, self._plain)
        profile: list[Line] = [[("lit", row)] for row in bars]
        return [*folded([[caption]], columns), *profile, [("good", _("every move lands exactly"))]]


EIGHTHS = " ▁▂▃▄▅▆▇█"


def bar_rows(values: Sequence[float], columns: int, rows: int, plain: bool = False) -> list[str]:
    """``rows`` lines from the top, the greatest value as high as all of them. Values beyond ``columns`` are left out.

    A value above zero is always seen, if only as the lowest eighth.
    """
    greatest = max(values, default=0.0)
    if greatest <= 0 or rows < 1:
        return [""] * rows
    heights = [max(round(value / greatest * rows * 8), int(value > 0)) for value in values[:columns]]
    return ["".join(_cell(height - 8 * below, plain) for height in heights) for below in range(rows - 1, -1, -1)]


def _cell(eighths: int, plain: bool) -> str:
    filled = min(max(eighths, 0), 8)
    return ("#" if filled >= 4 else " ") if plain else EIGHTHS[filled]
