"""The phase editor: the grid apart from the screen, then the screen's cells, keys and verdict."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.console.tables import TableFiles
from drillctl.language import Message
from drillctl.machine import Library, shipped_tables
from drillctl.ui.models.editing import MOST_STATES, History
from drillctl.ui.models.phase_grid import LEAST_COLUMNS, PhaseGrid
from drillctl.ui.screens.phase_editor import PhaseEditor
from drillctl.viewmodel.tables import PhaseRow
from tests.ui.editor_fakes import SIZE, Console, Shell, Tables, attributes_of, press, text_of
from tests.ui.editor_fakes import Bench as Trial

TABLE = "1a 5 xx..\n1b 5 ..xx\n24a 24 x.x."


@st.composite
def grids(draw: st.DrawFn) -> PhaseGrid:
    columns = draw(st.integers(2, 12))
    patterns = st.text("x.", min_size=columns, max_size=columns)
    names = draw(st.lists(st.sampled_from(["1a", "1b", "2a", "24a"]), min_size=1, max_size=4, unique=True))
    rows = tuple(PhaseRow(name, 24.0 if name == "24a" else 5.0, draw(patterns)) for name in names)
    return draw(st.sampled_from([PhaseGrid(rows), PhaseGrid(rows).mirrored()]))


@given(grids(), st.data())
def test_a_cell_toggled_twice_is_as_it_was(grid: PhaseGrid, data: st.DataObject) -> None:
    line = data.draw(st.integers(0, len(grid.lines) - 1))
    column = data.draw(st.integers(0, grid.columns - 1))
    once = grid.toggle(line, column)
    differing = [
        (n, c) for n, (a, b) in enumerate(zip(grid.lines, once.lines, strict=True))
        for c in range(grid.columns) if a.pattern[c] != b.pattern[c]
    ]  # fmt: skip
    assert differing == [(line, column)] and once.toggle(line, column) == grid


@given(grids(), st.data())
def test_an_inserted_column_is_its_neighbours_twin_and_goes_again(grid: PhaseGrid, data: st.DataObject) -> None:
    column = data.draw(st.integers(0, grid.columns - 1))
    longer = grid.insert(column)
    assert longer.columns == grid.columns + 1
    assert all(line.pattern[column] == line.pattern[column + 1] for line in longer.lines)
    assert longer.remove(column) == longer.remove(column + 1) == grid


@given(grids())
def test_mirroring_leaves_the_windings_and_as_many_pulses(grid: PhaseGrid) -> None:
    mirrored = grid.mirrored()
    lowest = min(row.volts for row in grid.rows)
    for row in mirrored.rows:
        assert row.reverse is not None and sorted(row.reverse) == sorted(row.pattern)
        assert row.reverse == row.pattern or row.volts > lowest
    assert mirrored.without_reverse() == grid.without_reverse()


@pytest.mark.parametrize(
    ("winding", "forcing", "mirrored"),
    [
        pytest.param("xxx...", "x..x..", "..x..x", id="stretches within the table"),
        pytest.param("xx...x", ".....x", ".x....", id="a stretch over the end"),
        pytest.param("xxxx", "x...", "...x", id="one stretch"),
    ],
)
def test_forcing_is_mirrored_within_a_stretch(winding: str, forcing: str, mirrored: str) -> None:
    grid = PhaseGrid((PhaseRow("1a", 5, winding), PhaseRow("24a", 24, forcing))).mirrored()
    assert grid.rows[1].reverse == mirrored


def test_what_is_not_there_is_left_alone() -> None:
    grid = PhaseGrid((PhaseRow("1a", 5, "x."),))
    assert grid.toggle(1, 0) == grid.toggle(0, 2) == grid.remove(0) == grid
    assert grid.columns == LEAST_COLUMNS and PhaseGrid(()).mirrored() == PhaseGrid(())


@given(st.lists(st.integers(), max_size=20))
def test_history_goes_back_to_the_first_and_forward_to_the_last(states: list[int]) -> None:
    history = History(0)
    for state in states:
        history.do(state)
    last = history.now
    while history.undo():
        pass
    assert history.now == 0
    while history.redo():
        pass
    assert history.now == last


def test_history_is_limited_and_a_new_state_ends_redo() -> None:
    history = History(0)
    for state in range(1, MOST_STATES + 10):
        history.do(state)
    undone = 0
    while history.undo():
        undone += 1
    assert undone == MOST_STATES - 1
    history.do(-1)
    assert not history.redo() and history.now == -1


@pytest.fixture
def shell() -> Shell:
    return Shell()


@pytest.fixture
def tables() -> Tables:
    return Tables(phase=TABLE)


@pytest.fixture
def editor(shell: Shell, tables: Tables) -> PhaseEditor:
    return PhaseEditor(Console(), shell, tables, "one")


def test_the_table_is_drawn_as_the_paper_prints_it(editor: PhaseEditor) -> None:
    rows = text_of(editor).split("\n")
    assert rows[0] == "Phase table: one (shipped)"
    assert [row.split() for row in rows[2:6]] == [
        ["wire", "1", "2", "3", "4"],
        ["1a", "5", "V", "[x]", "x", ".", "."],
        ["1b", "5", "V", ".", ".", "x", "x"],
        ["24a", "24", "V", "x", ".", "x", "."],
    ]
    assert "sound" in text_of(editor)


def test_space_turns_the_cell_under_the_cursor_over_and_undo_takes_it_back(editor: PhaseEditor) -> None:
    press(editor, "down", "right", " ")
    assert editor.text == "1a 5 xx..\n1b 5 .xxx\n24a 24 x.x."
    assert "[x]" in text_of(editor) and "changed" in text_of(editor)
    press(editor, "ctrl u")
    assert editor.text == TABLE and not editor.changed
    press(editor, "ctrl r")
    assert editor.changed


def test_columns_come_and_go_and_the_cursor_stays_inside(editor: PhaseEditor) -> None:
    press(editor, *["right"] * 9, "insert")
    assert editor.text.startswith("1a 5 xx...\n")
    press(editor, "right", "delete", "delete")
    assert editor.text.startswith("1a 5 xx.\n") and "column 3 of 3" in text_of(editor)


def test_rows_for_motion_backwards_appear_are_edited_and_go(editor: PhaseEditor) -> None:
    press(editor, "m")
    assert "backwards" in text_of(editor)
    press(editor, *["down"] * 5, " ")
    assert editor.text.split("\n")[2] == "24a 24 x.x. xx.x", "the mirrored row, its first cell turned over"
    press(editor, "m")
    assert editor.text == TABLE


def test_warnings_come_as_cells_change(editor: PhaseEditor) -> None:
    press(editor, " ", "right", " ")
    assert "warning: all dark" in text_of(editor)
    assert attributes_of(editor, "warning: all dark") == {"warning"}


def test_a_wide_table_shows_the_columns_around_the_cursor(shell: Shell) -> None:
    editor = PhaseEditor(Console(), shell, Tables(phase=f"1a 5 {'x.' * 40}"), "one")
    assert "40" not in text_of(editor).split("\n")[2]
    press(editor, *["right"] * 79)
    header = text_of(editor).split("\n")[2].split()
    assert header[-1] == "80" and "[.]" in text_of(editor)


def test_saving_offers_to_start_the_machine_anew(editor: PhaseEditor, shell: Shell, tables: Tables) -> None:
    press(editor, " ", "f2")
    assert tables.own["phase"] == editor.text and not editor.changed
    assert "position will be lost" in shell.asked[0] and "your own copy" in text_of(editor)


def test_a_problem_is_never_saved(shell: Shell) -> None:
    tables = Tables(phase="bad 5 xx..")
    editor = PhaseEditor(Console(), shell, tables, "one")
    assert "problem: 1: it is bad" in text_of(editor)
    press(editor, "f2")
    assert tables.own == {} and shell.told == [("Not saved", ["1: it is bad"])]


def test_reset_asks_and_goes_back_to_the_shipped_table(tables: Tables) -> None:
    tables.own["phase"] = "1a 5 x..."
    shell = Shell(says_yes=True)
    editor = PhaseEditor(Console(), shell, tables, "one")
    press(editor, "f8")
    assert len(shell.asked) == 1 and editor.text == TABLE and "(shipped)" in text_of(editor)
    press(editor, "f8")
    assert shell.told[-1] == ("Nothing changed", ["there is no copy of your own"])


def test_the_difference_is_told(editor: PhaseEditor, shell: Shell) -> None:
    press(editor, "f3", " ", "f3")
    assert [lines for _title, lines in shell.told] == [["none: this is the shipped table"], ["-before", "+after"]]


def test_a_refusal_of_the_machine_is_told(tables: Tables) -> None:
    shell, console = Shell(says_yes=True), Console()
    console.refusal = ("at work",)
    press(PhaseEditor(console, shell, tables, "one"), " ", "f2")
    assert console.chosen == ["drill"] and shell.told == [("Not loaded", ["at work"])]


def test_a_table_that_drives_nothing_here_is_saved_without_a_question(tables: Tables) -> None:
    shell, console = Shell(says_yes=True), Console()
    tables.in_use = False
    press(PhaseEditor(console, shell, tables, "one"), " ", "f2")
    assert "phase" in tables.own and not shell.asked and not console.chosen
    assert [title for title, _lines in shell.told] == ["Saved"]


def test_leaving_asks_only_where_something_would_be_lost(editor: PhaseEditor, shell: Shell) -> None:
    assert press(editor, "esc") == ["esc"]
    assert press(editor, " ", "esc") == [] and shell.asked == ["Leave without saving?"] and shell.closed == 0


def test_keys_of_others_pass(editor: PhaseEditor) -> None:
    assert press(editor, "f1", "f9", "q") == ["f1", "f9", "q"]


@pytest.mark.parametrize("size", [(20, 3), (1, 1), SIZE, (300, 60)])
def test_any_size_is_drawn(editor: PhaseEditor, size: tuple[int, int]) -> None:
    canvas = editor.render(size)
    assert (canvas.cols(), canvas.rows()) == size


def test_many_wires_show_the_cursor_and_the_verdict_at_eighty_by_twenty_four(shell: Shell) -> None:
    table = "\n".join(f"w{number} 5 xx.. x.x." for number in range(16))
    editor = PhaseEditor(Console(), shell, Tables(phase=table), "one")
    for _line in range(32):
        text = text_of(editor, (80, 17))
        assert text.count("[") == 1 and "column 1 of 4" in text and "sound" in text
        press(editor, "down")


def test_edits_that_were_given_up_are_gone(tables: Tables) -> None:
    shell = Shell(says_yes=True)
    editor = PhaseEditor(Console(), shell, tables, "one")
    press(editor, " ", "esc")
    assert shell.closed == 1 and not editor.changed and editor.text == TABLE


class AtPcbDrill(Console):
    """The console of a machine that is there."""

    def view(self) -> SimpleNamespace:
        return SimpleNamespace(**{**vars(super().view()), "machine": "pcb-drill"})


@pytest.fixture
def bench(tmp_path: Path) -> TableFiles:
    return TableFiles(Library((tmp_path, shipped_tables())), tmp_path)


@pytest.fixture
def table_1(bench: TableFiles, shell: Shell) -> PhaseEditor:
    return PhaseEditor(AtPcbDrill(), shell, bench, "two-phase-forced")


def bits_of(bench: TableFiles, *wires: str) -> list[str]:
    found = {str(field.place[-1]): field.value for field in bench.wires(bench.read("machines", "pcb-drill"))}
    return [found[wire] for wire in wires]


def test_every_row_has_the_bit_of_the_motor_that_is_shown(table_1: PhaseEditor) -> None:
    rows = text_of(table_1).split("\n")
    assert next(row for row in rows if row.startswith("24b")).split()[:4] == ["24b", "24", "V", "6"]
    assert "motor [X], Y, Z" in text_of(table_1)
    press(table_1, "tab", "tab")
    assert next(row for row in text_of(table_1).split("\n") if row.startswith("24b")).split()[3] == "22"
    press(table_1, "tab")
    assert "motor [X], Y, Z" in text_of(table_1)


def test_a_free_bit_is_taken_and_saved_to_the_machine(table_1: PhaseEditor, bench: TableFiles, shell: Shell) -> None:
    shell.types = "7"
    press(table_1, "down", "f6")
    assert bits_of(bench, "x.1b") == ["7"] and "Output bit (0..127):" in shell.asked
    assert not table_1.changed  # the phase table is as it was


@pytest.mark.parametrize("says_yes", [True, False])
def test_a_bit_of_another_wire_is_exchanged_after_a_question(
    table_1: PhaseEditor, bench: TableFiles, shell: Shell, says_yes: bool
) -> None:
    shell.types, shell.says_yes = "9", says_yes
    press(table_1, "f6")
    assert "Bit 9 switches y.1b. Exchange the two?" in shell.asked
    assert bits_of(bench, "x.1a", "y.1b") == (["9", "0"] if says_yes else ["0", "9"])


@pytest.mark.parametrize("typed", ["128", "-1", "one", ""])
def test_a_bit_that_cannot_be_is_told(table_1: PhaseEditor, bench: TableFiles, shell: Shell, typed: str) -> None:
    shell.types = typed
    press(table_1, "f6")
    assert shell.told[0][0] == "Not changed" and bits_of(bench, "x.1a") == ["0"]


def test_a_table_that_no_motor_uses_has_no_bits(bench: TableFiles, shell: Shell) -> None:
    editor = PhaseEditor(AtPcbDrill(), shell, bench, "five-phase-ten-beat")
    press(editor, "f6", "tab")
    assert shell.told == [("Not changed", ["No motor of the machine in use has this table."])]
    assert "motor" not in text_of(editor)


@pytest.fixture
def tried(shell: Shell, tables: Tables) -> tuple[PhaseEditor, Trial]:
    trial = Trial()
    return PhaseEditor(Console(), shell, tables, "one", bench=trial), trial


def test_the_rotor_stands_below_the_columns_with_its_torque(tried: tuple[PhaseEditor, Trial]) -> None:
    rows = text_of(tried[0], (80, 20)).split("\n")
    places, torques = (next(row for row in rows if row.startswith(word)) for word in ("rotor", "torque"))
    assert places.split()[-4:] == ["1", "2", "3", "4"] and torques.split()[1:] == ["█", "█"]
    assert "warning: motor X: a cycle turns it 2 of 4 columns" in "\n".join(rows)


@pytest.mark.parametrize("columns", [80, 98, 158, 218])
def test_a_trial_says_what_was_lost_at_any_size_and_holds_for_its_table_alone(
    tried: tuple[PhaseEditor, Trial], columns: int
) -> None:
    editor, trial = tried
    press(editor, "f5")
    assert "X" in text_of(editor, (columns, 30)) and "no step lost" in text_of(editor, (columns, 30))
    press(editor, " ", "enter")  # as F5
    assert "LOST 1 of 30 steps" in text_of(editor, (columns, 30)) and trial.tried == [TABLE, editor.text]
    assert "no step lost" in text_of(editor, (columns, 30)), "of the saved table"
    press(editor, "right", " ")
    assert "LOST" not in text_of(editor, (columns, 30))
    press(editor, "ctrl u")
    assert "LOST 1 of 30 steps" in text_of(editor, (columns, 30)), "it is the table that was tried"


def test_where_there_is_room_the_saved_table_stands_beside_the_changed_one(tried: tuple[PhaseEditor, Trial]) -> None:
    press(tried[0], " ", "f5")
    row = next(row for row in text_of(tried[0], (158, 45)).split("\n") if "no step lost" in row)
    assert row.index("no step lost") < row.index("LOST 1 of 30 steps")
    assert "rotor, in columns: saved, now" in text_of(tried[0], (158, 45))
    assert "What it does" not in text_of(tried[0], (80, 20))


def test_a_table_that_cannot_be_tried_is_refused_in_words(tried: tuple[PhaseEditor, Trial], shell: Shell) -> None:
    tried[1].refusal = (Message("no motor has it"),)
    press(tried[0], "f5")
    assert shell.told == [("Not tried", ["no motor has it"])] and "LOST" not in text_of(tried[0])
