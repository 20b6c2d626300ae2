"""Submissions as a class hands them in: right, wrong, broken, and written to be graded better than they are."""

import csv
import shutil
from pathlib import Path
from xml.etree import ElementTree

import pytest

from drillctl.cli import main
from drillctl.lab.errors import LabError
from drillctl.lab.grading import graded, names, sheet_of
from tests.support.lab_sheets import LAB, ROOT, SHEETS, SOLUTIONS

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


def test_one_that_can_not_be_copied_ends_no_other_s_grading(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    folders, lost, _ = (submission(tmp_path, name, solved=True) for name in ("folders", "lost", "right"))
    for name in ("pytest.ini", "pyproject.toml"):
        (folders / name).mkdir()
        (folders / name / "x.txt").write_text("x")
    copied = shutil.copyfile

    def copyfile(source: Path, target: Path) -> Path:
        if lost in source.parents:
            raise PermissionError(13, "Permission denied")
        return copied(source, target)

    monkeypatch.setattr("drillctl.lab.grading.shutil.copyfile", copyfile)
    assert main(["grade", "01", *sorted(map(str, tmp_path.iterdir()))]) == 1
    first, second, third = capsys.readouterr().out.splitlines()[:3]
    assert first.split()[1] == third.split()[1] == "passed"
    assert second.split()[:3] == ["lost", "failed", "0/1"] and "it can't be copied: Permission denied" in second


def test_two_of_one_name_are_told_apart_by_their_paths(tmp_path: Path) -> None:
    handed_in = [tmp_path / group / "eve" for group in ("monday", "friday")] + [tmp_path / "adam"]
    for folder in handed_in:
        folder.mkdir(parents=True)
    assert names(handed_in) == [str(handed_in[0]), str(handed_in[1]), "adam"]


@pytest.mark.parametrize("option", ["--holes={place}", "--vcd {place}", "--port mapped:{place}", "--hol={place}"])
def test_options_handed_in_write_nothing_elsewhere(option: str, tmp_path: Path) -> None:
    sly, place = submission(tmp_path, "sly", solved=True, sheet="06-board"), tmp_path / "elsewhere"
    with (sly / "options.txt").open("a") as file:
        file.write(f" {option.format(place=place)}\n")
    (grade,) = graded(sheet_of("06"), [sly], 1, 60)
    assert not grade.passed and not place.exists()
    assert "says nothing of the board or of how it is drilled" in grade.why


def test_a_machine_handed_in_does_not_reach_for_a_port(tmp_path: Path) -> None:
    sly, place = submission(tmp_path, "sly", solved=True, sheet="05-queues"), tmp_path / "card"
    machine = (ROOT / "tables" / "machines" / "pcb-drill.toml").read_text("utf-8")
    real = machine.replace('card = "ZAR1"', f'card = "mapped:{place}"').replace('"SIMULATED"', '"REAL"')
    tables = sly / "drillctl" / "tables" / "machines"
    tables.mkdir(parents=True)
    (tables / "pcb-drill.toml").write_text(real)
    assert "mapped:" in real and '"REAL"' in real
    (grade,) = graded(sheet_of("05"), [sly], 1, 60)
    assert grade.checks[0].passed and not place.exists()


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


def test_whoever_wants_no_more_grades_does_not_wait_for_them(tmp_path: Path) -> None:
    sheet, handed_in = tmp_path / "mine", [tmp_path / name for name in ("a", "b", "c")]
    for folder in (sheet, *handed_in):
        folder.mkdir()
    (sheet / "sheet.toml").write_text('title = "Mine"\nchecks = ["test_wait.py"]\n')
    waits = "import pathlib, time\ndef test_it():\n    if pathlib.Path('long').exists():\n        time.sleep(1000)\n"
    (sheet / "test_wait.py").write_text(waits)
    for folder in handed_in[1:]:
        (folder / "long").touch()
    grades = graded(sheet_of(str(sheet)), handed_in, 2, 1000)
    assert next(grades).passed
    grades.close()  # as an exception does; pytest's own limit ends a test that waits


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
