"""Copies of the lab sheets' folders, as students have them. Used by tests/lab_sheets.

Solutions are laid out as the folders that they complete. A sheet's trace is recorded anew in a solved copy, by
`pytest F.trace --drillctl-rewrite`, and put back; in the sheet's own folder the start tables would write it.
"""

import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LAB = ROOT / "docs" / "lab"
SOLUTIONS = ROOT / "tests" / "lab_sheets" / "solutions"
SHEETS = [page.stem for page in sorted(LAB.glob("[0-9]*.md"))]


def entered(sheet: str, place: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the sheet's folder, gone into, with its tables as one's own."""
    copy = shutil.copytree(LAB / sheet, place / sheet, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.chdir(copy)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(copy))
    return copy


def solution(sheet: str) -> list[Path]:
    """The files that solve a sheet, relative to its folder."""
    folder = SOLUTIONS / sheet
    return sorted(file.relative_to(folder) for file in folder.rglob("*") if file.is_file())


def solve(sheet: str, copy: Path, but: Path | None = None) -> None:
    """Lays the solution over the start files, one of its files left out where that is asked for."""
    for file in solution(sheet):
        if file != but:
            shutil.copyfile(SOLUTIONS / sheet / file, copy / file)
