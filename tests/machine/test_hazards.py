"""Valid but dangerous phase tables: loaded, with one sentence for each danger. On the shipped motors."""

from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.machine import Library, machine_hazards, shipped_tables

SHIPPED = shipped_tables()
FORCED = SHIPPED / "phase" / "two-phase-forced.toml"
PULSE = SHIPPED / "phase" / "pulse-direction.toml"


def hazards(file: Path, text: str) -> list[str]:
    file.write_text(text)
    return Library((SHIPPED,)).check(file)


def row(name: str, pattern: str) -> str:
    return f'[[wire]]\nname = "{name}"\nvolts = {24 if name.startswith("24") else 5}\npattern = "{pattern}"\n'


def table(**patterns: str) -> str:
    """A two-phase table: rows given as _1a=..., forcing wires off where not given."""
    columns = len(next(iter(patterns.values())))
    rows = dict.fromkeys(("1a", "1b", "2a", "2b", "24a", "24b"), "." * columns)
    rows |= {name[1:]: pattern for name, pattern in patterns.items()}
    return 'name = "t"\n' + "".join(row(name, pattern) for name, pattern in rows.items())


GOOD = {"_1a": "xxxxxx......", "_1b": "......xxxxxx", "_2a": "xxx......xxx", "_2b": "...xxxxxx..."}


@pytest.mark.parametrize(
    ("patterns", "expected"),
    [
        (GOOD, []),
        (
            GOOD | {"_1b": "x.....xxxxxx"},
            ["column 1: 1a and 1b are both on: the halves of one winding cancel"],
        ),
        (
            {"_1a": "x...", "_1b": "..x.", "_2a": ".x..", "_2b": "...x"},
            ["4 columns where the motor's cycle has 12: distances will not be what the scale says"],
        ),
        (
            {"_1a": "xxxxxx......", "_1b": "......xxxxxx"},
            [
                "column 6: half a cycle to the next column; the rotor may go either way",
                "column 12: half a cycle to the next column; the rotor may go either way",
            ],
        ),
        (
            GOOD | {"_1a": "..xxxx......", "_2a": ".xx......xxx", "_24a": "x..........."},
            ["column 1: forcing is on while no phase is", "column 1: nothing pulls the rotor"],
        ),
        (
            GOOD | {"_1b": "x.....xxxxxx", "_2b": "x..xxxxxx..."},
            [
                "column 1: 1a and 1b are both on: the halves of one winding cancel",
                "column 1: 2a and 2b are both on: the halves of one winding cancel",
                "column 1: nothing pulls the rotor",
            ],
        ),
    ],
    ids=["sound", "both halves", "wrong length", "half cycle", "forcing alone", "all on"],
)
def test_each_danger_has_its_sentence(patterns: dict[str, str], expected: list[str], tmp_path: Path) -> None:
    assert hazards(tmp_path / "t.toml", table(**patterns)) == expected


def test_forcing_wires_decide_nothing_about_where_the_rotor_goes(tmp_path: Path) -> None:
    """The table's own forcing rows, moved one column on: odd, but every phase is on there."""
    text = FORCED.read_text().replace("x.....x.....", ".x.....x....")
    assert hazards(tmp_path / "t.toml", text) == []


def test_a_pulse_drive_has_no_such_dangers(tmp_path: Path) -> None:
    assert hazards(tmp_path / "t.toml", PULSE.read_text().replace('"x."', '"x.x."')) == []


def test_a_machine_tells_the_hazards_of_each_of_its_tables_once(tables: Callable[..., Path], tmp_path: Path) -> None:
    tables("phase/beat", '"...xxx"', '"......"')
    found = machine_hazards(Library((tmp_path,)).machine("mini"))
    assert found == ["beat: column 5: nothing pulls the rotor"]


def backwards(text: str, **rows: str) -> str:
    """With rows for motion backwards: those of the table, some of them others."""
    names = ("1a", "1b", "2a", "2b", "24a", "24b")
    own = {name: rows.get(f"_{name}", GOOD.get(f"_{name}", "." * 12)) for name in names}
    return text + "".join(f'[[reverse]]\nname = "{name}"\npattern = "{row}"\n' for name, row in own.items())


def test_rows_for_motion_backwards_are_looked_at_too(tmp_path: Path) -> None:
    sound = backwards(table(**GOOD))
    assert hazards(tmp_path / "t.toml", sound) == []
    shorted = backwards(table(**GOOD), _1b="x.....xxxxxx", _24a="x...........")
    assert hazards(tmp_path / "t.toml", shorted) == [
        "backwards, column 1: 1a and 1b are both on: the halves of one winding cancel"
    ]
    dark = backwards(table(**GOOD), _1a="..xxxx......", _2a=".xx......xxx", _24a="x...........")
    assert hazards(tmp_path / "t.toml", dark) == [
        "backwards, column 1: forcing is on while no phase is",
        "backwards, column 1: nothing pulls the rotor",
    ]
