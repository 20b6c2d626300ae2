"""The configuration: every field with its words, what is typed checked at once, all saved or nothing; and the list."""

from pathlib import Path

import pytest

from drillctl.console.tables import TableFiles
from drillctl.language import words
from drillctl.machine import Library, shipped_tables
from drillctl.machine.settings import settings
from drillctl.machine.source import Source
from drillctl.ui.models.machine_fields import FIELD_WORDS, words_of
from drillctl.ui.screens.configuration import ConfigurationScreen
from drillctl.ui.screens.field_panel import hint_of
from drillctl.ui.screens.phase_editor import PhaseEditor
from drillctl.ui.screens.table_actions import label_of
from drillctl.ui.screens.table_list import EDITORS, TableList
from drillctl.viewmodel.tables import FieldView, TableEntry, TableKind
from tests.ui.editor_fakes import Bench, Console, Shell, Tables, attributes_of, press, text_of

LIBRARY = Library((shipped_tables(),))
FILE = "tick_hz 500\nmode SIMULATED\nscale 1200"


@pytest.fixture
def shell() -> Shell:
    return Shell()


@pytest.fixture
def console() -> Console:
    return Console()


@pytest.fixture
def tables() -> Tables:
    return Tables(machines=FILE)


@pytest.fixture
def screen(console: Console, shell: Shell, tables: Tables) -> ConfigurationScreen:
    return ConfigurationScreen(console, shell, tables, "one")


def row_of(screen: ConfigurationScreen, label: str) -> list[str]:
    return next(row for row in text_of(screen).split("\n") if row.startswith(label)).removeprefix(label).split()


def test_every_setting_of_a_machine_has_words() -> None:
    library = Library((shipped_tables(),))
    for name in library.machine_names():
        for setting in settings(Source.read(shipped_tables() / "machines" / f"{name}.toml")):
            place = setting.place[2:] if setting.axis else setting.place
            assert FIELD_WORDS[place].meaning
    assert words_of(FieldView(("new",), "", "1")).label == "new"


def test_a_field_has_its_unit_and_bounds_and_the_focused_one_its_meaning(screen: ConfigurationScreen) -> None:
    assert row_of(screen, "Interrupt frequency") == ["500", "Hz", "1..9999", "F12", "measures"]
    assert row_of(screen, "Mode") == ["SIMULATED", "REAL", "|", "SIMULATED"]
    assert row_of(screen, "X: scale") == ["1200", "columns/inch", "1..9999"]
    assert "Ticks a second" in text_of(screen)
    press(screen, "down")
    assert "they drive the card" in text_of(screen)


def test_what_is_typed_is_saved_with_the_rest_as_it_was(
    screen: ConfigurationScreen, shell: Shell, tables: Tables
) -> None:
    press(screen, "end", "backspace", "5", "down", "f6", "f2")
    assert tables.own["machines"] == "tick_hz 505\nmode REAL\nscale 1200"
    assert not screen.draft.changed and "position will be lost" in shell.asked[0]


def test_a_value_that_cannot_be_taken_is_told_and_nothing_is_saved(
    screen: ConfigurationScreen, shell: Shell, tables: Tables
) -> None:
    press(screen, "end", "-", "down", "down", "end", "7")
    assert "problem: Interrupt frequency: '500-': not that" in text_of(screen)
    assert attributes_of(screen, "not that") == {"danger"}
    press(screen, "f2")
    assert tables.own == {} and shell.told == [("Not saved", ["'500-': not that"])]


def test_fields_that_are_right_alone_and_wrong_together_are_not_saved(
    screen: ConfigurationScreen, shell: Shell, tables: Tables
) -> None:
    press(screen, "end", *["backspace"] * 3, *"bad")
    assert "problem: 1: it is bad" in text_of(screen)
    press(screen, "f2")
    assert tables.own == {} and shell.told == [("Not saved", ["1: it is bad"])]


def test_the_old_value_typed_again_is_no_change(screen: ConfigurationScreen) -> None:
    press(screen, "end", "1")
    assert screen.draft.changed and "changed" in text_of(screen)
    press(screen, "backspace")
    assert not screen.draft.changed


def test_choices_are_listed_and_a_field_without_any_says_so(screen: ConfigurationScreen, shell: Shell) -> None:
    press(screen, "f6")
    assert not screen.draft.changed and shell.told.pop() == ("", ["this field has no list of values: type one"])
    press(screen, "down", "f6")
    assert shell.offered == ["  REAL", "* SIMULATED"] and row_of(screen, "Mode")[0] == "REAL" and screen.draft.changed
    shell.picks = 1
    press(screen, "f6")
    assert row_of(screen, "Mode")[0] == "SIMULATED" and not screen.draft.changed


def test_the_machine_is_chosen_and_a_refusal_told(screen: ConfigurationScreen, console: Console, shell: Shell) -> None:
    console.refusal = ("the machine is at work",)
    press(screen, "f5")
    assert console.chosen == ["one"] and shell.told == [("Not loaded", ["the machine is at work"])]


def test_a_copy_is_gone_on_with(screen: ConfigurationScreen, shell: Shell) -> None:
    shell.types = "two"
    press(screen, "f7")
    assert "Configuration: two" in text_of(screen)
    press(screen, "f7")
    assert shell.told == [("Not copied", ["there is one already"])]


def test_a_copy_is_of_what_is_saved_and_loses_nothing_that_is_typed(screen: ConfigurationScreen, shell: Shell) -> None:
    shell.types = "two"
    press(screen, "end", "5", "f7")
    assert shell.told[0][0] == "Not copied" and screen.changed and "Configuration: one" in text_of(screen)


def test_reset_and_difference(console: Console, tables: Tables) -> None:
    shell = Shell(says_yes=True)
    tables.own["machines"] = FILE.replace("500", "400")
    screen = ConfigurationScreen(console, shell, tables, "one")
    press(screen, "f3", "f8")
    assert shell.told == [("Differences", ["-before", "+after"])]
    assert row_of(screen, "Interrupt frequency")[0] == "500"


class Unread(Tables):
    """Tables of which no machine's file can be read."""

    def fields(self, text: str) -> tuple[FieldView, ...]:
        return ()


def test_a_file_that_cannot_be_read_is_said_to_be_so(console: Console, shell: Shell) -> None:
    screen = ConfigurationScreen(console, shell, Unread(machines="bad"), "one")
    press(screen, "up", "down", "f6", "f5")
    assert "problem: 1: it is bad" in text_of(screen)


def test_leaving_asks_only_where_something_would_be_lost(screen: ConfigurationScreen, shell: Shell) -> None:
    assert press(screen, "esc") == ["esc"]
    assert press(screen, "end", "1", "esc") == [] and shell.asked == ["Leave without saving?"]


@pytest.mark.parametrize("kind", EDITORS)
def test_the_list_says_whose_a_table_is_and_opens_its_editor(console: Console, shell: Shell, kind: TableKind) -> None:
    tables = Tables(phase="1a 5 x.", ramp="0 0 0 1", machines=FILE)
    tables.in_use = False
    listed = TableList(console, shell, tables, kind)
    assert text_of(listed).split("\n")[0].split() == ["one", "shipped"]
    tables.own[kind] = tables.shipped[kind]
    assert "your own copy" in text_of(listed), "what changed meanwhile shows"
    press(listed, "enter")
    assert isinstance(shell.opened[0], EDITORS[kind])


def test_the_list_marks_what_the_machine_at_hand_is_driven_by(
    console: Console, shell: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    tables = Tables(phase="1a 5 x.")
    entries = [TableEntry("one", "shipped", in_use=True), TableEntry("two", "shipped")]
    monkeypatch.setattr(tables, "tables", lambda kind: entries)
    first, second = text_of(TableList(console, shell, tables, "phase")).split("\n")[:2]
    assert first.startswith("* one") and first.endswith("shipped, in use")
    assert second.startswith("  two") and second.endswith("shipped")


def test_enter_opens_at_first_a_table_in_use(console: Console, shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    tables = Tables(phase="1a 5 x.")
    entries = [TableEntry("one", "shipped"), TableEntry("two", "shipped", in_use=True)]
    monkeypatch.setattr(tables, "tables", lambda _kind: entries)
    listed = TableList(console, shell, tables, "phase")
    assert listed._current == "two"
    press(listed, "up")
    listed.fill()
    assert listed._current == "one"


def test_a_table_is_copied_from_the_list(console: Console) -> None:
    shell = Shell(types="one")
    press(TableList(console, shell, Tables(phase="1a 5 x."), "phase"), "f7")
    assert shell.told == [("Not copied", ["there is one already"])]
    assert EDITORS["phase"] is PhaseEditor


def test_two_tables_are_compared_by_name(console: Console) -> None:
    shell = Shell(types="nothing")
    listed = TableList(console, shell, Tables(machines=FILE), "machines")
    press(listed, "f3")
    shell.types = "one"
    press(listed, "f3")
    assert shell.told == [
        ("Not compared", ["there is no table named 'nothing'"]), ("Differences", ["none: they are alike"])
    ]  # fmt: skip


def test_only_a_table_of_ones_own_is_deleted_and_only_after_a_yes(console: Console) -> None:
    shell, tables = Shell(), Tables(phase="1a 5 x.")
    tables.own["phase"] = "1a 5 .x"
    listed = TableList(console, shell, tables, "phase")
    press(listed, "delete")
    assert tables.own and "for good" in shell.asked[0]
    shell.says_yes = True
    press(listed, "delete", "delete")
    assert not tables.own and shell.told == [("Nothing changed", ["it stays"])]
    tables.own["phase"] = "1a 5 .x"
    press(listed, "f8")
    assert not tables.own


def test_a_table_that_was_never_shipped_is_not_asked_about_before_its_reset_is_refused(
    console: Console, shell: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    tables = Tables(phase="1a 5 x.")
    monkeypatch.setattr(tables, "tables", lambda kind: [TableEntry("mine", "yours", ships=False)])
    press(TableList(console, shell, tables, "phase"), "f8")
    assert shell.asked == [] and shell.told == [("Nothing changed", ["there is no copy of your own"])]


def test_an_editor_left_with_edits_in_it_comes_back_as_it_was(console: Console, shell: Shell) -> None:
    listed = TableList(console, shell, Tables(phase="1a 5 x."), "phase")
    press(listed, "enter")
    press(shell.opened[0], " ")
    press(listed, "enter")
    assert shell.opened[1] is shell.opened[0]
    shell.says_yes = True
    press(shell.opened[0], "esc")
    press(listed, "enter")
    assert shell.opened[2] is not shell.opened[0]


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_at_eighty_columns_every_field_has_a_line_with_its_unit_and_bounds(
    console: Console, shell: Shell, tmp_path: Path, language: str
) -> None:
    words.use(language)
    try:
        tables = TableFiles(Library((tmp_path, shipped_tables())), tmp_path)
        screen = ConfigurationScreen(console, shell, tables, "pcb-drill")
        text = text_of(screen, (80, 60))
        fields = tables.fields(tables.read("machines", "pcb-drill"))
        for field in fields:
            unit = words._(words_of(field).unit)
            line = next(row for row in text.split("\n") if row.startswith(f"{label_of(field)} "))
            assert field.value.split()[0] in line and unit in line and field.bounds in line
        assert text.split("\n").index(line) <= len(fields) + 2, "the last one: none of them wraps"
    finally:
        words.use("en")


def test_beside_the_fields_stands_what_the_one_under_the_cursor_means_and_what_the_changes_will_do(
    screen: ConfigurationScreen,
) -> None:
    wide = text_of(screen, (158, 40))
    assert "unit: Hz" in wide and "may be: 1..9999" in wide and "in the file: 500" in wide
    assert "nothing was changed" in wide
    press(screen, "end", "1")
    wide, small = text_of(screen, (158, 40)), text_of(screen, (80, 24))
    assert "typed: 5001" in wide and "what was typed does something" in wide
    assert "what was typed does something" in small and "unit: Hz" not in small


def test_the_tick_rate_that_this_computer_carries_is_measured_and_stands_beside(console: Console, shell: Shell) -> None:
    bench = Bench()
    screen = ConfigurationScreen(console, shell, Tables(machines=FILE), "one", bench=bench)
    press(screen, "f12")
    assert "this computer carries 1000 Hz" in text_of(screen, (158, 40))
    assert "this computer carries 1000 Hz" in text_of(screen, (80, 24))
    assert row_of(screen, "Interrupt frequency")[-2:] == ["here", "1000"]
    bench.refusal = ("Linux only",)
    press(screen, "f12")
    assert shell.told == [("Not measured", ["Linux only"])]


def test_the_list_names_the_motors_and_shows_the_table_under_the_cursor(
    console: Console, shell: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    tables = Tables(phase="1a 5 x.")
    entries = [TableEntry("one", "shipped", in_use=True, motors=("x", "y"))]
    monkeypatch.setattr(tables, "tables", lambda _kind: entries)
    listed = TableList(console, shell, tables, "phase")
    assert "shipped, in use: X Y" in text_of(listed, (80, 24)) and "1a 5 x." not in text_of(listed, (80, 24))
    wide = text_of(listed, (158, 40))
    assert "Motors with this table" in wide and "drill: X, Y" in wide and "1a 5 x." in wide


def test_the_papers_fields_come_first_in_its_order(tmp_path: Path) -> None:
    fields = TableFiles(LIBRARY, tmp_path).fields(TableFiles(LIBRARY, tmp_path).read("machines", "pcb-drill"))
    names = [".".join(filter(None, (field.axis, str(field.place[-1])))) for field in fields]
    figure_4 = ["card", "card_address", "mode", *(f"{axis}.columns_per_inch" for axis in "xyz"),
                *(f"{axis}.{end}" for axis in "xyz" for end in (0, 1)),
                "longest_drilling_s", "tool_change", "tick_hz", "description"]  # fmt: skip
    assert names[: len(figure_4)] == figure_4
    assert [name for name in names if name.endswith((".phase", ".ramp"))] == [
        f"{axis}.{table}" for axis in "xyz" for table in ("phase", "ramp")
    ]


def test_what_a_change_does_is_told_in_figures_of_the_machine(tmp_path: Path) -> None:
    files = TableFiles(LIBRARY, tmp_path)
    before = files.read("machines", "pcb-drill")
    after, problems = files.with_field(before, ("tick_hz",), "1000")
    told = [str(effect) for effect in files.effects(before, after)]
    assert problems == () and "X: fastest travel: 10.58 mm/s now, then 21.17 mm/s" in told
    assert "time between two ticks: 2 ms now, then 1 ms" in told
    assert files.effects(before, before) == [] == files.effects(before, "nonsense [")
    assert ("pcb-drill", ("x", "y", "z")) in files.users("phase", "two-phase-forced")


def test_a_long_list_of_values_is_counted_in_the_row_and_told_by_f6() -> None:
    ramps = tuple(f"a-ramp-{number}" for number in range(5))
    assert hint_of(FieldView(("axes", "x", "ramp"), "x", "a-ramp-0", ramps), None) == [("dark", "5 values: F6")]
    assert hint_of(FieldView(("axes", "x", "ramp"), "x", "a-ramp-0", ramps[:2]), None) == [
        ("dark", "a-ramp-0 | a-ramp-1")
    ]
