"""The journal as a file: begun, locked, cut at any byte; never overwritten while anything in it is wanted. What becomes
of one that was altered: test_altered_journal.py.
"""

import json
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from drillctl.cli import main
from drillctl.jobs.journal import Head, Journal, JournalError, read_journal
from drillctl.jobs.session import default_journal
from tests.support.journalled import BOARD, SITE, keep_lines, on_a_full_disk, resume, run

HEAD = Head("job.drl", "a", "b", "pcb-drill", "c", 9, {})


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
    assert json.loads(told.out)["error"]["code"] == "journal" and "1 of 4 holes are done" in told.err
    assert "go on with `drillctl resume j`, or delete the file to begin anew" in told.err
    assert (folder / "j").read_bytes() == before


def test_what_was_never_begun_is_no_loss(folder: Path) -> None:
    assert run() == 0
    for kept in (b"", (folder / "j").read_bytes().splitlines(keepends=True)[0], b'{"drillctl-journal": 2, "jo'):
        (folder / "j").write_bytes(kept)
        assert run() == 0


@pytest.mark.parametrize("text", ["my notes\n", "my notes", BOARD, "{}\n", '{"drillctl-journal": 9}\n'])
def test_a_file_that_is_no_journal_is_left_alone(text: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "j").write_text(text)
    assert run() == 2
    assert "drillctl: j" in capsys.readouterr().err
    assert resume() == 2
    assert (folder / "j").read_text() == text


def test_nobody_writes_to_a_journal_that_a_living_run_writes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    keep_lines(folder, 4)
    before = (folder / "j").read_bytes()
    living = Journal(folder / "j", read_journal(folder / "j"), SITE)
    for again in (run, resume):
        assert again() == 2
        assert "j: is being written by a run that is still going on" in capsys.readouterr().err
    assert (folder / "j").read_bytes() == before
    living.close()
    assert resume() == 0


def test_what_another_run_added_before_the_lock_was_had_is_seen(tmp_path: Path) -> None:
    file = tmp_path / "j"
    Journal(file, HEAD, SITE).close()
    stale = read_journal(file)
    with pytest.raises(JournalError, match="another run has gone on with it meanwhile"):
        first = Journal(file, stale, SITE)
        first.begun(1)
        first.close()
        Journal(file, stale, SITE)


@pytest.mark.parametrize("place", ["/dev/full", "/dev/zero", ".", "job.drl/x"])
def test_a_place_that_can_hold_no_journal_is_refused(
    place: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "job.drl", "--journal", place]) == 2
    assert f"drillctl: {place}: " in capsys.readouterr().err


def test_a_disk_without_room_for_the_first_line_refuses_the_run(folder: Path) -> None:
    done = on_a_full_disk(100, "run", "job.drl", "--journal", "j")
    assert done.returncode == 2 and "drillctl: j: can't be written" in done.stderr
    assert run() == 0


def test_a_journal_of_ones_own_is_found_again(folder: Path) -> None:
    """Two boards of one name in two folders have a journal each."""
    assert default_journal(folder / "a" / "board.drl") != default_journal(folder / "b" / "board.drl")
    assert default_journal(folder / "board.drl") == default_journal(Path("board.drl"))


@given(st.data())
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_cut_at_any_byte_it_is_read_or_refused_and_can_be_gone_on_with(tmp_path: Path, data: st.DataObject) -> None:
    file = tmp_path / "j"
    file.unlink(missing_ok=True)
    journal = Journal(file, HEAD, SITE)
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
    assert account.done == set(range(1, lines // 2 + 1)) and account.begun == set(range(1, -(-lines // 2) + 1))
    assert account.head == HEAD and account.site == SITE
    assert account.again == (account.open[0] if account.open else account.next if account.torn and lines < 18 else None)
    assert account.torn == (whole[cut - 1 : cut] != b"\n")
    if account.complete:
        return
    with_more = Journal(file, account, SITE)
    with_more.ended("stopped")
    with_more.close()
    now = read_journal(file)
    assert now.ended == "stopped" and now.done == account.done
    assert now.open == ([account.again] if account.again else [])
