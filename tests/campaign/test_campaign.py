"""A few rounds of the campaign, of each kind of blow; more with -m long; and that its judges would see a wrong.

The long one is ``benchmarks/campaign.py``.
"""

import ast
import sys
from pathlib import Path
from random import Random

import pytest

from tests.campaign.blows import BLOWS, Blow
from tests.campaign.board import Board
from tests.campaign.rounds import ROOT, Round, _judge_holes, play

pytestmark = pytest.mark.paced

needs_linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux")
NAMES = [make(Random(0), 8000).name for make in BLOWS]
DAILY = [
    *(f"SIGKILL to {target}" for target in ("desk", "ticker", "guard")), "SIGSTOP to ticker", "SIGTERM to desk",
    "z_bottom stuck at 0", "x_min stuck at 1", "y_min dead, at 1", "port pulled", "disk full under the journal",
    "disk full under the trace",
]  # fmt: skip
FURTHER = [
    "SIGSTOP to desk", "SIGSTOP to guard", "SIGINT to desk", "SIGHUP to desk", "SIGTERM to ticker", "SIGTERM to guard",
    "z_top stuck at 1", "z_bottom stuck at 1", "z_top bouncing", "z_top dead, at 0",
]  # fmt: skip


@needs_linux
@pytest.mark.parametrize("name", [*DAILY, *(pytest.param(name, marks=pytest.mark.long) for name in FURTHER)])
def test_a_round(name: str, tmp_path: Path) -> None:
    assert play(NAMES.index(name), tmp_path).violations == []


def judged(folder: Path, witness: str, said: str = "") -> list[str]:
    """What the judge of the holes says of two holes, 1 mm apart, after these touches and words."""
    board = Board((((1.0, 1.0), (2.0, 1.0)),))
    r = Round(folder, 0, board, Blow("none"), 0.0, Random(0))
    (folder / "witness").write_text(witness)
    (folder / "err").write_text(said)
    _judge_holes(r)
    return r.violations


FIRST, SECOND = "touch 0.0 0.0 600.0\n", "touch 47.0 0.0 600.0\n"
AGAIN = "drillctl: hole 2 (X2.0000 Y1.0000 mm) was cut off; it is drilled again\n"


@pytest.mark.parametrize(
    ("witness", "said", "seen"),
    [
        (FIRST + SECOND, "", None),
        (FIRST + SECOND + "safe 0.0 0.0 0.0\n", AGAIN, None),
        (FIRST + SECOND + SECOND, AGAIN, None),
        (FIRST, "", "hole 2 is lost"),
        (FIRST + SECOND + SECOND, "", "hole 2 was visited 2 times, named 0"),
        (FIRST + FIRST + SECOND, AGAIN, "hole 1 was visited 2 times, named 0"),
        (FIRST + SECOND + "touch 51.0 0.0 600.0\n", "", "a hole at 51.0, 0.0 steps, where there is none"),
    ],
)
def test_the_judge_of_the_holes(witness: str, said: str, seen: str | None, tmp_path: Path) -> None:
    found = judged(tmp_path, witness, said)
    assert found == [] if seen is None else seen in found[0]


def test_nothing_asks_for_the_time_of_day() -> None:
    """So a clock that is set, or jumps, changes nothing: all waiting goes by the monotonic clock."""
    wall = {"time", "time_ns", "localtime", "gmtime", "now", "today", "utcnow", "CLOCK_REALTIME"}
    found = []
    for file in sorted((ROOT / "drillctl").rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Attribute) and node.attr in wall and _is_clock(node.value):
                found.append(f"{file.name}:{node.lineno}")
            if isinstance(node, ast.ImportFrom) and node.module in ("time", "datetime"):
                found.append(f"{file.name}:{node.lineno}: import the module, so that this test sees what is called")
    assert found == []


def _is_clock(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id in ("time", "datetime", "date")
