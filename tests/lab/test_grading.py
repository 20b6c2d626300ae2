"""Submissions as a class hands them in: right, wrong, broken, and written to be graded better than they are."""

import csv
import shutil
from pathlib import Path
from xml.etree import ElementTree

import pytest

from drillctl.cli import main
from drillctl.lab.errors import LabError
from drillctl.lab.grading import graded, sheet_of
from tests.support.lab_sheets import LAB, SHEETS, SOLUTIONS

PASS_ALL = """
import pytest
@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    report.get_result().outcome = "passed"
"""


def submission(place: Path, name: str, solved: bool = False, sheet: str = "01-phase-sequences") -> Path:
    copy = shutil.copytree(LAB / sheet, place / name)
    if solved:
        shutil.copytree(SOLUTIONS / sheet, copy, dirs_exist_ok=True)
    return copy


def test_each_is_judged_by_its_own_tables_and_told_why(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    start, _solved, broken = (submission(tmp_path, name, name == "eve") for name in ("adam", "eve", "kain"))
    (broken / "drillctl/tables/phase/full-step.toml").write_text("bad = [")
    (start / "drillctl/tables/phase/half-step.toml").unlink()
    folders = sorted(map(str, tmp_path.iterdir()))
    table, junit = tmp_path / "grades.csv", tmp_path / "grades.xml"
    assert main(["grade", "01", *folders, "--csv", str(table), "--junit", str(junit), "--workers", "1"]) == 1
    printed = capsys.readouterr().out.splitlines()
    assert printed[1].split() == ["eve", "passed", "1/1"] and printed[-1] == "Phase sequences: 1 of 3 passed"
    with table.open() as file:
        rows = {row["submission"]: row for row in csv.DictReader(file)}
    assert {name: row["passed"] for name, row in rows.items()} == {"adam": "no", "eve": "yes", "kain": "no"}
    assert "half-step" in rows["adam"]["why"]
    assert rows["kain"]["why"].startswith("sequences.trace: drillctl/tables/phase/full-step.toml:1: not TOML")
    suites = ElementTree.parse(junit).getroot()
    assert [suite.get("failures") for suite in suites] == ["1", "0", "1"]


def test_nothing_that_a_student_wrote_is_run_or_decides(tmp_path: Path) -> None:
    folder, ran = submission(tmp_path, "sly"), tmp_path / "ran"
    spoil = f"open({str(ran)!r}, 'w')\n"
    for name in ("conftest.py", "drillctl/__init__.py", "sitecustomize.py", "json.py", "test_sequences.py"):
        (folder / name).write_text(spoil + PASS_ALL)
    (folder / "pytest.ini").write_text("[pytest]\naddopts = --collect-only\n")
    (folder / "sheet.toml").write_text('title = "easy"\nchecks = ["test_sequences.py"]\n')
    trace = folder / "sequences.trace"
    trace.write_text(trace.read_text().partition("\n\n")[0])
    (grade,) = graded(sheet_of("01"), [folder], 1, 60)
    assert not grade.passed and "differs at tick" in grade.why and not ran.exists()


def test_links_are_not_followed(tmp_path: Path) -> None:
    solved, sly = submission(tmp_path, "eve", solved=True), submission(tmp_path, "sly")
    tables = sly / "drillctl" / "tables" / "phase"
    for table in tables.iterdir():
        table.unlink()
        table.symlink_to(solved / table.relative_to(sly))
    (grade,) = graded(sheet_of("01"), [sly], 1, 60)
    assert not grade.passed


def test_a_sheet_of_ones_own_and_a_check_that_does_not_end(tmp_path: Path) -> None:
    sheet = tmp_path / "mine"
    sheet.mkdir()
    (sheet / "sheet.toml").write_text('title = "Mine"\nchecks = ["test_queue.py", "test_wait.py"]\n')
    (sheet / "test_queue.py").write_text(
        "def test_it(drill):\n    assert drill.run('my.kmd').positions('x')[-1] == 7, 'X is not where it should be'\n"
    )
    (sheet / "test_wait.py").write_text("def test_it():\n    pass\n")
    for name, steps in (("good", "7"), ("bad", "8"), ("broken", "x")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "my.kmd").write_text(f"KMD_GOTOdXdY {steps} 0\n")
    handed_in = [tmp_path / name for name in ("good", "bad", "broken")]
    good, bad, broken = graded(sheet_of(str(sheet)), handed_in, 2, 100)
    assert good.passed and (good.name, good.points) == ("good", 2)
    assert bad.points == 1 and bad.why == "test_queue.py: X is not where it should be"
    assert broken.why == "test_queue.py: my.kmd:1:14: 'x' is not a whole number"
    (sheet / "test_wait.py").write_text("import time\ndef test_it():\n    time.sleep(1000)\n")
    (late,) = graded(sheet_of(str(sheet)), [tmp_path / "good"], 1, 1)
    assert not late.passed and "it took longer than it may" in late.why


@pytest.mark.parametrize("sheet", SHEETS)
def test_a_sheet_says_what_its_page_says(sheet: str) -> None:
    page = (LAB / f"{sheet}.md").read_text("utf-8")
    found = sheet_of(sheet)
    assert page.startswith(f"# {int(sheet[:2])}. {found.title}\n")
    assert f"\npytest {' '.join(found.checks)}\n" in page


@pytest.mark.parametrize(
    ("text", "words"),
    [("", "title"), ('title = "a"\nchecks = []\n', "checks"), ('title = "a"\nchecks = ["../x"]\n', "checks"),
     ('title = "a"\nchecks = ["no.trace"]\n', "no.trace is not in the folder"), ("[", "sheet.toml")],
)  # fmt: skip
def test_a_wrong_sheet_is_refused_by_its_file(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "sheet.toml").write_text(text)
    with pytest.raises(LabError, match=words):
        sheet_of(str(tmp_path))
