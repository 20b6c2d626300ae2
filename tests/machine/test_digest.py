"""The digest of a machine: another one for whatever decides a run, the same for what does not."""

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.machine import Library, TableError, shipped_tables

NUMBER = re.compile(r"(?<![\w\".-])-?\d+(?![\w\".])")
Tables = Callable[..., Path]


def digest(folder: Path) -> str:
    return Library((folder,)).machine("mini").digest


def digest_unless_refused(folder: Path) -> str | None:
    try:
        return digest(folder)
    except TableError:
        return None


@pytest.mark.parametrize(
    ("table", "old", "new"),
    [
        ("machines/mini", 'name = "mini"', 'name = "mini"\ndescription = "another one"'),
        ("machines/mini", 'name = "mini"', '# a remark\nname    =  "mini"'),
        ("machines/mini", "tick_hz = 500", "tick_hz = 501"),
        ("ramp/gentle", "interval = 5", "interval = 5 # slowly"),
        ("phase/beat", 'name = "beat"', 'name = "beat"\ndescription = "as in the paper"'),
    ],
)
def test_what_does_not_decide_a_run_leaves_it(table: str, old: str, new: str, tables: Tables, tmp_path: Path) -> None:
    """The tick rate stands in a trace's header by itself."""
    tables()
    before = digest(tmp_path)
    tables(table, old, new)
    assert digest(tmp_path) == before


def test_the_place_of_the_files_leaves_it(tables: Tables, tmp_path: Path) -> None:
    tables()
    before = digest(tmp_path)
    moved = tmp_path.rename(tmp_path.with_name(tmp_path.name + "-moved"))
    assert digest(moved) == before


@pytest.mark.parametrize("table", ["machines/mini", "ramp/gentle", "motor/three"])
def test_every_number_that_can_be_one_more_or_less_changes_it(table: str, tables: Tables, tmp_path: Path) -> None:
    """Each number of the file in turn; where the changed table is refused, nothing is to be compared."""
    file = tables(table)
    text, before = file.read_text(), digest(tmp_path)
    tried = 0
    for found in NUMBER.finditer(text):
        if "tick_hz" in text[: found.start()].splitlines()[-1]:
            continue
        for step in (1, -1):
            file.write_text(text[: found.start()] + str(int(found[0]) + step) + text[found.end() :])
            if after := digest_unless_refused(tmp_path):
                tried += 1
                assert after != before, text[: found.end()].splitlines()[-1]
    assert tried >= 5


@pytest.mark.parametrize(
    ("table", "old", "new"),
    [
        ("phase/beat", "xx...x", "xx...."),
        ("machines/mini", "start = 100", "invert = true"),
        ("machines/mini", 'end = "min"\nedge = -5', 'end = "min"\nactive = 0\nedge = -5'),
        ("machines/mini", 'name = "mini"', 'name = "mini"\nemergency_stop = "hold"'),
        ("machines/mini", 'do = "raise"', 'do = "release"'),
    ],
)
def test_what_is_no_number_changes_it_too(table: str, old: str, new: str, tables: Tables, tmp_path: Path) -> None:
    tables()
    before = digest(tmp_path)
    tables(table, old, new)
    assert digest(tmp_path) != before


def test_a_copy_of_the_shipped_files_is_called_by_name(tmp_path: Path) -> None:
    """A checkout beside an installed program: its traces must be replayable elsewhere. One byte, and it is a file."""
    shutil.copytree(shipped_tables(), tmp_path / "tables")
    library = Library((tmp_path / "tables",))
    assert library.machine("pcb-drill").reference_from(tmp_path) == "pcb-drill"
    ramp = tmp_path / "tables/ramp/seven-state.toml"
    ramp.write_bytes(ramp.read_bytes() + b"\n")
    assert library.machine("pcb-drill").reference_from(tmp_path) == "tables/machines/pcb-drill.toml"
