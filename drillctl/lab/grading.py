"""Judges submissions of a lab sheet: each by its own tables, in a copy of its own, by the checks of the sheet.

Rule: nothing that a student wrote is run as Python: of a submission only data is copied (no Python, no settings of
pytest, no links), and the sheet's own checks are laid over it. pytest runs them in a process that reads no settings of
this user either. docs/lab/INSTRUCTOR.md.
"""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated
from xml.etree import ElementTree

import msgspec

from drillctl.files import system
from drillctl.files.inputs import read_bytes, toml_of
from drillctl.files.shipped import shipped
from drillctl.lab.errors import LabError
from drillctl.language import Message, known_words, message_of
from drillctl.viewmodel.grades import Check, SubmissionGrade

SHEET = "sheet.toml"
LARGEST_SHEET_BYTES = 64 * 1024
LARGEST_SUBMISSION_BYTES = 64 * 1024 * 1024
MOST_FILES = 2000
CODE = (".py", ".pyc", ".pyi", ".pyd", ".so", ".pth")
SETTINGS = ("pytest.ini", ".pytest.ini", "tox.ini", "setup.cfg", "pyproject.toml", SHEET)
PLUGIN = "drillctl.api.pytest_plugin"
RAISED = re.compile(r"^(AssertionError|drillctl[\w.]*): ")  # before the words of an assertion, or of a refusal of ours
Name = Annotated[str, msgspec.Meta(pattern=r"^[^/\\]+$", max_length=200)]


class _Shape(msgspec.Struct, forbid_unknown_fields=True):
    title: str
    checks: Annotated[tuple[Name, ...], msgspec.Meta(min_length=1, max_length=100)]


@dataclass(frozen=True)
class Sheet:
    """A lab sheet: its folder, and the files in it that judge: traces, and tests of its own (``test_*.py``)."""

    title: str
    folder: Path
    checks: tuple[str, ...]


def sheet_of(name: str) -> Sheet:
    """Returns a sheet by its folder, or a shipped one by the beginning of its name (``01``). Raises LabError."""
    folder = Path(name) if "/" in name or (Path(name) / SHEET).is_file() else _shipped(name)
    try:
        text = read_bytes(folder / SHEET, LARGEST_SHEET_BYTES, Message("a sheet")).decode()
        shape = msgspec.convert(toml_of(text), _Shape)
    except (OSError, ValueError, msgspec.ValidationError) as error:
        raise LabError(message_of(error).at(folder / SHEET)) from error
    for check in shape.checks:
        if not (folder / check).is_file():
            raise LabError(Message("the check {check} is not in the folder", check=check).at(folder / SHEET))
    return Sheet(shape.title, folder, shape.checks)


def graded(sheet: Sheet, submissions: Sequence[Path], workers: int, limit_s: float) -> Iterator[SubmissionGrade]:
    """Yields the grade of each submission, in their order; ``limit_s``: for how long one may be judged. Raises LabError
    where pytest is missing, or a submission is no folder.
    """
    if find_spec("pytest") is None:
        raise LabError(Message("grading needs pytest: pip install pytest"))
    for folder in submissions:
        if not folder.is_dir():
            raise LabError(Message("no folder: a submission is a copy of the sheet's folder").at(folder))
    with ThreadPoolExecutor(workers) as pool:
        yield from pool.map(lambda folder: _grade(sheet, folder, limit_s), submissions)


def _shipped(name: str) -> Path:
    folders = {folder.parent.name: folder.parent for folder in shipped("sheets", "docs/lab").glob(f"*/{SHEET}")}
    found = [folder for known, folder in sorted(folders.items()) if known.startswith(name)]
    if len(found) != 1 or not name:
        words = known_words(name, sorted(folders))
        raise LabError(Message("no sheet is named {name!r}; {words}; or give its folder", name=name[:60], words=words))
    return found[0]


def _grade(sheet: Sheet, submission: Path, limit_s: float) -> SubmissionGrade:
    with TemporaryDirectory(prefix="drillctl-grade-") as place:
        copy = Path(place) / "copy"
        problem = _copied(submission, copy)
        if problem is not None:
            refused = tuple(Check(name, False, str(problem)) for name in sheet.checks)
            return SubmissionGrade(submission.resolve().name, refused)
        _lay_over(sheet, copy)
        report = Path(place) / "report.xml"
        over = _run(_command(sheet, report), copy, limit_s)
        found = _Report(report, copy) if report.is_file() else None
        return SubmissionGrade(submission.resolve().name, tuple(_check(name, found, over) for name in sheet.checks))


def _copied(submission: Path, copy: Path) -> Message | None:
    """Copies the data of a submission; returns why it can't be taken, None where it was."""
    left, files = LARGEST_SUBMISSION_BYTES, 0
    copy.mkdir()
    for place, folders, names in os.walk(submission):
        folders.sort()
        for name in sorted(names):
            file = Path(place) / name
            if file.is_symlink() or not file.is_file() or file.suffix in CODE or name in SETTINGS:
                continue
            left, files = left - file.stat().st_size, files + 1
            if left < 0 or files > MOST_FILES:
                return Message("it has more than {files} files or {mb} MB", files=MOST_FILES,
                               mb=LARGEST_SUBMISSION_BYTES // 2**20)  # fmt: skip
            target = copy / file.relative_to(submission)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, target)
    return None


def _lay_over(sheet: Sheet, copy: Path) -> None:
    """The sheet's own checks in place of the student's; an empty file keeps pytest from settings farther up."""
    for name in sheet.checks:
        target = copy / name
        if target.is_dir():
            shutil.rmtree(target)
        shutil.copyfile(sheet.folder / name, target)
    (copy / "pytest.ini").write_text("[pytest]\n")


def _command(sheet: Sheet, report: Path) -> list[str]:
    options = ["-q", "--noconftest", "-p", PLUGIN, "-p", "no:cacheprovider", "--import-mode=importlib"]
    return [sys.executable, "-I", "-m", "pytest", *options, "-c", "pytest.ini", f"--junitxml={report}", *sheet.checks]


def _run(command: list[str], copy: Path, limit_s: float) -> bool:
    """Runs the checks in the copy; returns whether the time ended first. Whatever they have started ends with them."""
    kept = {name: os.environ[name] for name in ("PATH", "LANG", "TMPDIR") if name in os.environ}
    surroundings = {**kept, "HOME": str(copy), "XDG_CONFIG_HOME": str(copy), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    process = subprocess.Popen(
        command, cwd=copy, env=surroundings, start_new_session=True, stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        process.wait(limit_s)
    except subprocess.TimeoutExpired:
        return True
    finally:
        _end(process)
    return False


def _end(process: "subprocess.Popen[bytes]") -> None:
    system.end_group(process.pid)
    process.wait()


class _Report:
    """What pytest told of the checks of one copy."""

    def __init__(self, file: Path, copy: Path):
        self._cases = list(ElementTree.parse(file).iter("testcase"))
        self._copy = f"{copy}/"

    def problems(self, check: str) -> list[str] | None:
        """What is wrong by a check, a sentence a test; None where it has no test."""
        cases = [case for case in self._cases if _is_of(case, check)]
        problems = [case.find(kind) for case in cases for kind in ("failure", "error", "skipped")]
        return [self._sentence(problem) for problem in problems if problem is not None] if cases else None

    def _sentence(self, problem: ElementTree.Element) -> str:
        """The first line of a failure that says something, with files as the student calls them."""
        lines = [line.strip() for line in (problem.get("message") or problem.text or "").splitlines()]
        said = next((line for line in lines if line), "")
        return RAISED.sub("", said).replace(self._copy, "")


def _check(name: str, report: _Report | None, over: bool) -> Check:
    """A check has passed where all its tests did, and there was one."""
    if over:
        return Check(name, False, str(Message("it took longer than it may")))
    if report is None:
        return Check(name, False, str(Message("it could not be judged")))
    problems = report.problems(name)
    if problems is None:
        return Check(name, False, str(Message("it has no test")))
    return Check(name, not problems, problems[0].removeprefix(f"{name}: ") if problems else "")


def _is_of(case: ElementTree.Element, name: str) -> bool:
    """Whether a test of the report is of a file: pytest has a trace by its name, a module without its ending."""
    where = case.get("classname", "")
    return where == name or where.partition(".")[0] == name.partition(".")[0]
