"""What the screen costs: time to the first frame, processor time at rest, while a board is drilled, and while the scope
follows it, and what a hang disturbs.

    .venv/bin/python benchmarks/screen.py [--seconds 10]

Goals: first frame within 0.3 s of the start; at rest under 0.5 % of a core and no byte sent; 20 frames a second under
8 % of a core while a board is drilled at 160x50; the scope under 10 % at 160x46; no late tick for a screen that stands
still. Needs Linux (/proc) and pyte; prints the computer's load before and after, which all of it rests on. Compiled
modules are kept, as for a user, whatever the environment says.
"""

import argparse
import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from tests.support.terminal import FRAME, Act, Terminal

ROOT = Path(__file__).resolve().parent.parent
BOARD = ROOT / "examples" / "blinker.drl"
STARTS = 7
SIZES = ((80, 24), (160, 50))
SCOPE_SIZE = (160, 46)
GOAL_FRAMES = 20  # a second
HANGS, HANG_S = 10, 0.3  # a desk that is silent for 0.4 s gets its machine held: SPEC, 1.15
WHOLE = ("Configuration", "No board is loaded.", "E-STOP", "F4 Quit")
LATE = re.compile(r"(\d+) late")
DRILLING = (
    Act(("f",), (BOARD.name,)),
    Act(("Down", "Enter"), ("33.00 x 20.00 mm",)),
    Act(("Esc",), ("Sensors",)),
    Act(("s",), ("Question",)),
    Act(("Right", "Enter"), ("moving", "1 of 26")),
)


THE_RUN = (Act(("Esc", "t"), ("Phase tables",)), Act(("c",), ("Open a trace",)), Act(("t",), ("KMD_GOTO",)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0, help="of drilling that are measured; default: 10")
    seconds = parser.parse_args().seconds
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    _first_frame("free")  # which compiles what was not compiled yet
    print(f"load {os.getloadavg()[0]:.2f} on {os.cpu_count()} cores")
    print(f"drillctl --help: {_help_cpu_s():.3f} s of processor time, median of {STARTS}")
    for pace in ("real", "free"):
        _starts(pace)
        _rest(pace, seconds)
    for size in SIZES:
        _drilling(size, seconds)
    _drilling(SCOPE_SIZE, seconds, THE_RUN, "the scope follows")
    _hang()
    print(f"load {os.getloadavg()[0]:.2f} at the end")


@contextmanager
def program(*options: str, size: tuple[int, int] = (80, 24)) -> Iterator[Terminal]:
    """Started in a folder of its own, with a board in it."""
    with tempfile.TemporaryDirectory(prefix="drillctl-") as folder:
        shutil.copy(BOARD, folder)
        terminal = Terminal("--lang", "en", *options, folder=Path(folder), size=size)
        try:
            yield terminal
        finally:
            terminal.close()


def _help_cpu_s() -> float:
    return statistics.median(_cpu_s_of([sys.executable, "-m", "drillctl", "--help"]) for _ in range(STARTS))


def _cpu_s_of(command: list[str]) -> float:
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, cwd=ROOT)
    _pid, _status, used = os.wait4(process.pid, 0)
    process.returncode = 0
    return used.ru_utime + used.ru_stime


def _starts(pace: str) -> None:
    wall_s, cpu_s = zip(*(_first_frame(pace) for _ in range(STARTS)), strict=True)
    print(
        f"first frame, --pace {pace}: {statistics.median(wall_s):.3f} s ({min(wall_s):.3f} to {max(wall_s):.3f}), "
        f"{statistics.median(cpu_s):.3f} s of processor time, median of {STARTS}"
    )


def _first_frame(pace: str) -> tuple[float, float]:
    with program("--pace", pace) as terminal:
        terminal.wait_for(*WHOLE)
        return time.monotonic() - terminal.begun_s, _cpu_s(terminal.pid)


def _rest(pace: str, seconds: float) -> None:
    """Nothing is loaded and no key pressed; the desk's process alone, which at free pace ticks as well."""
    with program("--pace", pace, size=SIZES[-1]) as terminal:
        terminal.wait_for(*WHOLE)
        terminal.settle()
        begun_s, begun_cpu_s = time.monotonic(), _cpu_s(terminal.pid)
        came = terminal.collected(2 * seconds)
        share = (_cpu_s(terminal.pid) - begun_cpu_s) / (time.monotonic() - begun_s)
        print(f"at rest, --pace {pace}: {share:.2%} of a core, {len(came)} bytes sent")


def _drilling(size: tuple[int, int], seconds: float, acts: tuple[Act, ...] = (), name: str = "drilling") -> None:
    """The desk's process alone: the ticks have one of their own. ``acts`` come first, after the drilling has begun."""
    with program("--pace", "real", size=size) as terminal:
        terminal.wait_for(*WHOLE)
        terminal.play((*DRILLING, *acts))
        begun_s, begun_cpu_s = time.monotonic(), _cpu_s(terminal.pid)
        came = terminal.collected(seconds)
        wall_s, cpu_s = time.monotonic() - begun_s, _cpu_s(terminal.pid) - begun_cpu_s
        terminal.show(came)
        assert "moving" in terminal.text, f"it drills no more:\n{terminal.text}"
        frames = came.count(FRAME)
        print(
            f"{name} at {size[0]}x{size[1]}: {cpu_s / wall_s:.1%} of a core, {frames / wall_s:.1f} frames/s of "
            f"{len(came) / frames:.0f} bytes; {cpu_s / frames * 1e3:.1f} ms a frame, "
            f"so {cpu_s / frames * GOAL_FRAMES:.1%} at {GOAL_FRAMES} a second"
        )


def _hang() -> None:
    """Stopped and set going again, below the silence that holds the machine; and once above it."""
    with program("--pace", "real") as terminal:
        terminal.wait_for(*WHOLE)
        terminal.play(DRILLING)
        before = _late(terminal)
        terminal.frames(2 * HANGS * HANG_S)
        running = _late(terminal)
        for _ in range(HANGS):
            _stand_still(terminal, HANG_S)
            terminal.frames(HANG_S)
        hung = _late(terminal)
        whole_s = 2 * HANGS * HANG_S
        print(f"late ticks in {whole_s:.0f} s: {running - before} running, {hung - running} with {HANGS} hangs")
        _stand_still(terminal, 2 * HANG_S)
        terminal.wait_for("HELD")
        print(f"a hang of {2 * HANG_S:.1f} s: the machine is held, position known: {'position known' in terminal.text}")


def _stand_still(terminal: Terminal, seconds: float) -> None:
    os.kill(terminal.pid, signal.SIGSTOP)
    time.sleep(seconds)
    os.kill(terminal.pid, signal.SIGCONT)


def _late(terminal: Terminal) -> int:
    found = LATE.search(terminal.text)
    assert found, f"no late ticks are told of:\n{terminal.text}"
    return int(found[1])


def _cpu_s(pid: int) -> float:
    """Of the process so far, by the scheduler's own count: that of /proc/PID/stat is in hundredths of a second."""
    threads = Path(f"/proc/{pid}/task").glob("*/schedstat")
    return sum(int(thread.read_text("ascii").split()[0]) for thread in threads) / 1e9


if __name__ == "__main__":
    main()
