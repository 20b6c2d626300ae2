"""Paced runs as their user has them: the trace of a free run, gaps in time, a silent desk, a slow tick."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from drillctl.kmd.channel import Channel
from drillctl.machine import Library, shipped_tables
from drillctl.portio.mapped import read_map
from drillctl.replay.compare import replay

pytestmark = [
    pytest.mark.paced,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux"),
]

LIBRARY = Library((shipped_tables(),))
BOARD = "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nG90\nT1\nX1.0Y1.0\nT2\nX2.0Y1.5\nM30\n"
QUEUE = "KMD_RUCHd x=60 y=-40\nKMD_RUCHd z=20\nKMD_CZEKAJ 5\nKMD_LINIAd x=-30 y=7 z=-9\nKMD_FAZY_WYL\n"
ON_A_LIMIT = QUEUE.replace("z=-9", "z=-20")
SLOW_HZ = 100  # a gap of less than 70 ms is no news to a motor then
FAST_HZ = 2000
PACED = ("--tick-hz", str(FAST_HZ), "--pace", "real", "--journal", "j", "--json")
ATTEMPTS = 4


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "board.drl").write_text(BOARD)
    return tmp_path


def start(folder: Path, *arguments: str) -> "subprocess.Popen[str]":
    """In a process group of its own, as a shell would: one without a parent outside can't be suspended by SIGTSTP."""
    call = [sys.executable, "-m", "drillctl", "run", *arguments]
    pipe = subprocess.PIPE
    return subprocess.Popen(call, cwd=folder, stdout=pipe, stderr=pipe, text=True, process_group=0)


def finish(run: "subprocess.Popen[str]") -> dict[str, Any]:
    """The outcome; its exit code beside it, as ``exit``."""
    out, err = run.communicate(timeout=60)
    assert "Traceback" not in err, err
    return {**json.loads(out), "exit": run.returncode, "err": err}


def run(folder: Path, *arguments: str) -> dict[str, Any]:
    return finish(start(folder, *arguments, "--json"))


def without_remarks(trace: Path) -> list[str]:
    return [line for line in trace.read_text().splitlines() if not line.startswith("#")]


def has_gaps(trace: Path) -> bool:
    return any(line.split()[1:2] == ["late"] and line.split()[2] != "0" for line in trace.read_text().splitlines()[1:])


@contextmanager
def burners(count: int) -> Iterator[None]:
    """Processes that want all of the computer."""
    lit = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for each in lit:
            each.kill()
            each.wait()


@pytest.mark.parametrize(("queue", "beside"), [(QUEUE, 0), (QUEUE, 2), (ON_A_LIMIT, 0)], ids=["alone", "busy", "fault"])
def test_the_trace_of_a_paced_run_is_that_of_a_free_one(queue: str, beside: int, folder: Path) -> None:
    """To the byte, where no gap was long enough to stop a motor; with one, its replay is the same."""
    rate = ("--tick-hz", str(SLOW_HZ))
    (folder / "queue.kmd").write_text(queue)
    run(folder, "queue.kmd", *rate, "--trace", "free.trace")
    with burners(beside):
        for _ in range(ATTEMPTS):
            run(folder, "queue.kmd", *rate, "--pace", "real", "--trace", "paced.trace")
            assert not replay(folder / "paced.trace", LIBRARY).failed(same_tables_wanted=True)
            if not has_gaps(folder / "paced.trace"):
                break
    assert without_remarks(folder / "paced.trace") == without_remarks(folder / "free.trace")


def test_a_paced_board_has_the_holes_and_the_outcome_of_a_free_one(folder: Path) -> None:
    free = run(folder, "board.drl", "--tick-hz", str(FAST_HZ), "--holes", "free.csv")
    places = ("--pace", "real", "--port", "mapped:card", "--journal", "j", "--trace", "t.trace", "--holes", "paced.csv")
    paced = run(folder, "board.drl", "--tick-hz", str(FAST_HZ), *places)
    assert (folder / "paced.csv").read_bytes() == (folder / "free.csv").read_bytes()
    assert len(list(csv.reader((folder / "paced.csv").open()))) == 3
    by_the_clock = {"ticks", "machine_seconds", "late", "starved", "err"}  # a gap costs ticks
    assert {k: v for k, v in paced.items() if k not in by_the_clock} == {
        k: v for k, v in free.items() if k not in by_the_clock
    }
    assert not replay(folder / "t.trace", LIBRARY).failed(same_tables_wanted=True)
    assert read_map(folder / "card").outputs == 0
    assert not (folder / "j.status").exists()


def moving(folder: Path, run: "subprocess.Popen[str]", ticks: int) -> Channel:
    """The channel of a run that has come to this tick."""
    until_s = time.monotonic() + 20
    while time.monotonic() < until_s and run.poll() is None:
        if (folder / "j.status").exists() and (folder / "j.status").stat().st_size:
            channel = Channel(folder / "j.status", create=False)
            if channel.status()["tick"] >= ticks:
                return channel
        time.sleep(0.005)
    raise AssertionError("the run never came so far")


def stand_still(pid: int, seconds: float) -> None:
    os.kill(pid, signal.SIGSTOP)
    time.sleep(seconds)
    os.kill(pid, signal.SIGCONT)


@pytest.mark.parametrize(("gap_s", "fault"), [(0.02, None), (0.08, None), (0.3, "LATE_TICK")])
def test_a_gap_in_time_is_counted_held_or_a_fault_and_replays(gap_s: float, fault: str | None, folder: Path) -> None:
    begun = start(folder, "board.drl", *PACED, "--trace", "t.trace")
    channel = moving(folder, begun, 2200)  # on its way down
    stand_still(channel["ticker_pid"], gap_s)
    told = finish(begun)
    assert told["late"]["count"] >= 1 and told["late"]["greatest_ms"] >= gap_s * 900
    assert (told["fault"] and told["fault"]["name"]) == fault
    assert told["exit"] == (1 if fault else 0)
    if fault is None:
        assert told["holes_done"] == 2 and told["position_known"] and not any(told["lost_steps"].values())
    else:
        assert (told["fault"]["position"] == "kept") == told["position_known"]
        call = [sys.executable, "-m", "drillctl", "resume", "j", "--json"]
        resumed = subprocess.run(call, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
        assert resumed.returncode == 0 and json.loads(resumed.stdout)["holes_done"] == 2
    text = (folder / "t.trace").read_text()
    assert has_gaps(folder / "t.trace") and ("RESUME" in text) >= (gap_s == 0.08)
    assert not replay(folder / "t.trace", LIBRARY).failed(same_tables_wanted=True)


def test_a_desk_that_falls_silent_for_a_moment_holds_the_machine_and_goes_on(folder: Path) -> None:
    begun = start(folder, "board.drl", *PACED, "--trace", "t.trace")
    moving(folder, begun, 2200)
    stand_still(begun.pid, 0.6)
    told = finish(begun)
    assert told["exit"] == 0 and told["holes_done"] == 2 and told["fault"] is None
    assert {"HOLD", "RESUME"} <= set((folder / "t.trace").read_text().split())
    assert not replay(folder / "t.trace", LIBRARY).failed(same_tables_wanted=True)


def test_a_desk_that_stays_silent_finds_the_outputs_off(folder: Path) -> None:
    """As after Ctrl-Z: the terminal's stop does not reach the other processes."""
    begun = start(folder, "board.drl", *PACED, "--port", "mapped:card")
    moving(folder, begun, 2200)
    os.kill(begun.pid, signal.SIGTSTP)
    time.sleep(1.2)
    assert read_map(folder / "card").outputs == 0
    os.kill(begun.pid, signal.SIGCONT)
    told = finish(begun)
    assert told["fault"]["name"] == "HEARTBEAT_LOST" and not told["position_known"] and told["exit"] == 1


def test_a_tick_slower_than_the_guards_patience_is_no_silence(folder: Path) -> None:
    (folder / "slow.kmd").write_text("KMD_CZEKAJ 3\n")
    told = run(folder, "slow.kmd", "--tick-hz", "1", "--pace", "real")
    assert told["exit"] == 0 and told["ticks"] == 4


def test_a_signal_to_the_ticker_alone_is_no_success(folder: Path) -> None:
    begun = start(folder, "board.drl", *PACED)
    os.kill(moving(folder, begun, 2200)["ticker_pid"], signal.SIGTERM)
    told = finish(begun)
    assert told["exit"] == 1 and told["interrupted"] and told["position_known"] and told["fault"] is None
    assert "stopped before its end" in told["err"]
    assert '"ended": "stopped"' in (folder / "j").read_text()
