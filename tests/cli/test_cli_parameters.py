"""``drillctl parameters``: shown, explained, set with comments kept, refused by name with nothing changed."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.console.parameters import save
from drillctl.machine import Library, TableError, shipped_tables
from drillctl.machine.parameter_edit import entry, with_parameters
from drillctl.machine.source import Source

EIGHT = shipped_tables() / "machines" / "eight-axis.toml"
Capture = pytest.CaptureFixture[str]


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's own copy of the machine, where there is one."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("drillctl.machine.library.user_tables", lambda: tmp_path / "tables of mine")
    return tmp_path / "tables of mine" / "machines" / "eight-axis.toml"


def parameters(capture: Capture, *words: str, code: int = 0) -> str:
    assert main(["parameters", *words]) == code
    told = capture.readouterr()
    return told.out if code == 0 else told.err


def test_values_are_listed_and_explained(own: Path, capsys: Capture) -> None:
    assert "machining.feed_mm_min" in parameters(capsys, "list", "machining")
    assert "tool." not in parameters(capsys, "list", "machining", "axis.x.s_share")
    assert json.loads(parameters(capsys, "list", "system", "--json"))["system.parking_y_mm"] == 480.0
    told = parameters(capsys, "help", "axis.z1.acceleration_mm_min2")
    assert "3,600,000 mm/min² are 1 m/s²" in told and "3600 .. 360000000 mm/min²" in told
    assert not own.exists()


def test_what_is_set_goes_to_a_copy_of_ones_own_with_every_comment(own: Path, capsys: Capture) -> None:
    told = parameters(capsys, "set", "system.parking_x_mm=33.5", "axis.z6.enabled=false", "tool.1.life_hits=unset")
    assert str(own) in told and "tool.1.life_hits" in told
    before, after = EIGHT.read_text("utf-8").splitlines(), own.read_text("utf-8").splitlines()
    assert [line for line in before if "#" in line] == [line for line in after if "#" in line]
    assert sum(one != other for one, other in zip(before, after, strict=True)) == 3
    assert parameters(capsys, "list", "--unset").split()[0] == "tool.1.life_hits"
    machine = Library((own.parent.parent, shipped_tables())).machine("eight-axis")
    assert machine.parameters is not None and machine.parameters.value("system", "parking_x_mm") == 33.5
    assert not machine.parameters.in_use("z6")


def test_a_machine_of_ones_own_is_saved_where_it_is(own: Path, tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(EIGHT.read_text("utf-8"), "utf-8")
    parameters(capsys, "set", "machining.tool_change=automatic", "--machine", str(file))
    assert 'tool_change = "AUTOMATIC"' in file.read_text("utf-8")
    assert not own.exists()


def test_tools_and_places_come_and_go(own: Path, capsys: Capture) -> None:
    assert "tool.17.diameter_mm" in parameters(capsys, "add", "tool", "17")
    assert "a second row of this number" in parameters(capsys, "add", "tool", "17", code=2)
    assert "the least is 1" in parameters(capsys, "add", "magazine", "0", code=2)
    parameters(capsys, "remove", "tool", "17")
    assert own.read_text("utf-8") == EIGHT.read_text("utf-8")
    assert "the magazine has no place 1" in parameters(capsys, "remove", "magazine", "1", code=2)
    assert "there is no tool 17" in parameters(capsys, "remove", "tool", "17", code=2)


def test_all_that_is_wrong_is_told_by_name_and_nothing_is_saved(own: Path, capsys: Capture) -> None:
    wrong = ("axis.x.s_share=1.5", "system.parkin=1", "tool.1.kind=saw", "machining.feed_mm_min=1")
    told = parameters(capsys, "set", *wrong, code=2)
    assert "axis.x: s_share can't be 1.5: the greatest is 1" in told
    assert "did you mean" in told and "tool.1: kind can't be saw: it is one of DRILL, ROUTER" in told
    assert "out of reach" in parameters(capsys, "set", "system.parking_x_mm=1999", code=2)
    assert "NAME=VALUE is wanted" in parameters(capsys, "set", "system.parking_x_mm", code=2)
    assert "is set twice" in parameters(capsys, "set", "tool.1.kind=DRILL", "tool.1.kind=ROUTER", code=2)
    assert "has no parameters" in parameters(capsys, "list", "--machine", "pcb-drill", code=2)
    assert not own.exists()


@pytest.mark.parametrize("value", ["", " ", "1_0", "１", "9" * 400, "nan", "1e400", "0x1"])
def test_what_is_no_plain_number_changes_nothing(value: str, own: Path, capsys: Capture) -> None:
    """An empty value is a variable of a shell that has none, and not ``unset``."""
    told = parameters(capsys, "set", f"axis.x.backlash_mm={value}", code=2)
    assert "axis.x.backlash_mm" in told or "backlash_mm can't be" in told
    assert len(told) < 200 and not own.exists()


def test_a_number_beyond_all_floats_in_a_file_is_refused_by_its_line(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(EIGHT.read_text("utf-8").replace("backlash_mm = 0.0", f"backlash_mm = {'9' * 400}", 1), "utf-8")
    with pytest.raises(TableError, match=r"backlash_mm can't be 9+: the greatest is 10 mm"):
        Library((shipped_tables(),)).machine(str(file))


def test_changes_that_overlap_are_all_kept(own: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another process has saved its change between the reading of the machine and the turn of this one."""
    library = Library((own.parent.parent, shipped_tables()))
    machine = library.machine("eight-axis")

    @contextmanager
    def alone(file: Path) -> Iterator[None]:
        file.parent.mkdir(parents=True)
        file.write_text(with_parameters(Source.read(EIGHT), {"axis.z2.backlash_mm": "2"}), "utf-8")
        yield

    monkeypatch.setattr("drillctl.console.parameters.alone", alone)
    assert not save(library, machine, own.parent.parent, partial(with_parameters, typed={"axis.z1.backlash_mm": "1"}))
    kept = library.machine("eight-axis").parameters
    assert kept is not None
    assert [entry(kept, f"axis.{axis}.backlash_mm").value for axis in ("z1", "z2", "z3")] == [1.0, 2.0, 0.0]
