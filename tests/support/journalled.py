"""A board of four holes, run with its journal and resumed from it: what the tests of journal and resume share."""

import csv
from pathlib import Path

from drillctl.cli import main

# Tool 1 comes twice, so the numbers of the holes are not those of the file's lines.
BOARD = "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nG90\nT1\nX1.0Y1.0\nX3.0Y1.0\nT2\nX1.0Y3.0\nT1\nX3.0Y4.0\nM30\n"


def run(*options: str) -> int:
    """The board, in the folder at hand, journal ``j`` and holes ``h.csv``; returns the exit code."""
    return main(["run", "job.drl", "--journal", "j", "--holes", "h.csv", "--json", *options])


def resume() -> int:
    """What the journal says is left; returns the exit code."""
    return main(["resume", "j", "--holes", "h.csv", "--json"])


def holes(folder: Path) -> list[list[str]]:
    """The holes of the last run, as its CSV has them."""
    return list(csv.reader((folder / "h.csv").open()))[1:]


def keep_lines(folder: Path, count: int, piece: bytes = b"") -> None:
    """Cuts the journal behind so many lines: what a power cut at that moment leaves, with a torn piece of the next."""
    lines = (folder / "j").read_bytes().splitlines(keepends=True)
    (folder / "j").write_bytes(b"".join(lines[:count]) + piece)
