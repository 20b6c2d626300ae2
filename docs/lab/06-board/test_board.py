"""The teacher's check of sheet 6: drills the board with the options of options.txt and compares it with board.seg."""

import shlex
import subprocess
import sys
from itertools import zip_longest
from pathlib import Path

HERE = Path(__file__).parent
# Of a submission no other option is taken: they name files to be written, and ports with motors.
MEANT = {"--format", "--origin", "--mirror", "--rotate", "--offset", "--order", "--skip-tools", "--peck", "--spot"}


def drillctl(*arguments: str) -> None:
    """Runs the program here, and fails with what it says."""
    call = [sys.executable, "-m", "drillctl", *arguments]
    done = subprocess.run(call, cwd=HERE, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr.strip() or "the run ended in a fault"


def test_the_board_is_drilled_as_wanted(tmp_path: Path) -> None:
    options = shlex.split((HERE / "options.txt").read_text("utf-8"))
    assert "--format" in options, "the format is left to a guess"
    other = [option for option in options if option.startswith("--") and option.partition("=")[0] not in MEANT]
    assert not other, f"{other[0]} says nothing of the board or of how it is drilled"
    wanted, made = tmp_path / "wanted.trace", tmp_path / "made.trace"
    drillctl("convert", "board.seg", "--to", str(wanted))
    drillctl("run", "amplifier.drl", *options, "--trace", str(made), "--port", "simulated")
    lines = [file.read_text("utf-8").splitlines() for file in (wanted, made)]
    different = next((pair for pair in zip_longest(*lines, fillvalue="(none)") if pair[0] != pair[1]), None)
    assert different is None, f"wanted: {different[0]}; made: {different[1]}"
