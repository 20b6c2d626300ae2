"""Holes behind the end of the program: refused, unless a person says what becomes of them; a journal keeps it."""

import csv
import json
from pathlib import Path

import pytest

from drillctl.cli import main
from tests.support import journalled

TWO = "M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0\nX3.0Y1.0\nM30\nM48\nMETRIC\nT1C1.0\n%\nT1\nX1.0Y3.0\nX3.0Y4.0\nM30\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "job.drl").write_text(TWO)
    return tmp_path


@pytest.mark.parametrize(
    "verb", [["inspect"], ["run"], ["estimate"], ["convert", "--to", "out.drl"]], ids=lambda v: v[0]
)
def test_refused_unless_asked_for(verb: list[str], folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([verb[0], "job.drl", *verb[1:]]) == 2
    assert "job.drl:9: holes-after-end: " in capsys.readouterr().err
    assert not (folder / "out.drl").exists()


@pytest.mark.parametrize(("choice", "holes"), [("ignore", 2), ("drill", 4)])
def test_as_asked_for(choice: str, holes: int, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", "job.drl", "--json", "--after-end", choice]) == 0
    assert json.loads(capsys.readouterr().out)["holes"] == holes
    assert main(["convert", "job.drl", "--to", "out.drl", "--after-end", choice]) == 0
    assert (folder / "out.drl").read_text().count("\nX") == holes
    assert main(["run", "job.drl", "--holes", "h.csv", "--after-end", choice]) == 0
    assert len(list(csv.reader((folder / "h.csv").open()))) == holes + 1


def test_a_journal_keeps_the_answer(folder: Path) -> None:
    """What was cut off after two of four holes goes on with the other program's two."""
    assert journalled.run("--after-end", "drill") == 0
    journalled.keep_lines(folder, 5)
    assert journalled.resume() == 0
    assert [float(hole[1]) for hole in journalled.holes(folder)] == [1.0, 1.0]
