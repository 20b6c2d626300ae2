"""The editors' desk over real tables: what is saved is sound, is the user's own, and can be taken back."""

from pathlib import Path

import pytest
from msgspec.structs import replace

from drillctl.console.queues import QueueFiles
from drillctl.console.tables import KEY_OF, TableFiles
from drillctl.machine import Library, shipped_tables
from drillctl.machine.library import user_tables
from drillctl.ui.models.phase_grid import PhaseGrid
from drillctl.viewmodel.tables import Checked, TableKind


@pytest.fixture
def user(tmp_path: Path) -> Path:
    return tmp_path / "config" / "tables"


@pytest.fixture
def bench(user: Path) -> TableFiles:
    return TableFiles(Library((user, shipped_tables())), user)


@pytest.mark.parametrize(
    ("kind", "name"),
    [("machines", "pcb-drill"), ("phase", "two-phase-forced"), ("ramp", "seven-state")],
)  # fmt: skip
def test_what_the_machine_at_hand_is_made_of_is_in_use(user: Path, kind: TableKind, name: str) -> None:
    library = Library((user, shipped_tables()))
    machine = library.machine("pcb-drill")
    used = [entry.name for entry in TableFiles(library, user, lambda: machine).tables(kind) if entry.in_use]
    assert used == [name] and not any(entry.in_use for entry in TableFiles(library, user).tables(kind))


def origin(bench: TableFiles, kind: TableKind, name: str) -> str:
    return next(entry.origin for entry in bench.tables(kind) if entry.name == name)


@pytest.mark.parametrize("kind", KEY_OF)
def test_every_shipped_table_is_found_and_sound(bench: TableFiles, kind: TableKind) -> None:
    entries = bench.tables(kind)
    assert entries and all(entry.origin == "shipped" for entry in entries)
    for entry in entries:
        text = bench.read(kind, entry.name)
        assert bench.check(kind, text).problems == ()
        assert bench.diff(kind, entry.name, text) == ()


def test_an_edit_goes_to_the_users_folder_and_wins_and_can_be_taken_back(bench: TableFiles, user: Path) -> None:
    text = bench.rows.with_state(bench.read("ramp", "seven-state"), 0, "interval", 9)
    assert bench.save("ramp", "seven-state", text) == ()
    assert (user / "ramp" / "seven-state.toml").read_text("utf-8") == text
    assert bench.read("ramp", "seven-state") == text and origin(bench, "ramp", "seven-state") == "yours"
    assert Library((user, shipped_tables())).machine("pcb-drill").axes[0].ramp.interval[0] == 9
    changes = [line for line in bench.diff("ramp", "seven-state", text) if line[:2] in ("-i", "+i")]
    assert changes == ["-interval = 7", "+interval = 9"]
    assert bench.reset("ramp", "seven-state") == ()
    assert origin(bench, "ramp", "seven-state") == "shipped"
    assert bench.reset("ramp", "seven-state") == ("there is no copy of your own to take away",)


@pytest.mark.parametrize(
    ("kind", "text", "problem"),
    [
        ("ramp", "name = 1", "[state] is missing"),
        ("phase", "name = = 1", "not TOML"),
        ("machines", "", "[axis] is missing"),
    ],
)
def test_an_invalid_text_is_never_saved(
    bench: TableFiles, user: Path, kind: TableKind, text: str, problem: str
) -> None:
    name = bench.tables(kind)[0].name
    before = bench.read(kind, name)
    assert problem in bench.save(kind, name, text)[0]
    assert not user.exists() and bench.read(kind, name) == before


def test_problems_say_the_line(bench: TableFiles) -> None:
    text = bench.rows.with_state(bench.read("ramp", "seven-state"), 2, "brake", 1)
    (found,) = bench.check("ramp", text).problems
    assert found.line is not None and text.split("\n")[found.line - 1] == "brake = 1"
    assert found.message.startswith(f"{found.line}: state 2")


def test_a_fault_in_a_table_that_a_machine_names_is_told_with_its_file(bench: TableFiles, user: Path) -> None:
    machine = bench.read("machines", "pcb-drill")
    (user / "ramp").mkdir(parents=True)
    (user / "ramp" / "seven-state.toml").write_text("name = 1\n")
    (found,) = bench.check("machines", machine).problems
    assert found.line is None and "seven-state.toml:1" in found.text


def test_a_folder_that_is_looked_at_first_is_named(tmp_path: Path, user: Path) -> None:
    first = tmp_path / "first"
    (first / "ramp").mkdir(parents=True)
    text = (shipped_tables() / "ramp" / "seven-state.toml").read_text("utf-8")
    (first / "ramp" / "seven-state.toml").write_text(text)
    bench = TableFiles(Library((first, user, shipped_tables())), user)
    (problem,) = bench.save("ramp", "seven-state", text)
    assert str(first) in problem and not user.exists()


def test_in_a_checkout_the_users_copy_comes_before_the_shipped_tables(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(shipped_tables().parent)
    assert Library.standard().folders == (user_tables(), shipped_tables())


def test_elsewhere_the_projects_tables_come_first(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    assert Library.standard().folders == (Path("tables"), user_tables(), shipped_tables())


def test_a_dangerous_table_is_saved_with_its_warnings(bench: TableFiles) -> None:
    rows = bench.rows.phase_rows(bench.read("phase", "two-phase-forced"))
    dark = [replace(row, pattern=f".{row.pattern[1:]}") for row in rows]
    text = bench.rows.with_phase_rows(bench.read("phase", "two-phase-forced"), dark)
    checked = bench.check("phase", text)
    assert checked.problems == () and any("nothing pulls" in found.text for found in checked.warnings)
    assert bench.save("phase", "two-phase-forced", text) == ()


def test_phase_rows_and_back_leave_the_text_as_it_was(bench: TableFiles) -> None:
    for entry in bench.tables("phase"):
        text = bench.read("phase", entry.name)
        assert bench.rows.with_phase_rows(text, bench.rows.phase_rows(text)) == text


def test_mirrored_forcing_opens_every_phase_in_both_directions(bench: TableFiles) -> None:
    """The paper's pulse closes a phase when the table is played backwards; mirrored, it comes first there too."""
    text = bench.read("phase", "two-phase-forced")
    grid = PhaseGrid(bench.rows.phase_rows(text)).mirrored()
    edited = bench.rows.with_phase_rows(text, grid.rows)
    assert bench.check("phase", edited) == Checked()
    rows = {row.name: row.reverse or "" for row in bench.rows.phase_rows(edited)}
    phases = list(zip(*(rows[name] for name in ("1a", "1b", "2a", "2b")), strict=True))
    forced = [column for column in range(12) if "x" in (rows["24a"][column], rows["24b"][column])]
    assert forced == [column for column in range(12) if phases[column] != phases[(column + 1) % 12]]


def test_a_ramp_is_drawn_and_an_inexact_one_is_not(bench: TableFiles) -> None:
    text = bench.read("ramp", "seven-state")
    told = bench.rows.ramp(text)
    assert told.intervals[:4] == (7, 4, 2, 1) and told.intervals[-3:] == (2, 4, 7)
    assert [(row.state, row.stop_steps, row.stop_ticks) for row in told.states][3:] == [
        (0, 0, 0), (1, 1, 4), (2, 2, 6), (3, 3, 7),
    ]  # fmt: skip
    for state in (3, 2, 1):
        text = bench.rows.with_state(text, state, "brake", 1)
    inexact = bench.rows.ramp(text)
    assert inexact.intervals == () and inexact.states[-1].brake == 1 and inexact.states[-1].stop_steps is None
    assert "not landed on exactly" in bench.save("ramp", "seven-state", text)[0]
    assert bench.rows.ramp("nonsense").states == bench.rows.ramp("name = 'x'").states == ()


@pytest.mark.parametrize(("field", "value"), [("interval", 0), ("interval", 9_999_999), ("brake", -4), ("brake", 5000)])
def test_a_number_out_of_bounds_is_shown_that_it_may_be_put_right(bench: TableFiles, field: str, value: int) -> None:
    text = bench.rows.with_state(bench.read("ramp", "seven-state"), 2, field, value)
    assert getattr(bench.rows.ramp(text).states[5], field) == value and bench.check("ramp", text).problems
    assert bench.save("ramp", "seven-state", text) != ()


def test_fields_have_values_bounds_and_choices(bench: TableFiles) -> None:
    fields = {field.place: field for field in bench.fields(bench.read("machines", "pcb-drill"))}
    assert fields[("configuration", "card_address")].value == "0x2A0"
    assert fields[("configuration", "mode")].choices == ("REAL", "SIMULATED")
    assert fields[("axis", 0, "range", 1)].value == "16535" and fields[("axis", 0, "range", 1)].axis == "x"
    assert fields[("tick_hz",)].bounds == "1..100000"
    assert fields[("configuration", "longest_drilling_s")].value == "18"
    assert fields[("configuration", "longest_drilling_s")].bounds == ">0..3600"
    assert bench.fields("name = 1") == ()


def test_a_motor_has_a_choice_of_ramps_and_of_phase_tables_for_its_wires(bench: TableFiles, user: Path) -> None:
    assert bench.copy("phase", "two-phase-forced", "mine") == ()
    fields = {field.place: field for field in bench.fields(bench.read("machines", "pcb-drill"))}
    assert fields[("axis", 2, "phase")].choices == ("mine", "two-phase-forced")
    assert "seven-state" in fields[("axis", 2, "ramp")].choices
    text, problems = bench.with_field(bench.read("machines", "pcb-drill"), ("axis", 2, "phase"), "mine")
    assert problems == () and bench.save("machines", "pcb-drill", text) == ()
    axes = Library((user, shipped_tables())).machine("pcb-drill").axes
    assert [axis.phase.name for axis in axes] == ["two-phase-forced", "two-phase-forced", "mine"]


def test_the_bit_of_a_wire_is_changed_and_never_shared(bench: TableFiles) -> None:
    text = bench.read("machines", "pcb-drill")
    wires = {field.place: field for field in bench.wires(text)}
    assert wires[("wiring", "y.24b")].value == "14" and wires[("wiring", "y.24b")].axis == "y"
    assert wires[("wiring", "y.24b")].bounds == "0..127" and len(wires) == 18
    moved, problems = bench.with_field(text, ("wiring", "y.24b"), "15")
    assert problems == () and '"y.24b" = 15' in moved and bench.check("machines", moved).problems == ()
    shared, _ = bench.with_field(text, ("wiring", "y.24b"), "13")
    assert "bit 13" in str(bench.check("machines", shared).problems[0])
    assert bench.with_field(text, ("wiring", "y.24b"), "128") == (text, ("128: out of range",))
    assert bench.wires("name = 1") == ()


def test_locked_wiring_stays(bench: TableFiles) -> None:
    text = 'locked = ["wiring"]\n' + bench.read("machines", "pcb-drill")
    assert bench.check("machines", text).problems == ()
    assert bench.with_field(text, ("wiring", "x.1a"), "4")[0] == text
    assert all(field.locked for field in bench.wires(text))


@pytest.mark.parametrize(
    ("place", "typed", "line"),
    [
        (("configuration", "card_address"), "0x300", "card_address = 0x300"),
        (("configuration", "longest_drilling_s"), "2.5", "longest_drilling_s = 2.5"),
        (("axis", 1, "range", 0), "-3", "range = [-3, 11811]"),
    ],
)
def test_a_typed_value_is_taken(bench: TableFiles, place: tuple[str | int, ...], typed: str, line: str) -> None:
    text, problems = bench.with_field(bench.read("machines", "pcb-drill"), place, typed)
    assert problems == () and line in text.split("\n")


@pytest.mark.parametrize(
    ("place", "typed", "reason"),
    [
        (("tick_hz",), "fast", "'fast': a whole number is wanted"),
        (("tick_hz",), "0", "0: out of range"),
        (("configuration", "longest_drilling_s"), "0", "out of range"),
        (("configuration", "longest_drilling_s"), "nan", "a number is wanted"),
        (("configuration", "mode"), "MAYBE", "one of REAL, SIMULATED"),
    ],
)
def test_a_wrong_value_leaves_the_text(
    bench: TableFiles, place: tuple[str | int, ...], typed: str, reason: str
) -> None:
    before = bench.read("machines", "pcb-drill")
    text, problems = bench.with_field(before, place, typed)
    assert text == before and reason in problems[0]


def test_a_copy_is_named_inside_as_well_and_can_be_driven(bench: TableFiles, user: Path) -> None:
    assert bench.copy("machines", "pcb-drill", "my-drill") == ()
    assert Library((user, shipped_tables())).machine("my-drill").name == "my-drill"
    assert "already" in bench.copy("machines", "pcb-drill", "my-drill")[0]
    assert bench.copy("machines", "pcb-drill", "../escape")[0].startswith("'../escape': a name is at most")
    assert "nothing to go back to" in bench.reset("machines", "my-drill")[0]


def test_a_folder_that_cannot_be_made_is_a_problem_and_no_crash(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    user = tmp_path / "file" / "tables"
    bench = TableFiles(Library((user, shipped_tables())), user)
    (problem,) = bench.save("ramp", "seven-state", bench.read("ramp", "seven-state"))
    assert "file" in problem


@pytest.fixture
def queue() -> QueueFiles:
    machine = Library((shipped_tables(),)).machine("pcb-drill")
    return QueueFiles(lambda: machine)


def test_commands_and_words_come_from_their_definitions(queue: QueueFiles) -> None:
    assert "KMD_GOTOdXdY" in [command.name for command in queue.commands()]
    assert {"x", "y", "z", "z_top"} <= set(queue.words())


def test_every_wrong_line_is_told_with_its_column(queue: QueueFiles) -> None:
    found = queue.check_queue("KMD_NONSENSE\n# a word\n\nKMD_CZEKAJ 5\nKMD_RUCH q=1\n")
    assert [(told.line, told.column) for told in found] == [(1, 1), (5, 10)]


def test_what_lies_between_lines_is_told_too(queue: QueueFiles) -> None:
    (found,) = queue.check_queue("KMD_KONIEC\nKMD_CZEKAJ 5\n")
    assert found.line == 2 and "KMD_KONIEC" in found.text
    assert queue.check_queue("KMD_CZEKAJ 5\n") == ()


@pytest.mark.parametrize(
    ("line", "found"),
    [
        pytest.param("KMD_GOTO_X_Y 16545 0", (), id="the whole range, from one end of it"),
        pytest.param("KMD_GOTO_X_Y 16546 0", ("X: 16546", ), id="a step more"),
        pytest.param("KMD_RUCHd x=-16546 y=99999", ("X: -16546", "Y: 99999"), id="both axes, either way"),
        pytest.param("KMD_LINIA z=836", ("Z: 836",), id="a line"),
        pytest.param("KMD_CZEKAJ 99999", (), id="ticks are no steps"),
        pytest.param("# KMD_GOTO_X_Y 99999 0", (), id="a comment"),
    ],
)  # fmt: skip
def test_moves_longer_than_the_range_are_told_although_they_may_be_tried(
    queue: QueueFiles, line: str, found: tuple[str, ...]
) -> None:
    text = f"KMD_INICJALIZACJA\n\n{line}\n"
    told = [finding.message for finding in queue.too_far(text)]
    assert [words.split(" steps ")[0] for words in told] == [f"3: {place}" for place in found]
    assert queue.check_queue(text) == () and queue.too_far("") == ()


def test_a_queue_is_kept_and_opened_again(queue: QueueFiles, tmp_path: Path) -> None:
    file = tmp_path / "new" / "q.kmd"
    assert queue.save_queue(str(file), "KMD_CZEKAJ 5\n") == ()
    assert queue.open_queue(str(file)) == ("KMD_CZEKAJ 5\n", ())
    assert "can't be read" in queue.open_queue(str(tmp_path / "none.kmd"))[1][0]
    file.write_bytes(b"\xff\xfe")
    assert "not UTF-8" in queue.open_queue(str(file))[1][0]
    assert queue.open_queue("a\0b")[1] and queue.save_queue("a\0b", "")
