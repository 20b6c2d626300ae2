"""What all editors of tables have in common: a text with its history, checked as it changes, saved, reset, compared.

Where there is room, what the table does to a motor is drawn beside it, and F5 tries it on motors of a bench.
Rule: the text is the truth; what is drawn is drawn from it, and every edit gives a new text. A text with a problem is
never saved. PhaseEditor and RampEditor are made of this.
"""

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.models.bench_lines import bench_lines, verdicts
from drillctl.ui.models.editing import History, Undoable
from drillctl.ui.screens.own_steps import TABLE_STEPS
from drillctl.ui.screens.shell import Shell, asked_to_leave
from drillctl.ui.screens.table_actions import TableActions
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import UNDO_KEYS, Key, called
from drillctl.ui.widgets.panel import BORDER_COLUMNS, panel_columns, titled, with_panel
from drillctl.ui.widgets.texts import Line, boxed
from drillctl.viewmodel.bench import Bench, BenchReport
from drillctl.viewmodel.console import Console, Problems, Watch
from drillctl.viewmodel.tables import Checked, TableEditing, TableKind, TextFinding

Size = tuple[()] | tuple[int] | tuple[int, int]  # as urwid has it; a box has two
MOST_FINDINGS = 6
FURTHER_ROWS = 3  # the heading, and empty lines around the table
CHARTS, PANEL_TEXT_ROWS = 3, 13  # of a panel: its charts, and the rows of everything else
LEAST_CHART_ROWS, MOST_CHART_ROWS = 3, 12
TABLE_KEYS = (
    Key(("f5",), "F5", "try_out", N_("tries the table on motors of a bench: which moves lose steps"), N_("Try")),
    Key(("enter",), "Enter", "try_out", N_("as F5")),
    *UNDO_KEYS,
    Key(("f2",), "F2", "save", N_("saves to your own copy; a table with a problem is never saved"), N_("Save")),
    Key(("f3",), "F3", "diff", N_("what differs from the shipped table"), N_("Diff")),
    Key(("f8",), "F8", "reset", N_("takes your own copy away: the shipped table is in force again"), N_("Reset")),
)
ORIGINS = {"shipped": N_("shipped"), "yours": N_("your own copy"), "other": N_("from a folder named first")}


class TableEditor(Undoable[str], urwid.Widget):
    """One table on the screen. A kind of table adds ``kind``, ``title``, its keys, and ``drawing``."""

    _sizing = frozenset([urwid.Sizing.BOX])
    _selectable = True
    kind: TableKind
    title: str
    keys: tuple[Key, ...] = TABLE_KEYS
    own_steps = TABLE_STEPS
    columns = 62  # kept for the table where a panel stands beside it
    _beside_table = False  # whether a panel stands there now

    def __init__(
        self, console: Console, shell: Shell, tables: TableEditing, name: str, plain: bool = False,
        bench: Bench | None = None,
    ):  # fmt: skip
        self._bench = bench
        self._reports: dict[str, BenchReport] = {}  # of texts that were tried
        self._console, self._shell, self._tables = console, shell, tables
        self._actions = TableActions(console, shell, tables, self.kind)
        self._name, self._plain = name, plain
        self._open()

    @property
    def text(self) -> str:
        """The table as it stands on the screen."""
        return self._history.now

    @property
    def changed(self) -> bool:
        """Whether the table differs from the saved one."""
        return self.text != self._saved

    @property
    def has_problem(self) -> bool:
        """Whether the table can't be saved as it stands on the screen."""
        return bool(self._checked.problems)

    @property
    def tried(self) -> bool:
        """Whether the table was tried on the bench as it stands on the screen."""
        return self._report is not None

    @property
    def loses(self) -> bool:
        """Whether a motor lost steps in that trial."""
        return self._report is not None and self._report.lost

    def drawing(self, columns: int, rows: int) -> list[Line]:
        """The lines of the table in this room; each kind of editor draws in its own way."""
        raise NotImplementedError  # by PhaseEditor and RampEditor

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws name, table and findings."""
        assert len(size) == 2
        columns, rows = size
        beside = panel_columns(columns, self.columns) if self._bench else 0
        left = columns - beside
        tried = [] if beside else verdicts(self._report, self._reports.get(self._saved))
        below = folded([*self._verdict(), *tried], left)
        self._beside_table = bool(beside)
        drawing = self.drawing(left, rows - len(below) - FURTHER_ROWS)
        main = boxed([[("title", self._heading())], [""], *drawing, [""], *below], left, rows)
        return with_panel(main, _("What it does"), self._beside(beside - BORDER_COLUMNS, rows), beside, rows)

    def keypress(self, size: Size, key: str) -> str | None:
        """Calls the method of a key in the table; Esc asks first where something is not saved."""
        taken = asked_to_leave(self, self._shell, key, self._give_up) or called(self, self.keys, key)
        return None if taken else key

    def edit(self, text: str) -> None:
        """Takes a new text into the history and checks it."""
        self._history.do(text)
        self._look()

    def _restore(self) -> None:
        self._look()

    def save(self) -> None:
        """Saves the text; its history stays, so that what was saved can be undone on the screen."""
        self._actions.save(self._name, self.text, self._console.view().machine, self._keep)

    def reset(self) -> None:
        """Goes back to the shipped table; the history ends."""
        self._actions.reset(self._name, self._open)

    def diff(self) -> None:
        """Shows what differs between the text on the screen and the shipped table."""
        self._actions.diff(self._name, self.text)

    def try_out(self) -> None:
        """Tries the table on the bench, and the saved one with it, so that both are seen side by side."""
        if self._bench is None:
            self._shell.message(_("Not tried"), [_("There are no motors to try it on.")])
            return
        bench, text = self._bench, self.text

        def work(watch: Watch) -> Problems:
            wanted = [each for each in dict.fromkeys((text, self._saved)) if each not in self._reports]
            for each in wanted:
                report, problems = bench.run(self.kind, self._name, each, watch)
                if report is not None:
                    self._reports[each] = report
                elif each == text:
                    return problems
            return ()

        self._shell.work(work, self._tried)

    def picture(self, columns: int, rows: int) -> list[Line]:
        """What else the panel shows of the table, above its trial, with charts of so many rows."""
        return []

    @property
    def _report(self) -> BenchReport | None:
        """The trial of the table as it stands on the screen."""
        return self._reports.get(self.text)

    def _tried(self, problems: Problems) -> None:
        if problems:
            self._shell.message(_("Not tried"), [translated(problem) for problem in problems])
        self._invalidate()

    def _beside(self, columns: int, rows: int) -> list[Line]:
        """The lines of the panel."""
        if columns <= 0:
            return []
        chart_rows = min(max((rows - PANEL_TEXT_ROWS) // CHARTS, LEAST_CHART_ROWS), MOST_CHART_ROWS)
        trial = bench_lines(self._report, self._reports.get(self._saved), (columns, chart_rows), self._plain)
        lines = [*self.picture(columns, chart_rows), titled(_("Bench"), columns), *trial]
        return folded(lines, columns)

    def _give_up(self) -> None:
        """Discards the edits and closes the screen."""
        self._open()
        self._shell.back()

    def _open(self) -> None:
        self._saved = self._tables.read(self.kind, self._name)
        self._history = History(self._saved)
        self._look()

    def _look(self) -> None:
        """Checks the text and redraws; each kind of editor adds what it shows of the text."""
        self._checked: Checked = self._tables.check(self.kind, self.text)
        entries = self._tables.tables(self.kind)
        self._origin = next((entry.origin for entry in entries if entry.name == self._name), "other")
        self._invalidate()

    def _keep(self) -> None:
        self._saved = self.text
        self._look()

    def _heading(self) -> str:
        changed = _(", changed") if self.changed else ""
        return f"{_(self.title)}: {self._name} ({_(ORIGINS[self._origin])}{changed})"

    def _verdict(self) -> list[Line]:
        found: list[tuple[str, str, TextFinding]] = [
            *(("danger", _("problem: "), problem) for problem in self._checked.problems),
            *(("warning", _("warning: "), warning) for warning in self._checked.warnings),
        ]
        lines: list[Line] = [[(look, label + translated(finding.message))] for look, label, finding in found]
        more = len(lines) - MOST_FINDINGS
        rest: list[Line] = [[_("and {count} more").format(count=more)]] if more > 0 else []
        return [*lines[:MOST_FINDINGS], *rest] if lines else [[("good", _("sound"))]]
