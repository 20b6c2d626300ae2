"""docs/SECURITY.md lists the doors from outside: every module and every test that it names is there."""

import importlib.util
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "docs" / "SECURITY.md").read_text("utf-8")
COLUMNS = ["door", "what may come in", "guard", "test"]


def rows() -> list[list[str]]:
    """The cells of the table, without its heading."""
    lines = [line for line in PAGE.splitlines() if line.startswith("|")]
    table = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip("|"))] for line in lines]
    assert table[0] == COLUMNS
    return table[2:]


def test_every_door_has_a_guard_and_a_test() -> None:
    assert len(rows()) >= 9
    for row in rows():
        assert len(row) == len(COLUMNS) and all(row)
        assert re.search(r"`drillctl[.\w]+`", row[2]), f"no module guards {row[0]}"
        assert re.search(r"`(tests|benchmarks)/[\w/]+\.py`", row[3]), f"no test holds {row[0]}"


def test_every_module_and_test_named_is_there() -> None:
    for row in rows():
        for module in re.findall(r"`(drillctl\.[.\w]+)`", row[2]):
            assert importlib.util.find_spec(module), f"{row[0]}: no module {module}"
        for file in re.findall(r"`([\w/]+\.py)", row[3]):
            assert (ROOT / file).is_file(), f"{row[0]}: no file {file}"


def test_the_page_is_found_from_the_readme() -> None:
    assert "docs/SECURITY.md" in (ROOT / "README.md").read_text("utf-8")
