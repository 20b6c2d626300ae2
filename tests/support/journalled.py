"""A board of four holes, run with its journal and resumed from it: what the tests of journal and resume share."""

import csv
import json
import resource
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

from drillctl.cli import main
from drillctl.jobs.journal.chain import NO_SEAL, sealed
from drillctl.viewmodel.jobs import Site

SITE = Site("simulated", "free", "ideal")

# Tool 1 comes twice, so the numbers of the holes are not those of the file's lines.
BOARD = "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nG90\nT1\nX1.0Y1.0\nX3.0Y1.0\nT2\nX1.0Y3.0\nT1\nX3.0Y4.0\nM30\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Holds the board; the test runs in it."""
    (tmp_path / "job.drl").write_text(BOARD)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*options: str) -> int:
    """The board, in the folder at hand, journal ``j`` and holes ``h.csv``; returns the exit code."""
    return main(["run", "job.drl", "--journal", "j", "--holes", "h.csv", "--json", *options])


def resume(*options: str) -> int:
    """What the journal says is left; returns the exit code."""
    return main(["resume", "j", "--holes", "h.csv", "--json", *options])


def on_a_full_disk(limit_bytes: int, *arguments: str) -> "subprocess.CompletedProcess[str]":
    """The program in a process of its own, in which no file grows beyond the limit. It keeps no bytecode: a module's
    would be cut off there too, without an error, and then fail whoever imports it next.
    """
    return subprocess.run(
        [sys.executable, "-B", "-m", "drillctl", *arguments], capture_output=True, text=True, timeout=60, check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit_bytes, limit_bytes)),
    )  # fmt: skip


def holes(folder: Path) -> list[list[str]]:
    """The holes of the last run, as its CSV has them."""
    return list(csv.reader((folder / "h.csv").open()))[1:]


def keep_lines(folder: Path, count: int, piece: bytes = b"") -> None:
    """Cuts the journal behind so many lines: what a power cut at that moment leaves, with a torn piece of the next."""
    lines = (folder / "j").read_bytes().splitlines(keepends=True)
    (folder / "j").write_bytes(b"".join(lines[:count]) + piece)


def lines_of(file: Path) -> list[dict[str, Any]]:
    """What each line of a journal says, its checksum left out."""
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    return [{key: value for key, value in line.items() if key != "chain"} for line in lines]


def forged(lines: Iterable[dict[str, Any]]) -> bytes:
    """A journal of these lines with the checksums that belong to them: what only somebody who means to can write."""
    found, seal = [], NO_SEAL
    for line in lines:
        data, seal = sealed(line, seal)
        found.append(data)
    return b"".join(found)
