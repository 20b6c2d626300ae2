"""The guard alone: a ticker that is only a process, and a port that says whether it was made safe, and when."""

import mmap
import os
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.kmd.channel import Channel
from drillctl.ticker.child_process import ChildProcess
from drillctl.ticker.guard_process import run_guard

pytestmark = [
    pytest.mark.paced,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the guard needs Linux"),
]
SILENCE_NS = 300_000_000
WITHIN_S = 5.0
SAFE, GONE = 0, 1  # bytes of the port's memory


class StandInPort:
    """A driver in shared memory: counts how often it was made safe; ``broken``: it can't be."""

    def __init__(self) -> None:
        self.memory = mmap.mmap(-1, mmap.PAGESIZE)
        self.ticker = 0
        self.broken = False

    def latch(self) -> int:
        return 0

    def flush(self, image: int) -> None:
        raise AssertionError("the guard flushes nothing")

    def safe(self) -> None:
        if self.broken:
            raise OSError("pulled")
        self.memory[GONE] = not alive(self.ticker)
        self.memory[SAFE] += 1

    def close(self) -> None:
        raise AssertionError("the guard gives nothing back")


def alive(pid: int) -> bool:
    """A process that has ended and waits to be collected writes nothing any more."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def beating(channel: Channel) -> None:
    while True:
        channel["ticker_beat_ns"] = time.monotonic_ns()
        time.sleep(0.01)


class Rig:
    """A guard over a ticker's process that does nothing but beat."""

    def __init__(self, folder: Path):
        self.channel, self.port = Channel(folder / "c", create=True), StandInPort()
        self.channel["ticker_beat_ns"] = time.monotonic_ns()
        self.ticker = ChildProcess(lambda: beating(self.channel))
        self.port.ticker = self.ticker.pid

    def guard(self) -> ChildProcess:
        return ChildProcess(lambda: run_guard(self.channel, self.port, SILENCE_NS))

    def name_ticker(self) -> None:
        self.channel["ticker_pid"] = self.ticker.pid


@pytest.fixture
def rig(tmp_path: Path) -> Iterator[Rig]:
    made = Rig(tmp_path)
    yield made
    made.ticker.end(patience_s=0)


def ended(guard: ChildProcess) -> bool:
    until_s = time.monotonic() + WITHIN_S
    while not guard.gone and time.monotonic() < until_s:
        time.sleep(0.01)
    gone = guard.gone
    guard.end(patience_s=0)
    return gone


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGSTOP, signal.SIGTERM])
def test_a_ticker_that_dies_or_stands_still_is_dead_before_the_port_is_made_safe(rig: Rig, number: int) -> None:
    rig.name_ticker()
    guard = rig.guard()
    time.sleep(0.2)
    os.kill(rig.ticker.pid, number)
    assert ended(guard)
    assert (rig.port.memory[SAFE], rig.port.memory[GONE], rig.channel["guarded"]) == (1, 1, 1)


def test_a_ticker_that_beats_is_left_alone(rig: Rig) -> None:
    rig.name_ticker()
    guard = rig.guard()
    time.sleep(3 * SILENCE_NS / 1e9)
    assert not guard.gone and not rig.ticker.gone and rig.port.memory[SAFE] == 0
    rig.channel["ended"] = 1
    assert ended(guard) and rig.port.memory[SAFE] == 0 and not rig.ticker.gone


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGTSTP])
def test_what_ends_others_does_not_end_the_guard(rig: Rig, number: int) -> None:
    rig.name_ticker()
    guard = rig.guard()
    time.sleep(0.2)
    os.kill(guard.pid, number)
    time.sleep(0.2)
    beat_ns = rig.channel["guard_beat_ns"]
    assert not guard.gone and time.monotonic_ns() - beat_ns < SILENCE_NS
    os.kill(rig.ticker.pid, signal.SIGKILL)
    assert ended(guard) and rig.port.memory[SAFE] == 1


def test_a_port_that_is_gone_does_not_keep_the_guard(rig: Rig, capfd: pytest.CaptureFixture[str]) -> None:
    rig.port.broken = True
    rig.name_ticker()
    guard = rig.guard()
    os.kill(rig.ticker.pid, signal.SIGKILL)
    assert ended(guard) and rig.channel["guarded"] == 1
    assert "Traceback" not in capfd.readouterr().err


def test_a_guard_whose_desk_died_before_it_had_a_ticker_makes_the_port_safe(rig: Rig) -> None:
    def begin_and_die() -> None:
        rig.guard()
        time.sleep(0.3)

    desk = ChildProcess(begin_and_die)
    time.sleep(0.15)
    assert rig.port.memory[SAFE] == 0
    until_s = time.monotonic() + WITHIN_S
    while rig.port.memory[SAFE] == 0 and time.monotonic() < until_s:
        time.sleep(0.01)
    assert desk.gone and rig.port.memory[SAFE] == 1
