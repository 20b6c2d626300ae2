"""What a verb does before it answers is shown part by part, with how far it is."""

from pathlib import Path
from types import TracebackType
from typing import TextIO

import pytest

from drillctl.cli import main
from drillctl.ui.terminal import wait
from tests.support import journalled
from tests.support.journalled import BOARD

pytestmark = pytest.mark.paced

READ, ORDERED, FORECAST, RUN_AGAIN = (
    "reading job.drl", "putting the holes in order", "working out how long the job takes", "running it again",
)  # fmt: skip
Calls = list[tuple[int, int]]


class Watched:
    """In place of a Wait: keeps what it is called with."""

    parts: list[tuple[str, Calls]] = []

    def __init__(self, stream: TextIO):
        pass

    def __enter__(self) -> "Watched":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        pass

    def __call__(self, what: str):
        calls: Calls = []
        self.parts.append((what, calls))
        return lambda done, total: calls.append((done, total))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "job.drl").write_text(BOARD)
    monkeypatch.chdir(tmp_path)
    assert main(["run", "job.drl", "--trace", "t.trace"]) == 0
    monkeypatch.setattr(wait, "Wait", Watched)
    monkeypatch.setattr(Watched, "parts", [])
    return tmp_path


@pytest.mark.parametrize(
    ("call", "parts"),
    [
        (["inspect", "job.drl"], {READ}),
        (["estimate", "job.drl", "--order", "optimised"], {READ, ORDERED, FORECAST}),
        (["estimate", "job.drl", "--order", "nearest", "--engine", "tick"], {READ, ORDERED, FORECAST}),
        (["run", "job.drl", "--order", "optimised", "--pace", "real", "--tick-hz", "1500"], {READ, ORDERED, FORECAST}),
        (["replay", "t.trace"], {RUN_AGAIN}),
        (["replay", "t.trace", "--engine", "tick"], {RUN_AGAIN}),
        (["convert", "t.trace", "--to", "t.seg"], {RUN_AGAIN}),
        (["convert", "job.drl", "--to", "job.kmd", "--order", "optimised"], {READ, ORDERED}),
        (["convert", "job.drl", "--to", "clean.drl"], {READ}),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)  # fmt: skip
def test_how_far_each_part_is(call: list[str], parts: set[str], folder: Path) -> None:
    assert main(call) == 0
    found = {what: rows for what, rows in Watched.parts if rows}
    assert set(found) == parts
    for rows in found.values():
        done, totals = [row[0] for row in rows], {row[1] for row in rows}
        assert done == sorted(done) and len(totals) == 1 and 0 < done[-1] == totals.pop()


def test_a_resumed_job_is_read_ordered_and_forecast(folder: Path) -> None:
    assert journalled.run("--order", "optimised", "--pace", "real", "--tick-hz", "1500") == 0
    journalled.keep_lines(folder, 5)
    Watched.parts.clear()
    assert journalled.resume() == 0
    assert [what for what, rows in Watched.parts if rows] == [READ, ORDERED, FORECAST]


def test_in_a_pipe_nothing_is_shown(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.undo()
    monkeypatch.chdir(folder)
    monkeypatch.setattr(wait, "SHOWN_AFTER_S", 0.0)
    assert main(["estimate", "job.drl", "--engine", "tick"]) == 0
    assert capfd.readouterr().err == ""
