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
import threading
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, NoReturn
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
LOOK_S = 0.02  # between two looks at whether the checks have ended
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
    ended = threading.Event()  # by Ctrl-C, or by whoever wants no more grades
    with ThreadPoolExecutor(workers) as pool:
        judge = partial(_grade, sheet, limit_s, ended)
        try:
            yield from pool.map(judge, submissions, names(submissions))
        finally:
            ended.set()


def names(submissions: Sequence[Path]) -> list[str]:
    """Returns what the submissions are called: each by its folder's name, those of one name by their paths."""
    last = [folder.resolve().name for folder in submissions]
    count = Counter(last)
    return [name if count[name] == 1 else str(folder) for name, folder in zip(last, submissions, strict=True)]


def _shipped(name: str) -> Path:
    folders = {folder.parent.name: folder.parent for folder in shipped("sheets", "docs/lab").glob(f"*/{SHEET}")}
    found = [folder for known, folder in sorted(folders.items()) if known.startswith(name)]
    if len(found) != 1 or not name:
        words = known_words(name, sorted(folders))
        raise LabError(Message("no sheet is named {name!r}; {words}; or give its folder", name=name[:60], words=words))
    return found[0]


def _grade(sheet: Sheet, limit_s: float, ended: threading.Event, submission: Path, name: str) -> SubmissionGrade:
    with TemporaryDirectory(prefix="drillctl-grade-") as place:
        copy = Path(place) / "copy"
        problem = _laid_out(sheet, submission, copy)
        if problem is not None:
            return SubmissionGrade(name, tuple(Check(check, False, str(problem)) for check in sheet.checks))
        report = Path(place) / "report.xml"
        over = _run(_command(sheet, report), copy, limit_s, ended)
        found = _report(report, copy)
        return SubmissionGrade(name, tuple(_check(check, found, over) for check in sheet.checks))


def _laid_out(sheet: Sheet, submission: Path, copy: Path) -> Message | None:
    """Makes the copy that is judged; returns why it can't be made, None where it was. The fault of one submission ends
    no other's.
    """
    try:
        problem = _copied(submission, copy)
        if problem is None:
            _lay_over(sheet, copy)
        return problem
    except OSError as error:
        return Message("it can't be copied: {why}", why=message_of(error))


def _copied(submission: Path, copy: Path) -> Message | None:
    """Copies the data of a submission; returns why it can't be taken, None where it was. Raises OSError."""
    left, files = LARGEST_SUBMISSION_BYTES, 0
    copy.mkdir()
    for place, folders, inside in os.walk(submission, onerror=_unread):
        folders[:] = sorted(set(folders) - set(SETTINGS))
        for name in sorted(inside):
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


def _unread(error: OSError) -> NoReturn:
    raise error


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


def _run(command: list[str], copy: Path, limit_s: float, ended: threading.Event) -> bool:
    """Runs the checks in the copy; returns whether the time ended first. Whatever they have started ends with them."""
    until = time.monotonic() + limit_s
    kept = {name: os.environ[name] for name in ("PATH", "LANG", "TMPDIR") if name in os.environ}
    surroundings = {**kept, "HOME": str(copy), "XDG_CONFIG_HOME": str(copy), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    process = subprocess.Popen(
        command, cwd=copy, env=surroundings, start_new_session=True, stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        while process.poll() is None and time.monotonic() < until and not ended.wait(LOOK_S):
            pass
        return process.poll() is None
    finally:
        _end(process)


def _end(process: "subprocess.Popen[bytes]") -> None:
    system.end_group(process.pid)
    process.wait()


def _report(file: Path, copy: Path) -> "_Report | None":
    """What pytest told; None where it told nothing, or was ended while it wrote."""
    try:
        return _Report(file, copy)
    except (OSError, ElementTree.ParseError):
        return None


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
