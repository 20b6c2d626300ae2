"""Lab sheets as a student meets them: a copy of the sheet's folder, the program run in it, the teacher's pytest.

Rule: every command of a sheet runs; the start files fail the teacher's checks, the solution passes them, and does not
with any one of its files left as it was.
"""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from drillctl.cli import main
from tests.support.lab_sheets import LAB, SHEETS, entered, solution, solve

pytestmark = pytest.mark.paced

PARTS = ("**Aim.**", "**Read.**", "**Start files.**", "\n## Write down\n", "\n## Questions\n", "\n## Hand in\n")
TABLES = [(sheet, file) for sheet in SHEETS for file in solution(sheet) if file.suffix == ".toml"]
PYTEST = (sys.executable, "-m", "pytest", "-q", "-p", "drillctl.api.pytest_plugin", "-p", "no:cacheprovider")


def page_of(sheet: str) -> str:
    return (LAB / f"{sheet}.md").read_text("utf-8")


def commands_of(page: str) -> list[str]:
    """The lines of its shell blocks."""
    blocks = re.findall(r"^ *```sh\n(.*?)^ *```", page, re.S | re.M)
    return [line.strip() for block in blocks for line in block.splitlines()]


@pytest.fixture
def folder(sheet: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A student's copy, just begun."""
    return entered(sheet, tmp_path, monkeypatch)


def judged(sheet: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> int:
    """The exit code of the sheet's last command, which knows nobody's own tables. Other plugins are left out."""
    _pytest, *checks = commands_of(page_of(sheet))[-1].split()
    monkeypatch.setenv("XDG_CONFIG_HOME", str(folder.parent / "nobody"))
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    return subprocess.run((*PYTEST, *checks), cwd=folder, capture_output=True, timeout=100, check=False).returncode


def exit_code(command: str) -> int:
    """Of one line as the shell would run it; the program itself runs in this process."""
    line = re.sub(r"\$\(cat (\S+)\)", lambda found: Path(found[1]).read_text("utf-8").strip(), command)
    program, *arguments = shlex.split(line, comments=True)
    if program == "python":
        return subprocess.run([sys.executable, *arguments], capture_output=True, timeout=60, check=False).returncode
    assert program == "drillctl", f"nothing here runs {program}"
    try:
        return main(arguments)
    except SystemExit as left:
        return int(left.code or 0)


@pytest.mark.parametrize("sheet", SHEETS)
def test_every_command_of_a_sheet_runs(sheet: str, folder: Path) -> None:
    *commands, last = commands_of(page_of(sheet))
    assert last.startswith("pytest "), "a sheet ends with what must pass"
    for command in commands:
        told = re.search(r"# exit (\d)", command)
        assert exit_code(command) == (int(told[1]) if told else 0), command


@pytest.mark.parametrize("sheet", SHEETS)
def test_the_start_files_fail_and_the_solution_passes(
    sheet: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert judged(sheet, folder, monkeypatch) == pytest.ExitCode.TESTS_FAILED
    solve(sheet, folder)
    assert judged(sheet, folder, monkeypatch) == pytest.ExitCode.OK


@pytest.mark.parametrize(("sheet", "left_out"), TABLES, ids=str)
def test_no_table_of_a_solution_can_be_left_out(sheet: str, left_out: Path, folder: Path) -> None:
    solve(sheet, folder, but=left_out)
    assert main(["replay", *map(str, folder.glob("*.trace"))]) == 1


@pytest.mark.parametrize("sheet", SHEETS)
def test_a_sheet_has_all_its_parts_and_stands_in_the_course(sheet: str) -> None:
    page = page_of(sheet)
    assert [part for part in PARTS if part not in page] == []
    assert f"({sheet}.md)" in (LAB / "README.md").read_text("utf-8")
    assert any(file.suffix in (".trace", ".seg") for file in (LAB / sheet).iterdir()), "nothing for the plugin"
