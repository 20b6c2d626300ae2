"""A journal that was altered: at every byte, and line by line. It is refused, or says what is right all the same: no
hole skipped, none misplaced, none drilled again without being named.

A journal that ends early, at the end of a line, is what a power cut leaves: there the truth is what it said by then.
"""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from drillctl.cli import main
from drillctl.generation.job_setup import JobSetup
from drillctl.jobs.journal import Account, Head, Journal, JournalError
from drillctl.jobs.journal.reader import account_of
from drillctl.viewmodel.job_options import JobOptions
from drillctl.viewmodel.jobs import Site
from tests.support.journalled import SITE, forged, keep_lines, lines_of, resume, run

HOLES = 3
OPTIONS = json.loads(json.dumps(JobSetup("pcb-drill", JobOptions(order="nearest")).as_journalled()))
HEAD = Head("/job.drl", "a" * 64, "b" * 64, "pcb-drill", "c" * 16, HOLES, OPTIONS)
OTHER = replace(SITE, port="mapped:/card", pace="real")
# What happened, in order: begun and done holes, ends of runs, and S for a resumption.
STORIES = {
    "cut off": ["begun 1", "done 1", "begun 2", "S", "begun 2", "done 2", "begun 3"],
    "stopped": ["begun 1", "done 1", "begun 2", "ended LIMIT", "S", "begun 2", "ended stopped"],
    "between": ["begun 1", "S", "S", "begun 1", "done 1"],
    "done": ["begun 1", "done 1", "begun 2", "done 2", "ended stopped", "S", "begun 3", "done 3", "ended done"],
}


@dataclass(frozen=True)
class Truth:
    """What was really done and begun, told by the story and not by a reader."""

    done: frozenset[int]
    begun: frozenset[int]

    @classmethod
    def of(cls, story: Sequence[str]) -> "Truth":
        told = [event.split() for event in story]
        done = frozenset(int(words[1]) for words in told if words[0] == "done")
        return cls(done, done | {int(words[1]) for words in told if words[0] == "begun"})

    def contradicts(self, account: Account) -> str:
        """What is wrong with an answer; nothing where it is right."""
        if account.head != HEAD:
            return "another job"
        if account.done - self.done:
            return f"skipped: {account.done - self.done}"
        unnamed = self.begun - account.done - {account.again}
        return f"again, and unnamed: {unnamed}" if unnamed else ""


def written(story: Sequence[str], folder: Path) -> bytes:
    """The journal of a story, as the program writes it; each run on another site than the one before."""
    file, sites = folder / "j", [SITE, OTHER]
    file.unlink(missing_ok=True)
    journal = Journal(file, HEAD, sites[0])
    for event in story:
        what, _, value = event.partition(" ")
        if what == "S":
            journal.close()
            sites.reverse()
            journal = Journal(file, account_of(file.read_bytes(), file), sites[0])
        elif what == "done":
            journal.done([int(value)])
        else:
            getattr(journal, what)(int(value) if what == "begun" else value)
    journal.close()
    return file.read_bytes()


def answers(altered: Iterator[bytes]) -> Iterator[tuple[bytes, Account]]:
    """Those that are not refused."""
    for data in altered:
        try:
            yield data, account_of(data, Path("j"))
        except JournalError:
            continue


@pytest.fixture(params=STORIES)
def story(request: pytest.FixtureRequest) -> list[str]:
    return STORIES[request.param]


def test_any_byte_may_be_another(story: list[str], tmp_path: Path) -> None:
    """Every bit flipped, and line ends where there were none. Only the last line may be taken for a torn one."""
    whole, truth = written(story, tmp_path), Truth.of(story)
    last_line = whole.rindex(b"\n", 0, -1) + 1

    def altered() -> Iterator[bytes]:
        for place, byte in enumerate(whole):
            for value in {*(byte ^ 1 << bit for bit in range(8)), *b"\n"} - {byte}:
                yield whole[:place] + bytes([value]) + whole[place + 1 :]

    taken = list(answers(altered()))
    assert [reason for _, account in taken if (reason := truth.contradicts(account))] == []
    assert all(data[:last_line] == whole[:last_line] and data[-1:] != b"\n" for data, _ in taken)
    assert len(taken) == 8  # its line end, as something else


def test_it_may_be_cut_anywhere(story: list[str], tmp_path: Path) -> None:
    """A line is on the disk before what it announces happens: no more has happened than the whole lines say."""
    whole = written(story, tmp_path)
    for data, account in answers(whole[:cut] for cut in range(len(whole))):
        truth = Truth.of(story[: data.count(b"\n") - 1])
        assert truth.contradicts(account) == "" and account.done == truth.done
        assert account.torn == (data[-1:] != b"\n")


def test_of_its_lines_only_the_first_ones_may_be_there(story: list[str], tmp_path: Path) -> None:
    """Lines removed, in every way there is."""
    lines = written(story, tmp_path).splitlines(keepends=True)
    for count in range(1, len(lines)):
        for left in combinations(range(len(lines)), count):
            kept = b"".join(lines[number] for number in left)
            taken = list(answers(iter([kept])))
            assert bool(taken) == (left == tuple(range(count))), left


def test_no_line_may_come_twice_or_elsewhere(story: list[str], tmp_path: Path) -> None:
    lines = written(story, tmp_path).splitlines(keepends=True)
    numbers = range(len(lines))

    def altered() -> Iterator[bytes]:
        for at in numbers:
            for number in numbers:
                yield b"".join([*lines[:at], lines[number], *lines[at:]])
        for a, b in combinations(numbers, 2):
            swapped = list(lines)
            swapped[a], swapped[b] = lines[b], lines[a]
            yield b"".join(swapped)

    assert list(answers(altered())) == []


def test_lines_of_another_journal_are_none_of_this_one(tmp_path: Path) -> None:
    here = written(STORIES["cut off"], tmp_path).splitlines(keepends=True)
    there = written(STORIES["between"], tmp_path).splitlines(keepends=True)
    assert here[:2] == there[:2]  # as far as they tell the same
    other = forged([{**lines_of(tmp_path / "j")[0], "job": "/other.drl"}, {"begun": 1}]).splitlines(keepends=True)
    mixed = ([*here[:4], *there[2:]], [other[0], *here[1:]], [here[0], other[1]])
    assert list(answers(b"".join(lines) for lines in mixed)) == []


BEGUN, DONE = {"begun": 1}, {"done": 1}
STOPPED: dict[str, Any] = {"ended": "stopped"}
SITE_LINE = {"port": "simulated", "pace": "free", "plant": "ideal", "seed": 0}
AGAIN, ON = {"resumed": SITE_LINE, "again": 1}, {"resumed": SITE_LINE, "again": None}
ALL_DONE = [line for hole in range(1, HOLES + 1) for line in ({"begun": hole}, {"done": hole})]


@pytest.mark.parametrize(
    ("lines", "reason"),
    [
        ([{"begun": 2}], "j:2: begun 2 is out of its place: 0 of 3 holes are done, the run goes on"),
        ([BEGUN, BEGUN], "j:3: begun 1 is out of its place: 0 of 3 holes are done, hole 1 is begun, the run goes on"),
        ([BEGUN, {"begun": 2}], "j:3: begun 2"),
        ([BEGUN, DONE, BEGUN], "j:4: begun 1"),
        ([DONE], "j:2: done 1"),
        ([BEGUN, {"done": 2}], "j:3: done 2"),
        ([BEGUN, DONE, DONE], "j:4: done 1"),
        ([BEGUN, {"done": True}], "j:3: done True"),
        ([BEGUN, {"done": 1.0}], "j:3: done 1.0"),
        ([{"begun": 0}], "j:2: begun 0"),
        ([*ALL_DONE, {"begun": 4}], "j:8: begun 4"),
        ([BEGUN, {"suspect": 1}], "j:3: suspect 1 is out of its place: 0 of 3 holes are done, hole 1 is begun"),
        ([BEGUN, DONE, {"suspect": True}], "j:4: suspect True"),
        ([BEGUN, DONE, STOPPED, {"suspect": 1}], "j:5: suspect 1"),
        ([BEGUN, STOPPED, DONE], "j:4: done 1 is out of its place: 0 of 3 holes are done, the run has ended"),
        ([STOPPED, BEGUN], "j:3: begun 1"),
        ([STOPPED, STOPPED], "j:3: ended 'stopped'"),
        ([{"ended": "done"}], "j:2: ended 'done'"),
        ([{"ended": 3}], "j:2: ended 3"),
        ([BEGUN, AGAIN, DONE], "j:4: done 1"),
        ([BEGUN, ON], "j:3: a resumption that drills hole None again"),
        ([BEGUN, DONE, AGAIN], "j:4: a resumption that drills hole 1 again"),
        ([*ALL_DONE, {"ended": "done"}, ON], "j:9: a resumption"),
        ([{**ON, "resumed": {**SITE_LINE, "pace": "fast"}}], "j:2: no port, pace and plant: Invalid enum value 'fast'"),
        ([{**ON, "resumed": {**SITE_LINE, "baud": 9600}}], "j:2: no port, pace and plant"),
        ([{"resumed": SITE_LINE}], "j:2: 'resumed' does not belong in a journal"),
        ([{"begun": 1, "done": 1}], "j:2: 'begun, done' does not belong"),
        ([{"drilled": 1}], "j:2: 'drilled' does not belong"),
        ([{}], "j:2: damaged"),
    ],
)
def test_a_line_out_of_its_place_is_refused_whatever_its_checksum(
    lines: list[dict[str, Any]], reason: str, tmp_path: Path
) -> None:
    written([], tmp_path)
    with pytest.raises(JournalError) as refused:
        account_of(forged([*lines_of(tmp_path / "j"), *lines]), Path("j"))
    assert str(refused.value).startswith(reason)


@pytest.mark.parametrize(
    "change",
    [
        {"holes": 0}, {"holes": True}, {"holes": "3"}, {"options": []}, {"job": ""}, {"job": "a\0b"}, {"site": None},
        {"site": {**SITE_LINE, "seed": -1}}, {"more": 1},
    ],
)  # fmt: skip
def test_a_first_line_that_says_something_else_is_refused(change: dict[str, Any], tmp_path: Path) -> None:
    written([], tmp_path)
    with pytest.raises(JournalError, match="j:1: damaged"):
        account_of(forged([{**lines_of(tmp_path / "j")[0], **change}]), Path("j"))


@pytest.mark.parametrize(
    ("name", "value", "option"),
    [
        ("tick_hz", -7, ["--tick-hz=-7"]), ("tick_hz", 0, ["--tick-hz=0"]), ("tick_hz", 10**6, ["--tick-hz=1000000"]),
        ("tick_hz", 500.5, ["--tick-hz=500.5"]), ("order", "shortest", ["--order", "shortest"]),
        ("origin", "zero", ["--origin", "zero"]), ("mirror", "z", ["--mirror", "z"]),
        ("peck", 0.0, ["--peck", "0"]), ("spot", float("nan"), ["--spot", "nan"]), ("rotate", "x", ["--rotate", "x"]),
        ("offset", [1.0], ["--offset", "1"]), ("panel", [0, 1, 5.0, 5.0], ["--panel", "0x1:5,5"]),
        ("panel", [10**9, 1, 5.0, 5.0], ["--panel", "1000000000x1:5,5"]), ("skip_tools", [9], ["--skip-tools", "9"]),
        ("skip_tools", ["a"], ["--skip-tools", "a"]), ("machine", "nowhere", ["--machine", "nowhere"]),
        ("tables", "/nowhere", ["--tables", "/nowhere"]), ("drills", "/nowhere", ["--drills", "/nowhere"]),
        ("align", "/nowhere", ["--align", "/nowhere"]), ("format", "feet", ["--format", "feet"]),
        ("after_end", "drilled", ["--after-end", "drilled"]),
    ],
)  # fmt: skip
def test_options_in_a_journal_are_held_to_what_the_command_line_takes(
    name: str, value: object, option: list[str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run() == 0
    keep_lines(folder, 4)
    head, *lines = lines_of(folder / "j")
    (folder / "j").write_bytes(forged([{**head, "options": {**head["options"], name: value}}, *lines]))
    assert resume() == 2
    assert capsys.readouterr().err.startswith("drillctl: ")
    try:
        assert main(["run", "job.drl", *option]) == 2
    except SystemExit as refused:
        assert refused.code == 2


def test_nothing_is_written_out_of_its_place(tmp_path: Path) -> None:
    journal = Journal(tmp_path / "j", HEAD, SITE)
    before = (tmp_path / "j").read_bytes()
    for wrong in (lambda: journal.done([1]), lambda: journal.begun(2), lambda: journal.ended("done")):
        with pytest.raises(JournalError, match=r"j: not written: .* is out of its place"):
            wrong()
    assert (tmp_path / "j").read_bytes() == before
    journal.close()


def test_a_line_that_the_disk_did_not_take_is_taken_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else what follows it would belong to no chain."""
    from drillctl.jobs.journal import writer

    journal = Journal(tmp_path / "j", HEAD, SITE)
    journal.begun(1)
    sync, fails = writer.os.fsync, [True]

    def fsync(handle: int) -> None:
        if fails and fails.pop():
            raise OSError(5, "Input/output error")
        sync(handle)

    monkeypatch.setattr(writer.os, "fsync", fsync)
    with pytest.raises(JournalError, match="can't be written: Input/output error"):
        journal.done([1])
    journal.ended("stopped")
    journal.close()
    account = account_of((tmp_path / "j").read_bytes(), tmp_path / "j")
    assert (account.done, account.open, account.ended) == (set(), [1], "stopped")


def test_a_run_that_never_came_to_move_leaves_the_journal_as_it_was(tmp_path: Path) -> None:
    """Its torn line too, which is what names a hole."""
    whole = written(STORIES["between"], tmp_path) + b'{"begun": 2, "ch'
    (tmp_path / "j").write_bytes(whole)
    account = account_of(whole, tmp_path / "j")
    Journal(tmp_path / "j", account, Site("mapped:/other", "real", "ideal")).close()
    assert (tmp_path / "j").read_bytes() == whole and account.again == 2
    journal = Journal(tmp_path / "j", account, SITE)
    journal.ended("stopped")
    journal.close()
    now = account_of((tmp_path / "j").read_bytes(), tmp_path / "j")
    assert (now.again, now.site, now.torn) == (2, SITE, False)
