"""Resuming: a run's journal, cut after any line, is what a power cut leaves. Exactly the rest is drilled, in its place,
and the hole that was under way is named; what is no longer the same job is refused.
"""

import json
import os
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.jobs.journal import read_journal
from drillctl.jobs.session import journals
from drillctl.machine import shipped_tables
from tests.support.journalled import BOARD, holes, keep_lines, on_a_full_disk, resume, run

KINDS = {
    "plain": [],
    "panel": ["--panel", "2x1:6,0", "--skip-tools", "2"],
    "pecks": ["--peck", "1.5"],
    "spots": ["--spot", "0.4"],
    "order": ["--order", "optimised", "--rotate", "90"],
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("lines", [1, 2, 3, 4, 6, 8])
def test_resuming_drills_exactly_the_rest(
    kind: str, lines: int, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*KINDS[kind]) == 0
    whole = holes(folder)
    keep_lines(folder, lines)
    account = read_journal(folder / "j")
    capsys.readouterr()
    assert resume() == 0
    told = capsys.readouterr()
    assert holes(folder) == whole[len(account.done) :]
    outcome = json.loads(told.out)
    assert outcome["holes_done"] == outcome["holes_total"] == len(whole)
    named = [line for line in told.err.splitlines() if "was cut off; it is drilled again" in line]
    assert len(named) == len(account.open) == (1 if lines % 2 == 0 else 0)
    assert all(f"hole {number} (" in line for number, line in zip(account.open, named, strict=True))
    now = read_journal(folder / "j")
    assert now.done == now.begun == set(range(1, len(whole) + 1)) and now.ended == "done"


def test_resumed_twice_after_a_torn_line(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The torn piece goes before anything is appended: the second resume finds no damage."""
    assert run() == 0
    whole = holes(folder)
    keep_lines(folder, 3, piece=b'{"beg')
    account = read_journal(folder / "j")
    assert account.torn and account.done == {1}
    assert resume() == 0
    told = capsys.readouterr().err
    assert "its last line is torn" in told
    assert "hole 2 (X3.0000 Y1.0000 mm) may have been begun; it is drilled again" in told
    keep_lines(folder, 7, piece=b'{"done": 3}')
    assert read_journal(folder / "j").done == {1, 2}
    assert resume() == 0
    assert holes(folder) == whole[2:]


def test_spots_made_before_the_cut_are_named(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--spot", "0.4") == 0
    keep_lines(folder, 3)
    capsys.readouterr()
    assert resume() == 0
    assert "may have their spot already; they are spotted again, in the same place" in capsys.readouterr().err


def test_a_finished_journal_leaves_nothing_to_resume(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    assert resume() == 2
    assert "all holes of job.drl are drilled (4); nothing is left" in capsys.readouterr().err


def test_a_file_that_has_changed_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    keep_lines(folder, 4)
    (folder / "job.drl").write_text(BOARD.replace("X3.0Y4.0", "X3.0Y4.1"))
    assert resume() == 2
    assert "job.drl has changed since the job was begun" in capsys.readouterr().err


def test_another_machine_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = folder / "t" / "machines" / "pcb-drill.toml"
    table.parent.mkdir(parents=True)
    text = (shipped_tables() / "machines" / "pcb-drill.toml").read_text("utf-8")
    table.write_text(text, "utf-8")
    assert run("--tables", "t") == 0
    keep_lines(folder, 4)
    table.write_text(text.replace("hysteresis = 9", "hysteresis = 8"), "utf-8")
    assert resume() == 2
    assert "machine pcb-drill is not the one that the job was begun on" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("used_hits", "diameter_mm", "code", "reason"),
    [(10, 1.0, 0, "is good for 0 more"), (0, 3.0, 2, "drill")],
    ids=["its drills are worn", "a drill is gone"],
)
def test_a_drill_table_that_has_changed_is_looked_at_again(
    used_hits: int, diameter_mm: float, code: int, reason: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What is left needs the drills at hand now; that they are older changes no place."""
    table = "[[drill]]\ndiameter_mm = 0.8\nlife_hits = 10\nused_hits = {}\n[[drill]]\ndiameter_mm = {}\n"
    (folder / "d").write_text(table.format(0, 1.0))
    assert run("--drills", "d") == 0
    keep_lines(folder, 4)
    (folder / "d").write_text(table.format(used_hits, diameter_mm))
    capsys.readouterr()
    assert resume() == code
    assert reason in capsys.readouterr().err


def test_another_alignment_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "a").write_text("1 1 5 5\n3 4 7 8\n")
    assert run("--align", "a") == 0
    keep_lines(folder, 4)
    (folder / "a").write_text("1 1 5 5\n3 4 7.1 8.1\n")
    assert resume() == 2
    assert "the placing, the order or a table beside the job has changed" in capsys.readouterr().err


def test_another_version_of_the_program_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    keep_lines(folder, 4)
    text = (folder / "j").read_text()
    for version, reason in ((1, "a journal of version 1"), (3, "a journal of version 3"), ("a", "not a journal")):
        (folder / "j").write_text(text.replace('"drillctl-journal": 2', f'"drillctl-journal": {version}'))
        assert resume() == run() == 2
        assert capsys.readouterr().err.count(reason) == 2


def test_a_finished_journal_of_the_first_version_is_replaced(folder: Path) -> None:
    (folder / "j").write_text('{"drillctl-journal": 1, "job": "x"}\n{"begun": 1}\n{"done": 1}\n{"ended": "done"}\n')
    assert run() == 0
    assert read_journal(folder / "j").complete


@pytest.mark.parametrize("room_bytes", [0, 5, 40])
def test_a_full_disk_stops_the_job_and_leaves_a_whole_journal(room_bytes: int, folder: Path) -> None:
    assert run() == 0
    lines = (folder / "j").read_bytes().splitlines(keepends=True)
    (folder / "j").unlink()
    limit = sum(map(len, lines[:4])) + room_bytes
    done = on_a_full_disk(limit, "run", "job.drl", "--journal", "j", "--json")
    assert done.returncode == 1 and "j: can't be written" in done.stderr
    outcome = json.loads(done.stdout)
    assert outcome["interrupted"] and outcome["position_known"] and outcome["fault"] is None
    account = read_journal(folder / "j")
    assert not account.torn and 1 in account.done
    assert resume() == 0
    assert read_journal(folder / "j").done == {1, 2, 3, 4}


def test_without_a_name_the_newest_unfinished_job_is_gone_on_with(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kept = journals()
    kept.mkdir(parents=True)
    assert run() == 0
    (folder / "j").rename(kept / "finished.journal")
    assert run() == 0
    keep_lines(folder, 3)
    (folder / "j").rename(kept / "cut.journal")
    later_s = (kept / "cut.journal").stat().st_mtime + 60
    os.utime(kept / "finished.journal", (later_s, later_s))
    capsys.readouterr()
    assert main(["resume", "--json"]) == 0
    told = capsys.readouterr()
    assert "cut.journal: 1 of 4 holes are drilled" in told.err and json.loads(told.out)["holes_done"] == 4
    assert main(["resume", "--json"]) == 2
    assert "no unfinished journal is kept here" in capsys.readouterr().err
