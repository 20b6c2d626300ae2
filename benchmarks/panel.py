"""What the panel of the boiler-drum drill costs at its fastest: processor time at gear F, by the simulated clock.

    .venv/bin/python benchmarks/panel.py [--seconds 5]

Goal: under half a core, and the pace of the machine's time 1. Needs Linux (/proc) and pyte; prints the computer's load,
which all of it rests on.
"""

import argparse
import os
import re
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from drillctl.generation.boiler_drum.cells import EMPTY_STORE, with_program
from drillctl.generation.boiler_drum.sentence import sentence_of
from drillctl.generation.boiler_drum.store_file import store_text
from tests.support.terminal import Act, Terminal

ROW = ["6F9999", "4F9999"] * 4  # 1 m there and back, 12 s each
SIZES = ((80, 24), (160, 50))
COUNTER = re.compile(r"X +([+-]\d+) ")
CLOCK_HZ = os.sysconf("SC_CLK_TCK")


def main() -> None:
    """Prints a line for each size of terminal."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0, help="that are measured; default: 5")
    seconds = parser.parse_args().seconds
    print(f"load {os.getloadavg()[0]:.2f} on {os.cpu_count()} cores")
    for size in SIZES:
        with tempfile.TemporaryDirectory() as folder:
            _gear_f(Path(folder), size, seconds)


def _gear_f(home: Path, size: tuple[int, int], seconds: float) -> None:
    store = home / ".local" / "state" / "drillctl" / "stores" / "boiler-drum.hex"
    store.parent.mkdir(parents=True)
    cells = with_program(EMPTY_STORE, 1, [sentence_of(text) for text in ROW], "RAM")
    store.write_text(store_text(cells), "ascii")
    terminal = Terminal("screen", "--machine", "boiler-drum", "--lang", "en", folder=home, size=size)
    try:
        terminal.play([
            Act((), ("No workpiece is called.",)), Act(("01p",), ("Workpiece 01 (RAM)",)), Act(("s",), ("Question",)),
            Act(("Right", "Enter"), ("AT WORK",)),
        ])  # fmt: skip
        terminal.until(lambda: _steps(terminal) > 2000, "it never came up the ramp")  # the ramp is 10 mm long
        before_s, steps, spent = time.monotonic(), _steps(terminal), _spent_s(terminal.pid)
        frames = terminal.frames(seconds)
        passed_s = time.monotonic() - before_s
        desk, ticker = (now - then for now, then in zip(_spent_s(terminal.pid), spent, strict=True))
        pace = (_steps(terminal) - steps) / passed_s / (100_000 / 24)
        told = f"{size[0]}x{size[1]}: desk {desk / passed_s:.0%}, ticker and guard {ticker / passed_s:.0%} of a core"
        print(f"{told}, {frames / passed_s:.0f} frames a second, pace {pace:.2f}", flush=True)
    finally:
        terminal.close()


def _steps(terminal: Terminal) -> int:
    found = COUNTER.search(terminal.text)
    return int(found[1]) if found else 0


def _spent_s(pid: int) -> tuple[float, float]:
    """Processor time of a process, and of those that it has started."""
    times = {int(entry): _times(int(entry)) for entry in os.listdir("/proc") if entry.isdigit()}
    children = sum(spent for parent, spent in times.values() if parent == pid)
    return times[pid][1], children


def _times(pid: int) -> tuple[int, float]:
    """Parent, and processor time in seconds; zeros for a process that has gone."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0, 0.0
    return int(fields[1]), (int(fields[11]) + int(fields[12])) / CLOCK_HZ


if __name__ == "__main__":
    main()
