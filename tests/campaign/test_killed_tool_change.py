"""``kill -9`` at each of the 23 steps of a tool change of a paced run: the outputs go off, no chuck moves,
the record claims nothing that is not so, and once somebody has looked `drillctl resume` finishes the board.
"""

import csv
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from drillctl.jobs.magazine import MagazineFile, default_file
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.machine.levels import SPEED_WANTED
from drillctl.portio.mapped import read_map
from tests.support.near_file import BOARD, near_text

pytestmark = [
    pytest.mark.paced,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux"),
]
ENTRY = Path(__file__).with_name("killed_in_step.py")
ROOT = ENTRY.parents[2]
PATIENCE_S = 60.0
SPINDLES = (1, 3)
STEPS = range(1, 24)
DAILY = [(6, "desk"), (16, "ticker")]
ALL = [(step, whom) for step in STEPS for whom in ("desk", "ticker")]


class Killed:
    """A run of the board in a folder of its own, killed in a step of the change from its first tool to its second."""

    def __init__(self, folder: Path):
        self.folder = folder
        (folder / "near.toml").write_text(near_text())
        (folder / "job.drl").write_text(BOARD)
        self.machine: Machine = Library((shipped_tables(),)).machine(str(folder / "near.toml"))

    def program(self, *arguments: str, step: int = 0, whom: str = "nobody") -> int:
        """Runs the program to its end; returns its exit code."""
        call = [sys.executable, str(ENTRY), str(self.folder / "witness"), str(step), whom, *arguments]
        environment = {**os.environ, "PYTHONPATH": str(ROOT), "XDG_STATE_HOME": str(self.folder / "state")}
        with (self.folder / "said").open("ab") as said:
            done = subprocess.run(
                call, cwd=self.folder, stdout=said, stderr=said, env=environment, timeout=PATIENCE_S, check=False
            )
        return done.returncode

    def run(self, step: int, whom: str) -> int:
        """Runs the board and kills that process in that step of the change from its first tool to its second."""
        return self.program(
            "run", "job.drl", "--machine", "near.toml", "--port", "mapped:card", "--pace", "real", "--journal", "j",
            "--spindles", "1,3", "--tools", "assume", "-q", step=step, whom=whom,
        )  # fmt: skip

    def outputs_when_still(self) -> int:
        """The outputs of the card once they have stayed as they are for half a second."""
        until_s, since_s, seen = time.monotonic() + PATIENCE_S, time.monotonic(), -1
        while time.monotonic() < until_s and time.monotonic() - since_s < 0.5:
            if (outputs := read_map(self.folder / "card").outputs) != seen:
                seen, since_s = outputs, time.monotonic()
            time.sleep(0.01)
        return seen

    def record(self) -> MagazineFile:
        return MagazineFile(default_file(self.folder / "state" / "drillctl", self.machine), self.machine)

    def witnessed(self, what: str) -> list[str]:
        lines = (self.folder / "witness").read_text().splitlines()
        return [line.partition(" ")[2] for line in lines if line.startswith(what)]


@pytest.mark.parametrize(
    ("step", "whom"), [pytest.param(*row, marks=() if row in DAILY else pytest.mark.long) for row in ALL]
)
def test_a_run_that_is_killed_in_a_step_goes_on_once_somebody_has_looked(step: int, whom: str, tmp_path: Path) -> None:
    killed = Killed(tmp_path)
    killed.run(step, whom)
    assert killed.witnessed("killed") == [whom], (tmp_path / "said").read_text()

    machine, outputs = killed.machine, dict(killed.machine.outputs)
    still = killed.outputs_when_still()
    word = machine.output_word(SPEED_WANTED)
    assert not still >> outputs["spindle"] & 1 and word is not None and not word.value(still)
    held = killed.witnessed("held")[-1]
    for spindle in SPINDLES:
        opened, tool = still >> outputs[f"chuck_{spindle}"] & 1, killed.record().magazine.chucks[spindle]
        assert not opened or held[spindle - 1] == "0", "a chuck opened by itself, or let its tool fall"
        assert tool is None or (tool != 0) == (held[spindle - 1] == "1"), "the record claims what is not so"

    chucks, bits = killed.record().magazine.unknown()
    assert chucks in ([], [1, 3]) and bool(chucks) == bool(bits)
    assert chucks or step not in (*range(6, 11), *range(16, 21))  # else the desk may have been killed before it knew
    if chucks:
        assert killed.program("resume", "j", "--tools", "assume", "-q") == 2  # nobody knows what they hold
        looked = [f"spindle.{n}=empty" for n in SPINDLES] + [f"place.{place}.{n}=full" for place, n in bits]
        assert killed.program("magazine", "set", *looked, "--machine", "near.toml") == 0
    last = killed.program("resume", "j", "--tools", "assume", "-q", "--holes", "h.csv")
    assert last == 0, (tmp_path / "said").read_text()

    lines = [json.loads(line) for line in (tmp_path / "j").read_text().splitlines()]
    assert [line["done"] for line in lines if "done" in line] == [1, 2, 3] and lines[-1]["ended"] == "done"
    with (tmp_path / "h.csv").open() as drilled:
        made = [(int(row["tool"]), float(row["y_mm"]), int(row["spindle"])) for row in csv.DictReader(drilled)]
    assert made == [(2, y_mm, spindle) for y_mm in (4.0, 5.0) for spindle in SPINDLES]
    assert killed.record().magazine.unknown() == ([], [])
