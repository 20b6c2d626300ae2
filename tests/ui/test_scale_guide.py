"""The scale of an axis measured on the screen, over the program's own tables; and what may not be changed at all."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.console.tables import TableFiles
from drillctl.machine import Library, TableError, shipped_tables
from drillctl.ui.screens.configuration import ConfigurationScreen
from drillctl.ui.screens.scale_guide import GREATEST_CHANGE, LEAST_TRAVEL_MM, Measurement
from drillctl.ui.screens.table_actions import differences
from drillctl.viewmodel.console import Problems
from tests.ui.editor_fakes import Shell, press, text_of

LOCKED = 'locked = ["tick_hz", "x.range"]\n'


@dataclass
class Answers(Shell):
    """Types these, one after the other; nothing more when they are used up."""

    typed: list[str] = field(default_factory=list)

    def ask_text(self, title: str, prompt: str, text: str, accept: Callable[[str], None]) -> None:
        self.asked.append(prompt)
        if self.typed:
            accept(self.typed.pop(0))


class Rig:
    """A console whose X goes where it is sent, at once."""

    def __init__(self) -> None:
        self.x = SimpleNamespace(name="x", position_steps=100, steps_per_mm=1200 / 25.4)
        self.moving, self.machine = False, "pcb-drill"
        self.chosen: list[str] = []
        self.slip = 0
        self.refusal: Problems = ()

    def view(self) -> Any:
        return SimpleNamespace(machine=self.machine, moving=self.moving, command="", axes=(self.x,))

    def jog(self, axis: str, steps: int) -> Problems:
        if not self.refusal:
            self.x.position_steps += steps - self.slip
        return self.refusal

    def choose_machine(self, name: str) -> Problems:
        self.chosen.append(name)
        return ()


@pytest.fixture
def tables(tmp_path: Path) -> TableFiles:
    library = Library((tmp_path, shipped_tables()))
    return TableFiles(library, tmp_path, lambda: library.machine("pcb-drill"))


def measure(rig: Rig, tables: TableFiles, *typed: str, yes: bool = True) -> tuple[Answers, ConfigurationScreen]:
    """With the cursor on the scale of X."""
    shell = Answers(says_yes=yes, typed=list(typed))
    screen = ConfigurationScreen(rig, shell, tables, "pcb-drill")
    press(screen, "down", "down", "down", "f12")
    return shell, screen


def test_a_measured_scale_is_shown_beside_the_old_one_and_saved_on_a_yes(tables: TableFiles) -> None:
    rig = Rig()
    shell, screen = measure(rig, tables, "2400", "51,3")
    told = "2400 steps, 51.3 mm: 1188 columns/inch instead of 1200 (-1.00 %). A reading wrong by 0.1 mm makes 0.19 %."
    assert shell.told == [] and told in shell.asked[2] and "X: scale" in text_of(screen)
    text = tables.read("machines", "pcb-drill")
    assert "columns_per_inch = 1188" in text and "[[axis]] # moves the head" in text, "comments stay"
    assert text.count("columns_per_inch = 1200") == 2, "of X alone"
    assert rig.chosen == ["pcb-drill"]


def test_a_no_saves_nothing(tables: TableFiles) -> None:
    before = tables.read("machines", "pcb-drill")
    measure(Rig(), tables, "2400", "51.3", yes=False)
    assert tables.read("machines", "pcb-drill") == before


@pytest.mark.parametrize(
    ("typed", "why"),
    [
        (["2400", "12"], "5080 columns/inch instead of 1200 is not plausible"),
        (["2400", "508"], "120 columns/inch instead of 1200 is not plausible"),
        (["2400", "nan"], "not a number"),
        (["2400", "inf"], "not a number"),
        (["2400", "a lot"], "'a lot' is not a number"),
        (["2400", "0"], "too short to measure by"),
        (["0", "10"], "has not moved"),
        (["2.5"], "'2.5' is not a whole number"),
    ],
)
def test_what_can_not_be_is_refused_and_nothing_is_saved(typed: list[str], why: str, tables: TableFiles) -> None:
    before = tables.read("machines", "pcb-drill")
    shell, _screen = measure(Rig(), tables, *typed)
    assert shell.told[0][0] == "Not measured" and why in shell.told[0][1][0]
    assert tables.read("machines", "pcb-drill") == before


def test_the_steps_that_were_made_count_and_not_those_asked_for(tables: TableFiles) -> None:
    rig = Rig()
    rig.slip = 1200
    shell, _screen = measure(rig, tables, "2400", "25.4")
    assert shell.asked[2].startswith("1200 steps, 25.4 mm: 1200 columns/inch instead of 1200 (+0.00 %)")


def test_a_reading_while_it_moves_is_asked_for_again(tables: TableFiles) -> None:
    rig = Rig()
    shell = Answers(typed=["2400"])
    screen = ConfigurationScreen(rig, shell, tables, "pcb-drill")
    press(screen, "down", "down", "down")
    rig.jog = lambda axis, steps: setattr(rig, "moving", True) or ()
    shell.typed.append("51.3")
    press(screen, "f12")
    assert shell.asked[-1].startswith("It still moves. When X rests") and shell.told == []


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"machine": "eight-axis"}, "drive this one first"),
        ({"moving": True}, "at rest"),
        ({"refusal": ("a fault waits to be acknowledged",)}, "a fault waits"),
        ({"x": SimpleNamespace(name="x", position_steps=0, steps_per_mm=40.0)}, "runs by another scale"),
    ],
)
def test_where_a_measurement_would_mean_nothing_it_is_not_begun(
    change: dict[str, Any], why: str, tables: TableFiles
) -> None:
    rig = Rig()
    for name, value in change.items():
        setattr(rig, name, value)
    shell, _screen = measure(rig, tables, "2400", "51.3")
    assert shell.told[0][0] == "Not measured" and why in shell.told[0][1][0]


def test_only_an_axis_has_a_scale_and_nothing_typed_may_be_saved_with_it(tables: TableFiles) -> None:
    shell = Answers(typed=["2400", "51.3"])
    screen = ConfigurationScreen(Rig(), shell, tables, "pcb-drill")
    press(screen, "f12")
    press(screen, "down", "down", "down", "end", "5", "f12")
    assert [lines for _title, lines in shell.told] == [
        ["Go to a field of the axis that is to be measured."], ["Save first, or take back, what is typed."]
    ]  # fmt: skip


@given(st.integers(1, 10**6), st.integers(1, 12), st.integers(1, 10**5), st.floats(0.01, 2000))
def test_a_measurement_is_plausible_or_gives_a_reason(steps: int, per_step: int, old: int, travel_mm: float) -> None:
    found = Measurement(steps, per_step, old, travel_mm)
    if found.problem():
        ratio = found.columns_per_inch / old
        assert travel_mm < LEAST_TRAVEL_MM or not 1 / GREATEST_CHANGE <= ratio <= GREATEST_CHANGE
    else:
        travelled = steps * per_step / found.columns_per_inch * 25.4
        assert abs(travelled - travel_mm) <= travel_mm * 0.5 / found.columns_per_inch + 1e-9


@pytest.fixture
def locked(tables: TableFiles, tmp_path: Path) -> TableFiles:
    """With a file that an instructor has locked two settings in."""
    text = tables.read("machines", "pcb-drill").replace("tick_hz = 500\n", f"tick_hz = 500\n{LOCKED}")
    assert tables.save("machines", "pcb-drill", text) == ()
    return tables


def test_a_locked_field_is_marked_and_springs_back_with_who_and_where(locked: TableFiles) -> None:
    shell = Answers()
    screen = ConfigurationScreen(Rig(), shell, locked, "pcb-drill")
    rows = [row for row in text_of(screen, (80, 40)).split("\n") if "locked" in row]
    assert [row.split(":")[0].strip()[0] for row in rows] == ["X", "X", "I"]
    press(screen, *["down"] * 6, "end", "9")
    told = "range is locked in line 6 of the machine's file; it can be unlocked only there"
    assert shell.told == [("Locked", [told])] and not screen.changed
    press(screen, *["down"] * 4, "end", "9")
    assert screen.changed, "of Y it is not"


def test_a_lock_holds_on_the_screens_too_and_a_copy_keeps_it(locked: TableFiles) -> None:
    text = locked.read("machines", "pcb-drill")
    assert locked.with_field(text, ("tick_hz",), "600") == (
        text, ("tick_hz is locked in line 6 of the machine's file; it can be unlocked only there",)
    )  # fmt: skip
    assert locked.copy("machines", "pcb-drill", "mine") == ()
    fields = {field.place: field.locked for field in locked.fields(locked.read("machines", "mine"))}
    assert fields["tick_hz",] and fields["axis", 0, "range", 0] and not fields["axis", 1, "range", 0]


def test_a_lock_of_nothing_is_an_error_on_its_line(tmp_path: Path) -> None:
    file = tmp_path / "pcb-drill.toml"
    shipped = (shipped_tables() / "machines" / "pcb-drill.toml").read_text("utf-8")
    file.write_text(shipped.replace("tick_hz = 500\n", 'tick_hz = 500\nlocked = ["speed"]\n'))
    with pytest.raises(TableError, match=r"pcb-drill.toml:6: locked: no setting is named 'speed'; there are card"):
        Library((shipped_tables(),)).machine(str(file))


def test_a_lock_changes_nothing_that_a_trace_knows_the_machine_by(locked: TableFiles, tmp_path: Path) -> None:
    library = Library((tmp_path, shipped_tables()))
    assert library.machine("pcb-drill").digest == Library((shipped_tables(),)).machine("pcb-drill").digest


def test_machines_are_compared_field_by_field_and_others_line_by_line(tables: TableFiles) -> None:
    told = differences(tables, "machines", "pcb-drill", "pcb-drill-ramp-lab")
    assert told[0].split() == ["pcb-drill", "pcb-drill-ramp-lab"]
    assert ["X:", "scale", "1200", "1200"] not in [row.split() for row in told]
    assert ["X:", "columns", "of", "a", "step", "1", "6"] in [row.split() for row in told]
    assert ["X:", "highest", "position", "16535", "2588"] in [row.split() for row in told]
    assert differences(tables, "machines", "pcb-drill", "pcb-drill") == []
    assert "+shrink_ticks = 1" in differences(tables, "ramp", "seven-state", "even-interval")


def test_only_what_is_ones_own_and_was_never_shipped_is_deleted(tables: TableFiles, tmp_path: Path) -> None:
    assert tables.copy("machines", "pcb-drill", "mine") == ()
    assert [entry.ships for entry in tables.tables("machines") if entry.name in ("mine", "pcb-drill")] == [False, True]
    assert "comes with the program" in tables.delete("machines", "pcb-drill")[0]
    assert tables.delete("machines", "mine") == () and not (tmp_path / "machines" / "mine.toml").exists()
    assert tables.delete("machines", "mine") != ()


def test_a_higher_ramp_is_proposed_that_lands_and_three_states_stay(tables: TableFiles) -> None:
    text = tables.read("ramp", "seven-state")
    higher = tables.rows.with_top(text, higher=True)
    assert tables.check("ramp", higher).problems == () and tables.rows.ramp(higher).states[-1].state == 4
    assert tables.rows.with_top(higher, higher=False) == text
    for _ in range(5):
        text = tables.rows.with_top(text, higher=False)
    assert [row.state for row in tables.rows.ramp(text).states] == [-1, 0, 1]
    assert tables.rows.with_top("no ramp", higher=True) == "no ramp"
