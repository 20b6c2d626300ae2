"""The phase editor (Tests): the table as the paper prints it (Table 1): a row a wire with its supply and the bit that
switches it, a column a tick; Space turns a cell over.

Rule: what is drawn is the grid of the text (models/phase_grid.py); every edit goes back into the text, whose comments
stay. Bits belong to a motor, so they stand in the machine's file, and are saved there (models/wire_bits.py). Opened
from the list of tables.
"""

from collections.abc import Callable

from drillctl.language.words import N_, _, translated
from drillctl.ui.models.bench_lines import path_cells, path_charts, path_words
from drillctl.ui.models.phase_grid import ON, GridLine, PhaseGrid, WireBits
from drillctl.ui.screens.table_actions import TableActions
from drillctl.ui.screens.table_editor import TABLE_KEYS, TableEditor
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.texts import Line, around
from drillctl.viewmodel.bench import CyclePath
from drillctl.viewmodel.tables import FieldView

NAME_COLUMNS, VOLTS_COLUMNS, BIT_COLUMNS, CELL_COLUMNS = 12, 7, 5, 3
HEADING_ROWS = 1  # the numbers of the columns


class PhaseEditor(TableEditor):
    """The editor of a phase table."""

    kind = "phase"
    title = N_("Phase table")
    keys = (
        Key((" ",), N_("Space"), "toggle", N_("switches the wire on or off in this column"), N_("Cell")),
        Key(("left",), N_("Left"), "sideways", N_("a column to the left"), argument=-1),
        Key(("right",), N_("Right"), "sideways", N_("a column to the right"), argument=1),
        Key(("up",), N_("Up"), "upwards", N_("a row up"), argument=-1),
        Key(("down",), N_("Down"), "upwards", N_("a row down"), argument=1),
        Key(("insert",), "Ins", "insert", N_("the column once more, beside it"), N_("Insert")),
        Key(("delete",), "Del", "remove", N_("takes the column away"), N_("Remove")),
        Key(("m",), "M", "mirror", N_("rows for motion backwards with forcing mirrored, or none again"), N_("Mirror")),
        Key(("f6",), "F6", "change_bit", N_("another bit to switch the wire, for the motor shown"), N_("Bit")),
        Key(("tab",), "Tab", "next_motor", N_("the bits of the next motor that uses this table"), N_("Motor")),
        *TABLE_KEYS,
    )
    _line = _column = _motor = 0  # the cursor and the motor whose bits are shown, before the first look

    def toggle(self) -> None:
        """Turns the cell under the cursor over."""
        self._change(lambda grid: grid.toggle(self._line, self._column))

    def insert(self) -> None:
        """Doubles the column under the cursor."""
        self._change(lambda grid: grid.insert(self._column))

    def remove(self) -> None:
        """Removes the column under the cursor."""
        self._change(lambda grid: grid.remove(self._column))

    def mirror(self) -> None:
        """Adds rows for motion backwards with forcing mirrored, or removes those there are."""
        self._change(lambda grid: grid.without_reverse() if grid.has_reverse else grid.mirrored())

    def sideways(self, by: int) -> None:
        """Moves the cursor by so many columns; it stops at the ends."""
        self._go(self._line, self._column + by)

    def upwards(self, by: int) -> None:
        """Moves the cursor down by so many lines; it stops at the ends."""
        self._go(self._line + by, self._column)

    def next_motor(self) -> None:
        """Shows the bits of the next motor of the machine that uses this table."""
        self._motor += 1
        self._invalidate()

    def change_bit(self) -> None:
        """Asks for the wire's bit, exchanges it with a wire that has it, and saves the machine's file."""
        wire = self._wires.of(self._axis, self._grid.lines[self._line].name) if self._grid.lines else None
        if wire is None:
            self._shell.message(_("Not changed"), [_("No motor of the machine in use has this table.")])
            return
        chosen: FieldView = wire

        def accept(typed: str) -> None:
            taken = self._wires.taken_by(typed, chosen)
            if taken is None:
                self._wire(chosen, typed)
                return
            question = _("Bit {bit} switches {wire}. Exchange the two?")
            self._shell.ask(
                question.format(bit=taken.value, wire=taken.place[-1]), lambda: self._wire(chosen, typed, taken)
            )

        prompt = _("Output bit ({bounds}):").format(bounds=chosen.bounds)
        self._shell.ask_text(_("Bit of {wire}").format(wire=chosen.place[-1]), prompt, chosen.value, accept)

    def drawing(self, columns: int, rows: int) -> list[Line]:
        """The lines of the table; columns and rows around the cursor where there is no room for all."""
        if not self._grid.rows:
            return [[("danger", _("no phase table: its rows can't be read"))]]
        room = max((columns - NAME_COLUMNS - VOLTS_COLUMNS - BIT_COLUMNS) // CELL_COLUMNS, 1)
        shown = around(self._column, self._grid.columns, room)
        lines = [self._row(number, line, shown) for number, line in enumerate(self._grid.lines)]
        cursor = self._line
        if self._grid.has_reverse:
            lines.insert(len(self._grid.rows), [("title", _("backwards"))])
            cursor += self._grid.lines[self._line].backwards
        below = folded([*self._path_rows(shown), [self._place()]], columns)
        window = around(cursor, len(lines), max(rows - len(below) - HEADING_ROWS, 1))
        return [self._numbers(shown), *(lines[row] for row in window), *below]

    def picture(self, columns: int, rows: int) -> list[Line]:
        """The rotor over one cycle, and the torque that holds it."""
        return path_charts(self._path, self._saved_path, (columns, rows), self._plain)

    def _path_rows(self, shown: range) -> list[Line]:
        """Where the rotor rests in each column, and its torque there; then both in words."""
        if not self._path.columns:
            return [[""]]
        places, torques = path_cells(self._path, shown, CELL_COLUMNS, self._plain)
        margin = NAME_COLUMNS + VOLTS_COLUMNS + BIT_COLUMNS
        labels = (_("rotor, in columns"), _("torque"))
        rows: list[Line] = [
            [("dark", f"{label:{margin}}"), ("good", cells)]
            for label, cells in zip(labels, (places, torques), strict=True)
        ]
        return [*rows, path_words(self._path)]

    def _look(self) -> None:
        self._path = self._path_of(self.text)
        self._saved_path = self._path_of(self._saved)
        self._grid = PhaseGrid(tuple(self._tables.rows.phase_rows(self.text)))
        machine = self._console.view().machine
        self._wires = WireBits(self._tables, self._tables.read("machines", machine), self._name)
        self._go(self._line, self._column)
        super()._look()

    def _path_of(self, text: str) -> CyclePath:
        return self._bench.path(self._name, text) if self._bench else CyclePath()

    @property
    def _axis(self) -> str:
        """The motor whose bits are shown; empty where none uses this table."""
        motors = self._wires.motors
        return motors[self._motor % len(motors)] if motors else ""

    def _wire(self, wire: FieldView, typed: str, taken: FieldView | None = None) -> None:
        text, problems = self._wires.with_bit(wire, typed, taken)
        if problems:
            self._shell.message(_("Not changed"), [translated(problem) for problem in problems])
            return
        machine = self._console.view().machine
        TableActions(self._console, self._shell, self._tables, "machines").save(machine, text, machine, self._look)

    def _change(self, operation: Callable[[PhaseGrid], PhaseGrid]) -> None:
        changed = operation(self._grid)
        if changed != self._grid:
            self.edit(self._tables.rows.with_phase_rows(self.text, changed.rows))

    def _go(self, line: int, column: int) -> None:
        self._line = max(0, min(line, len(self._grid.lines) - 1))
        self._column = max(0, min(column, self._grid.columns - 1))
        self._invalidate()

    def _numbers(self, shown: range) -> Line:
        numbers = "".join(f"{column + 1:>{CELL_COLUMNS - 1}} " for column in shown)
        bit = _("bit") if self._axis else ""
        return [("dark", f"{_('wire'):{NAME_COLUMNS}}{'':{VOLTS_COLUMNS}}{bit:>{BIT_COLUMNS - 2}}  {numbers}")]

    def _row(self, number: int, line: GridLine, shown: range) -> Line:
        wire = None if line.backwards else self._wires.of(self._axis, line.name)
        bit = wire.value if wire else ""
        name = f"{line.name[: NAME_COLUMNS - 1]:{NAME_COLUMNS}}{line.volts:>4g} V "
        return [
            f"{name}{bit:>{BIT_COLUMNS - 2}}  ",
            *(part for column in shown for part in self._cell(number, line.pattern, column)),
        ]

    def _cell(self, number: int, pattern: str, column: int) -> Line:
        mark = pattern[column] if column < len(pattern) else " "
        here = (number, column) == (self._line, self._column)
        look = "focus" if here else "lit" if mark == ON else "dark"
        return [(look, f"[{mark}]" if here else f" {mark} ")]

    def _place(self) -> str:
        line = self._grid.lines[self._line]
        place = _("wire {name}, column {column} of {columns}")
        where = place.format(name=line.name, column=self._column + 1, columns=self._grid.columns)
        motors = ", ".join(f"[{name.upper()}]" if name == self._axis else name.upper() for name in self._wires.motors)
        return f"{where}; " + _("bits of motor {motors}").format(motors=motors) if motors else where
