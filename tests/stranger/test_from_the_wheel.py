"""A stranger's first hour, from the wheel alone: examples, a figure, own tests in CI, a class graded, help at hand."""

import csv
import os
import re
import select
import shutil
import subprocess
import time
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from xml.etree import ElementTree

import pytest

from drillctl.cli import main
from drillctl.ui.pcb_drill import examples
from tests.stranger.submissions import SUBMISSIONS, made_sheet, submission

ROOT = Path(__file__).resolve().parents[2]
SOLUTION = ROOT / "tests/lab_sheets/solutions/01-phase-sequences"
Stranger = Callable[..., "subprocess.CompletedProcess[str]"]
PAGE = (ROOT / "docs/API.md").read_text("utf-8")
HOLE = "KMD_INICJALIZACJA\nKMD_GOTO_X_Y 300 200\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\n"

pytestmark = [
    pytest.mark.timeout(600),  # the first test waits for the wheel and its environment
    pytest.mark.skipif(os.name == "nt", reason="the programs of an environment have other names there"),
]


def test_every_table_is_in_the_wheel(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    tables = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "tables").rglob("*.toml"))
    assert len(tables) > 10
    assert {f"drillctl/{name}" for name in tables} <= names


def test_the_example_boards_and_the_lab_sheets_are_in_the_wheel(wheel: Path) -> None:
    """Where drillctl/ui/pcb_drill/examples.py looks for them."""
    names = set(zipfile.ZipFile(wheel).namelist())
    for inside, files in (("examples", examples.boards()), ("sheets", examples.sheets())):
        assert files and {f"drillctl/{inside}/{file.name}" for file in files} <= names


def test_without_a_compiler_a_wheel_for_every_computer_is_made(wheel: Path) -> None:
    assert wheel.name.endswith("-py3-none-any.whl")
    assert not [name for name in zipfile.ZipFile(wheel).namelist() if name.endswith((".so", ".c"))]


def test_an_example_is_copied_drilled_and_looked_at(stranger: Stranger, tmp_path: Path) -> None:
    assert "sheets" in stranger("drillctl", "where").stdout
    copied = stranger("drillctl", "examples", "mine")
    assert copied.returncode == 0 and (tmp_path / "mine/docs/lab/01-phase-sequences/sheet.toml").is_file()
    done = stranger("drillctl", "run", "mine/blinker.drl", "--trace", "b.trace")
    assert done.returncode == 0 and done.stdout.strip() in (ROOT / "README.md").read_text("utf-8")
    assert stranger("drillctl", "replay", "b.trace").returncode == 0
    assert stranger("drillctl", "report", "b.trace", "-o", "b.html").returncode == 0
    page = (tmp_path / "b.html").read_text("utf-8")
    assert page.startswith("<!DOCTYPE html>") and "</html>" in page[-20:]
    assert page.count("<title>b.trace</title>") == 1 and "pcb-drill" in page


def test_what_is_copied_is_what_a_clone_copies(stranger: Stranger, tmp_path: Path) -> None:
    assert stranger("drillctl", "examples", "wheel").returncode == 0
    assert main(["examples", str(tmp_path / "clone")]) == 0
    of_wheel, of_clone = (
        {file.relative_to(tmp_path / name) for file in (tmp_path / name).rglob("*")} for name in ("wheel", "clone")
    )
    assert of_wheel == of_clone and Path("docs/TROUBLESHOOTING.md") in of_wheel


def test_the_machines_are_those_of_the_clone(stranger: Stranger) -> None:
    listed = stranger("drillctl", "machines").stdout
    names = [file.stem for file in (ROOT / "tables/machines").glob("*.toml")]
    assert len(names) > 5 and all(re.search(rf"^{name}\b", listed, re.M) for name in names)


def test_the_figure_of_the_api_page_is_drawn(stranger: Stranger, tmp_path: Path) -> None:
    (block,) = re.findall(r"```python\n(import.*?)```", PAGE, re.S)
    (tmp_path / "figure.py").write_text(block + "print(*lost)\n")
    done = stranger("python", "figure.py")
    assert done.returncode == 0, done.stderr
    lost = [int(word) for word in done.stdout.split()]
    assert len(lost) == 14 and not any(lost[:5]) and all(lost[8:])
    assert (tmp_path / "lost.png").read_bytes().startswith(b"\x89PNG")


def test_a_repository_of_ones_own_is_judged_by_its_goldens(stranger: Stranger, tmp_path: Path) -> None:
    (tmp_path / "hole.kmd").write_text(HOLE)
    (own_test,) = re.findall(r"```python\n(def test.*?)```", PAGE, re.S)
    (tmp_path / "test_hole.py").write_text(own_test)
    assert stranger("drillctl", "run", "hole.kmd", "--trace", "goldens.trace").returncode == 0
    judged = stranger("pytest", "--drillctl-require-traces", "--drillctl-report", "pages")
    assert judged.returncode == 0 and "2 passed" in judged.stdout and not (tmp_path / "pages").exists()

    stranger("drillctl", "tables", "copy", "phase/two-phase-forced", "--to", "tables")
    table = tmp_path / "tables/phase/two-phase-forced.toml"
    table.write_text(table.read_text().replace("xxxxxx......", "xxxx........", 1))
    judged = stranger("pytest", "-rf", "--drillctl-report", "pages")
    assert judged.returncode == 1
    assert "goldens.trace: differs at tick 16, in command 1 KMD_INICJALIZACJA" in judged.stdout
    assert "x.1a should be on" in judged.stdout and "Traceback" not in judged.stdout
    (page,) = (tmp_path / "pages").iterdir()
    assert page.name == "goldens.trace.html" and "x.1a" in page.read_text("utf-8")


def test_thirty_submissions_are_graded(stranger: Stranger, tmp_path: Path) -> None:
    assert stranger("drillctl", "examples", "mine").returncode == 0
    sheet = made_sheet(tmp_path / "sheet", tmp_path / "mine/docs/lab")
    (tmp_path / "handed-in").mkdir()
    for name, _passes, _why, change in SUBMISSIONS:
        change(submission(tmp_path / "handed-in" / name, sheet, SOLUTION))
    folders = [f"handed-in/{name}" for name, *_ in SUBMISSIONS]
    done = stranger("drillctl", "grade", "sheet", *folders, "--csv", "g.csv", "--junit", "g.xml", "--workers", "2")
    right = sum(passes for _, passes, *_ in SUBMISSIONS)
    assert done.returncode == 1 and done.stdout.endswith(f": {right} of 30 passed\n"), done.stderr
    assert not (tmp_path / "ran").exists(), "something that a student wrote was run"

    with (tmp_path / "g.csv").open(newline="") as file:
        rows = {row["submission"]: row for row in csv.DictReader(file)}
    for name, passes, why, _change in SUBMISSIONS:
        row = rows.pop(name)
        assert row["of"] == "2" and (row["passed"] == "yes") == (row["points"] == "2") == passes, row
        assert why in row["why"] and "drillctl." not in row["why"], row
    assert not rows
    suites = ElementTree.parse(tmp_path / "g.xml").getroot()
    assert len(suites) == 30 and sum(suite.get("failures") == "0" for suite in suites) == right


@pytest.mark.skipif(shutil.which("man") is None, reason="no man here")
def test_man_finds_the_page(surroundings: dict[str, str], bin_folder: Path) -> None:
    found = subprocess.run(["man", "-w", "drillctl"], env=surroundings, capture_output=True, text=True, check=False)
    if "minimized" in found.stdout + found.stderr:
        pytest.skip("man is a stand-in here")
    assert found.stdout.strip() == str(bin_folder.parent / "share/man/man1/drillctl.1"), found.stderr


@pytest.fixture
def typed(surroundings: dict[str, str], tmp_path: Path) -> Iterator[Callable[[str, str], str]]:
    """Types into a bash of the stranger; returns what stands on its terminal once the pattern does, or after 20 s."""
    if shutil.which("bash") is None:
        pytest.skip("no bash here")
    pty = pytest.importorskip("pty")
    controller, terminal = pty.openpty()
    call = ["bash", "--norc", "--noprofile", "-i"]
    shell = subprocess.Popen(
        call, stdin=terminal, stdout=terminal, stderr=terminal, cwd=tmp_path, env=surroundings, start_new_session=True
    )
    os.close(terminal)

    def type_in(keys: str, pattern: str) -> str:
        os.write(controller, keys.encode())
        shown, end = "", time.monotonic() + 20
        while not re.search(pattern, shown) and time.monotonic() < end:
            if select.select([controller], [], [], 0.2)[0]:
                shown += os.read(controller, 4096).decode()
        return shown

    yield type_in
    shell.kill()
    shell.wait()
    os.close(controller)


@pytest.mark.parametrize(
    ("keys", "completed"),
    [
        ("drillctl exam\t", "examples "),
        ("drillctl run --pla\tdyn\t", "--plant dynamic "),
        ("drillctl run boa\t", "board.drl "),
    ],
)
def test_the_tab_key_completes(typed: Callable[[str, str], str], tmp_path: Path, keys: str, completed: str) -> None:
    (tmp_path / "board.drl").touch()
    assert "done" in typed("PS1='> '; eval \"$(drillctl completion bash)\"; echo do''ne\n", "done")
    assert completed in typed(keys, re.escape(completed))
