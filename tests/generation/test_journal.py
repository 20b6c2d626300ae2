"""The journal: cut off anywhere, damaged, full, locked, foreign; and what resuming makes of it.

A run's journal cut after any line is what a power cut at that moment leaves: the resumed run must drill exactly the
rest, and name the hole that was under way.
"""

import csv
import json
import resource
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from drillctl.cli import main
from drillctl.generation.journal import Account, Head, Journal, JournalError, read_journal
from drillctl.machine import shipped_tables

# Tool 1 comes twice, so the numbers of the holes are not those of the file's lines.
BOARD = "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nG90\nT1\nX1.0Y1.0\nX3.0Y1.0\nT2\nX1.0Y3.0\nT1\nX3.0Y4.0\nM30\n"
HEAD = Head("job.drl", "a", "b", "pcb-drill", "c", 9, {})
KINDS = {
    "plain": [],
    "panel": ["--panel", "2x1:6,0", "--skip-tools", "2"],
    "pecks": ["--peck", "1.5"],
    "spots": ["--spot", "0.4"],
    "order": ["--order", "optimised", "--rotate", "90"],
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "job.drl").write_text(BOARD)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*options: str) -> int:
    return main(["run", "job.drl", "--journal", "j", "--holes", "h.csv", "--json", *options])


def resume() -> int:
    return main(["resume", "j", "--holes", "h.csv", "--json"])


def holes(folder: Path) -> list[list[str]]:
    return list(csv.reader((folder / "h.csv").open()))[1:]


def keep_lines(folder: Path, count: int, piece: bytes = b"") -> None:
    lines = (folder / "j").read_bytes().splitlines(keepends=True)
    (folder / "j").write_bytes(b"".join(lines[:count]) + piece)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("lines", [1, 2, 3, 4, 6, 8])
def test_resuming_drills_exactly_the_rest(kind: str, lines: int, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
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
    assert "its last line is torn" in capsys.readouterr().err
    keep_lines(folder, 6, piece=b'{"done": 3}')
    assert read_journal(folder / "j").done == {1, 2}
    assert resume() == 0
    assert holes(folder) == whole[2:]


def test_spots_made_before_the_cut_are_named(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--spot", "0.4") == 0
    keep_lines(folder, 3)
    capsys.readouterr()
    assert resume() == 0
    assert "may bear their spot already; they are marked again, in the same place" in capsys.readouterr().err


def test_a_finished_journal_leaves_nothing_to_resume(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    assert resume() == 2
    assert "all 4 holes of job.drl are drilled; nothing is left" in capsys.readouterr().err


def test_a_new_run_replaces_a_finished_journal(folder: Path) -> None:
    assert run() == 0
    assert run("--skip-tools", "1") == 0
    assert read_journal(folder / "j").head.holes == 1


def test_a_new_run_does_not_replace_an_unfinished_one(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    keep_lines(folder, 4)
    before = (folder / "j").read_bytes()
    capsys.readouterr()
    assert run() == 2
    told = capsys.readouterr()
    assert told.out == "" and "1 of 4 holes of" in told.err
    assert "go on with `drillctl resume j`, or delete the file to begin anew" in told.err
    assert (folder / "j").read_bytes() == before


def test_what_was_never_begun_is_no_loss(folder: Path) -> None:
    assert run() == 0
    for kept in (b"", (folder / "j").read_bytes().splitlines(keepends=True)[0], b'{"drillctl-journal": 1, "jo'):
        (folder / "j").write_bytes(kept)
        assert run() == 0


@pytest.mark.parametrize("text", ["my notes\n", "my notes", BOARD, "{}\n", '{"drillctl-journal": 9}\n'])
def test_a_file_that_is_no_journal_is_left_alone(text: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "j").write_text(text)
    assert run() == 2
    assert "drillctl: j" in capsys.readouterr().err
    assert resume() == 2
    assert (folder / "j").read_text() == text


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        (b"\xff\xfe", "j:3: damaged: not a line of a journal"),
        (b'{"done": 1', "j:3: damaged"),
        (b"[1]", "j:3: damaged"),
        (b'{"done": 5}', "j:3: done 5 is nothing that a journal holds"),
        (b'{"done": 0}', "j:3: done 0"),
        (b'{"done": true}', "j:3: done True"),
        (b'{"drilled": 1}', "j:3: drilled 1"),
    ],
)
def test_damage_in_the_middle_is_named_and_refused(
    line: bytes, reason: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run() == 0
    lines = (folder / "j").read_bytes().splitlines()
    (folder / "j").write_bytes(b"\n".join([*lines[:2], line, *lines[3:], b""]))
    capsys.readouterr()
    assert resume() == 2
    assert reason in capsys.readouterr().err


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
    for old, new, reason in (
        ('"peck": null, ', "", "written by another version of this program"),
        ('"drillctl-journal": 1', '"drillctl-journal": 2', "not a journal of this program"),
        ('"holes": 4, ', "", "its first line is not whole"),
    ):
        (folder / "j").write_text(text.replace(old, new))
        assert resume() == 2
        assert reason in capsys.readouterr().err


def test_nobody_writes_to_a_journal_that_a_living_run_writes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    keep_lines(folder, 4)
    before = (folder / "j").read_bytes()
    living = Journal(folder / "j", read_journal(folder / "j"))
    for again in (run, resume):
        assert again() == 2
        assert "j: is being written by a run that is still going on" in capsys.readouterr().err
    assert (folder / "j").read_bytes() == before
    living.close()
    assert resume() == 0


def test_what_another_run_added_before_the_lock_was_had_is_seen(tmp_path: Path) -> None:
    file = tmp_path / "j"
    Journal(file, HEAD).close()
    stale = read_journal(file)
    with pytest.raises(JournalError, match="another run has gone on with it meanwhile"):
        first = Journal(file, stale)
        first.begun(1)
        first.close()
        Journal(file, stale)


@pytest.mark.parametrize("room_bytes", [0, 5, 30])
def test_a_full_disk_stops_the_job_and_leaves_a_whole_journal(room_bytes: int, folder: Path) -> None:
    assert run() == 0
    lines = (folder / "j").read_bytes().splitlines(keepends=True)
    (folder / "j").unlink()
    limit = sum(map(len, lines[:4])) + room_bytes
    call = [sys.executable, "-m", "drillctl", "run", "job.drl", "--journal", "j", "--json"]
    done = subprocess.run(
        call, capture_output=True, text=True, timeout=60, check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )  # fmt: skip
    assert done.returncode == 1 and "j: can't be written" in done.stderr
    outcome = json.loads(done.stdout)
    assert outcome["interrupted"] and outcome["position_known"] and outcome["fault"] is None
    account = read_journal(folder / "j")
    assert not account.torn and 1 in account.done
    assert resume() == 0
    assert read_journal(folder / "j").done == {1, 2, 3, 4}


@pytest.mark.parametrize("place", ["/dev/full", "/dev/zero", ".", "job.drl/x"])
def test_a_place_that_can_hold_no_journal_is_refused(place: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "job.drl", "--journal", place]) == 2
    assert f"drillctl: {place}: " in capsys.readouterr().err


def test_a_disk_without_room_for_the_first_line_refuses_the_run(folder: Path) -> None:
    call = [sys.executable, "-m", "drillctl", "run", "job.drl", "--journal", "j"]
    done = subprocess.run(
        call, capture_output=True, text=True, timeout=60, check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100)),
    )  # fmt: skip
    assert done.returncode == 2 and "drillctl: j: can't be written" in done.stderr
    assert run() == 0


def test_a_journal_of_ones_own_is_found_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two boards of one name in two folders have a journal each."""
    from drillctl.session import default_journal

    assert default_journal(folder / "a" / "board.drl") != default_journal(folder / "b" / "board.drl")
    assert default_journal(folder / "board.drl") == default_journal(Path("board.drl"))


@given(st.data())
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_cut_at_any_byte_it_is_read_or_refused_and_can_be_gone_on_with(tmp_path: Path, data: st.DataObject) -> None:
    file = tmp_path / "j"
    file.unlink(missing_ok=True)
    journal = Journal(file, HEAD)
    for hole in range(1, 10):
        journal.begun(hole)
        journal.done([hole])
    journal.close()
    whole = file.read_bytes()
    head_bytes = whole.index(b"\n") + 1
    cut = data.draw(st.integers(0, len(whole)))
    file.write_bytes(whole[:cut])
    if cut < head_bytes:
        with pytest.raises(JournalError):
            read_journal(file)
        return
    account = read_journal(file)
    lines = whole[:cut].count(b"\n") - 1
    assert account == Account(HEAD, set(range(1, lines // 2 + 1)), set(range(1, -(-lines // 2) + 1)), torn=account.torn)
    assert account.torn == (whole[cut - 1 : cut] != b"\n")
    with_more = Journal(file, account)
    with_more.ended("stopped")
    with_more.close()
    assert read_journal(file).ended == "stopped"
