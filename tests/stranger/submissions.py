"""Thirty submissions of a class, a folder each: right, wrong, broken, incomplete, and written to be graded better than
they are. The sheet is lab sheet 1 with a queue of one's own besides.

Each row of SUBMISSIONS: the folder's name, whether it passes, a part of the reason that its author reads, and what was
done to a right solution.
"""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

PHASE = Path("drillctl/tables/phase")
MACHINE = Path("drillctl/tables/machines/motor-bench.toml")
SHEET = """title = "Sequences, and a queue of one's own"
checks = ["sequences.trace", "test_mine.py"]
"""
CHECK = """
def test_mine(drill):
    run = drill.run("mine.kmd", "motor-bench")
    assert run.fault is None, "the queue ends in a fault"
    assert run.positions("half")[-1] == 12, "half does not end at 12"
"""
RIGHT = "KMD_RUCHd half=20 wave=4\nKMD_RUCHd half=-8\n"
SPOIL = "import pathlib\npathlib.Path('RAN').write_text('ran')\n"  # RAN: a file that is looked for afterwards
PASS_ALL = """
import pytest
@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    report.get_result().outcome = "passed"
"""


def made_sheet(place: Path, lab: Path) -> Path:
    """The sheet's folder: start files of lab sheet 1, an own check, ``sheet.toml``."""
    sheet = shutil.copytree(lab / "01-phase-sequences", place)
    (sheet / "sheet.toml").write_text(SHEET)
    (sheet / "test_mine.py").write_text(CHECK)
    return sheet


def submission(folder: Path, sheet: Path, solution: Path) -> Path:
    """A right one."""
    shutil.copytree(sheet, folder)
    shutil.copytree(solution, folder, dirs_exist_ok=True)
    (folder / "mine.kmd").write_text(RIGHT)
    return folder


def write(name: str | Path, text: str) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text.replace("RAN", str(folder.parent.parent / "ran")))

    return change


def replace(name: str | Path, old: str, new: str) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        text = (folder / name).read_text()
        assert old in text, f"{name} has no {old!r}"
        (folder / name).write_text(text.replace(old, new, 1))

    return change


def both(*changes: Callable[[Path], None]) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        for each in changes:
            each(folder)

    return change


def without(name: str | Path) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        target = folder / name
        shutil.rmtree(target) if target.is_dir() else target.unlink()

    return change


def nothing(folder: Path) -> None:
    """Leaves it as it is."""


def carriage_returns(folder: Path) -> None:
    for file in (*folder.rglob("*.toml"), *folder.rglob("*.kmd")):
        file.write_bytes(file.read_bytes().replace(b"\n", b"\r\n"))


def linked(folder: Path) -> None:
    (folder / PHASE / "half-step.toml").unlink()
    (folder / PHASE / "half-step.toml").symlink_to(folder.parent / "anna" / PHASE / "half-step.toml")


def endless_pipe(folder: Path) -> None:
    (folder / "mine.kmd").unlink()
    os.mkfifo(folder / "mine.kmd")


def too_many(folder: Path) -> None:
    for number in range(2100):
        (folder / f"{number}.txt").touch()


def too_large(folder: Path) -> None:
    with (folder / "film.mp4").open("wb") as film:
        film.truncate(65 * 2**20)


def short_trace(folder: Path) -> None:
    trace = folder / "sequences.trace"
    trace.write_text(trace.read_text().partition("\n\n")[0] + "\n\nend 0\n")


def folder_in_its_place(folder: Path) -> None:
    (folder / PHASE / "half-step.toml").unlink()
    (folder / PHASE / "half-step.toml").mkdir()


def start_files(folder: Path) -> None:
    shutil.copytree(folder.parent.parent / "sheet" / PHASE, folder / PHASE, dirs_exist_ok=True)


MODULES = ("sitecustomize.py", "json.py", "drillctl/__init__.py", "x.pth")
FULL, HALF, WAVE = (PHASE / f"{name}.toml" for name in ("full-step", "half-step", "wave-drive"))
IDLE = write("mine.kmd", "KMD_CZEKAJ 1\n")
NOT_AXIS = "test_mine.py: mine.kmd:2:11: 'half:-8' is not axis=steps"
TOO_LONG = "test_mine.py: mine.kmd: 6000000000 ticks; a trace has room for 100000000"
SUBMISSIONS: tuple[tuple[str, bool, str, Callable[[Path], None]], ...] = (
    ("anna", True, "", nothing),
    ("bartek", True, "", replace("mine.kmd", "KMD", "# first the long one\nKMD")),
    ("celina", True, "", carriage_returns),
    ("start-files", False, "differs at tick", start_files),
    ("wrong-table", False, "differs at tick", replace(HALF, "x", ".")),
    ("wrong-queue", False, "half does not end at 12", replace("mine.kmd", "half=-8", "half=-9")),
    ("fault-in-queue", False, "the queue ends in a fault", replace("mine.kmd", "half=20", "half=20000000")),
    ("syntax-of-toml", False, "full-step.toml:1: not TOML", write(FULL, "bad = [")),
    ("syntax-of-queue", False, NOT_AXIS, replace("mine.kmd", "KMD_RUCHd half=-8", "KMD_RUCHd half:-8")),
    ("unknown-key", False, "full-step.toml:2: unknown key colour", write(FULL, 'name = "full-step"\ncolour = "red"\n')),
    ("empty-table", False, "full-step.toml: name is missing", write(FULL, "")),
    ("other-letters", False, "'ж' in the pattern; only 'x' (on) and '.' (off)", replace(FULL, "x", "ж")),
    ("nested", False, "full-step.toml: nested too deeply", write(FULL, "a = " + "[" * 100_000)),
    ("no-table", False, "no phase table is named 'half-step'", without(HALF)),
    ("no-machine", False, "motor-bench", without(MACHINE)),
    ("no-tables", False, "motor-bench", without("drillctl")),
    ("no-queue", False, "test_mine.py: mine.kmd: can't be read", without("mine.kmd")),
    ("empty-queue", False, "test_mine.py: mine.kmd:1:1: no command in it", write("mine.kmd", "")),
    ("table-is-folder", False, "no phase table is named 'half-step'", folder_in_its_place),
    ("conftest", False, "half does not end", both(write("conftest.py", SPOIL + PASS_ALL), IDLE)),
    ("own-check", False, "half does not end", both(write("test_mine.py", SPOIL + "def test_mine(): pass\n"), IDLE)),
    ("own-sheet", False, "half does not end", both(write("sheet.toml", 'title = "a"\nchecks = ["a.py"]\n'), IDLE)),
    ("own-settings", False, "half does not end", both(write("pytest.ini", "[pytest]\naddopts = --co\n"), IDLE)),
    ("own-modules", True, "", both(*(write(name, SPOIL) for name in MODULES))),
    ("short-trace", False, "differs at tick", both(short_trace, replace(WAVE, "x", "."))),
    ("link", False, "no phase table is named 'half-step'", linked),
    ("pipe", False, "test_mine.py: mine.kmd: can't be read", endless_pipe),
    ("endless-queue", False, TOO_LONG, write("mine.kmd", "KMD_CZEKAJ 2000000000\n" * 1000)),
    ("too-large", False, "more than 2000 files or 64 MB", too_large),
    ("too-many", False, "more than 2000 files or 64 MB", too_many),
)  # fmt: skip
