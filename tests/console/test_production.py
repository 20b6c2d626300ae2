"""The parameters and records of the machine in use: parking, and what a change of parameters does to it."""

from dataclasses import dataclass, field
from pathlib import Path

import pytest
from msgspec.structs import replace

from drillctl.console.magazine_record import MagazineRecord
from drillctl.console.production import MachineProduction
from drillctl.generation.eight_axis.magazine import Transfer
from drillctl.jobs.magazine import MagazineFile, default_file
from drillctl.language import Message
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.viewmodel.console import AxisView, MachineView, Problems
from tests.ui.fake_console import VIEW

LIBRARY = Library((shipped_tables(),))
EIGHT = LIBRARY.machine("eight-axis")
BUSY = (Message("it moves"),)


def axis(name: str, position_steps: int, position_mm: float) -> AxisView:
    """At 100 steps a millimetre; the working base lies where the two places differ."""
    return replace(VIEW.axes[0], name=name, position_steps=position_steps, position_mm=position_mm, steps_per_mm=100.0)


NOW = replace(VIEW, axes=(axis("x", 4000, 10.0), axis("y", 3000, 30.0)))


@dataclass
class Desk:
    """Keeps what it is asked; the machine is the one of the library."""

    machine: Machine = EIGHT
    now: MachineView = NOW
    why_not: Problems = ()
    asked: list[tuple[object, ...]] = field(default_factory=list)

    def view(self) -> MachineView:
        return self.now

    def busy(self) -> Problems:
        return self.why_not

    def choose_machine(self, name: str) -> Problems:
        self.asked.append(("choose_machine", name))
        return ()

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        self.asked.append(("go_to", round(x_mm, 9), round(y_mm, 9)))
        return ()


def test_the_parking_place_counts_from_machine_zero_and_not_from_the_base(tmp_path: Path) -> None:
    desk = Desk()
    assert MachineProduction(desk, LIBRARY, lambda: tmp_path).park() == ()
    assert EIGHT.parameters is not None
    x_mm, y_mm = (EIGHT.parameters.number("system", f"parking_{name}_mm") or 0.0 for name in "xy")
    assert desk.asked == [("go_to", x_mm - 30.0, y_mm)]  # the base lies at X 30


def test_there_is_no_way_to_the_parking_place_without_a_position(tmp_path: Path) -> None:
    desk = Desk(now=replace(VIEW, position_known=False))
    assert "initialise first" in str(MachineProduction(desk, LIBRARY, lambda: tmp_path).park()[0])
    assert desk.asked == []


def test_a_change_is_saved_and_the_machine_taken_by_name_or_by_its_file(tmp_path: Path) -> None:
    library = Library((tmp_path, shipped_tables()))
    desk = Desk()
    assert MachineProduction(desk, library, lambda: tmp_path).enter({"system.parking_x_mm": "21"}) == ()
    assert desk.asked == [("choose_machine", "eight-axis")]
    own = tmp_path / "other" / "mine.toml"
    own.parent.mkdir()
    own.write_text((tmp_path / "machines" / "eight-axis.toml").read_text("utf-8"), "utf-8")
    desk = Desk(LIBRARY.machine(str(own)))
    assert MachineProduction(desk, library, lambda: tmp_path).add("magazine", 9) == ()
    assert desk.asked == [("choose_machine", str(own))]
    assert "place = 9" in own.read_text("utf-8")


@pytest.mark.parametrize(("why_not", "typed"), [(BUSY, "21"), ((), "2001")])
def test_a_refused_change_changes_neither_file_nor_machine(why_not: Problems, typed: str, tmp_path: Path) -> None:
    desk = Desk(why_not=why_not)
    assert MachineProduction(desk, LIBRARY, lambda: tmp_path).enter({"system.parking_x_mm": typed})
    assert desk.asked == [] and list(tmp_path.iterdir()) == []


def test_records_are_what_the_parameters_say(tmp_path: Path) -> None:
    records = MachineProduction(Desk(), LIBRARY, lambda: tmp_path).records()
    assert EIGHT.parameters is not None
    assert records.stroke_mm == EIGHT.parameters.number("machining", "working_stroke_mm")
    assert records.cycle_s == 0.1 and records.missing == () and records.relative_mm is None
    assert [tool.number for tool in records.tools] == [row.value("number") for row in EIGHT.parameters.tools]
    assert {place.number: place.tool for place in records.places}[1] == 1


def test_the_magazine_is_shown_as_its_record_has_it_and_anew_when_it_has_changed(tmp_path: Path) -> None:
    made = MachineProduction(Desk(), LIBRARY, lambda: tmp_path, MagazineRecord(lambda: tmp_path))
    assert made.records().chucks == () and not any(place.bits for place in made.records().places)
    kept = MagazineFile(default_file(tmp_path, EIGHT), EIGHT)
    begun = kept.magazine.begun(Transfer("take", 1, 1, (1, 2))).hit(2, 7)
    kept.keep(begun)
    records = made.records()
    assert records.chucks[:3] == (None, None, 0)
    assert next(place.bits for place in records.places if place.number == 1)[:3] == (None, None, True)
    left = {tool.number: tool.hits_left for tool in records.tools}
    assert EIGHT.parameters is not None
    row = EIGHT.parameters.tool(2)
    assert row is not None and left[2] == (row.number("hits_left") or 0) - 7
    kept.keep(begun.ended(Transfer("take", 1, 1, (1, 2))))
    assert made.records().chucks[:3] == (1, 1, 0)


def test_a_record_that_cannot_be_read_is_told_and_nothing_is_guessed(tmp_path: Path) -> None:
    made = MachineProduction(Desk(), LIBRARY, lambda: tmp_path, MagazineRecord(lambda: tmp_path))
    default_file(tmp_path, EIGHT).write_text("{", "utf-8")
    records = made.records()
    assert records.trouble is not None and "is no magazine record" in records.trouble
    assert records.chucks == () and not any(place.bits for place in records.places)
