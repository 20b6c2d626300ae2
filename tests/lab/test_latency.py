"""``drillctl latency``: the measurement, that its processes end on every way out, and what is printed."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from msgspec.structs import replace

from drillctl.generation.queues import MOVED_STEPS, there_and_back
from drillctl.lab import latency
from drillctl.lab.latency import MOST_PROCESSORS, LatencyError, measure
from drillctl.lab.wakeups import WakeupLog
from drillctl.machine import Library, Machine
from drillctl.ticker.ticker import Ticker
from drillctl.ui.terminal.reports import latency_lines
from drillctl.viewmodel.reports import LatencyReport
from tests.support.bench import shipped

COMMAND = (sys.executable, "-m", "drillctl", "latency")
LONG_S = 600
PERIOD_NS = 2_000_000
Done = subprocess.CompletedProcess[str]

pytestmark = [
    pytest.mark.paced,
    pytest.mark.skipif(sys.platform != "linux", reason="latency is measured on Linux only"),
]


@pytest.fixture
def machine() -> Machine:
    return Library.standard().machine("pcb-drill").at_rate(100)


@pytest.fixture
def children_left() -> Callable[[], list[int]]:
    """Tells the children of this process, collected or not, but those that an earlier test of it left for good."""
    before = set(children_of(os.getpid()))
    return lambda: [child for child in children_of(os.getpid()) if child not in before]


def test_a_second(machine: Machine, children_left: Callable[[], list[int]]) -> None:
    told = measure(machine, 1)
    assert 1 <= told.ticker.wakes <= 100 and told.canary.wakes >= 1
    assert told.seconds >= 0.9 and not told.interrupted
    assert told.late == told.platform + told.ours + told.unlabelled
    assert sum(bar.ticks for bar in told.histogram) == told.ticker.wakes
    assert 0 < told.cpu_share <= 1 and 0 <= told.canary_late_share <= 1
    assert not children_left()


def test_a_slow_tick_is_our_own_doing(machine: Machine, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every tick outlasts its period three times, while nothing holds the canaries up."""
    monkeypatch.setattr(Ticker, "run", lambda self, ticks: time.sleep(0.03 if ticks == 1 else 0))
    told = measure(machine, 2)
    assert told.late >= told.ticker.wakes - 1 >= 1
    assert told.ours > 0


def test_it_can_be_ended_early(machine: Machine, children_left: Callable[[], list[int]]) -> None:
    looks: list[float] = []

    def third_look() -> bool:
        time.sleep(0.1)
        looks.append(time.monotonic())
        return len(looks) == 3

    told = measure(machine, LONG_S, third_look)
    assert told.interrupted and told.seconds < LONG_S / 2 and told.ticker.wakes
    assert not children_left()


def test_an_error_on_the_way_ends_the_children_too(machine: Machine, children_left: Callable[[], list[int]]) -> None:
    def fail() -> bool:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        measure(machine, LONG_S, fail)
    assert not children_left()


def test_a_dead_ticker_is_no_figure(machine: Machine, children_left: Callable[[], list[int]]) -> None:
    def kill_the_youngest() -> bool:
        time.sleep(0.1)
        if children := children_of(os.getpid()):
            os.kill(children[-1], signal.SIGKILL)
        return False

    with pytest.raises(LatencyError, match="was ended, or died, after"):
        measure(machine, LONG_S, kill_the_youngest)
    assert not children_left()


def test_a_ticker_that_never_begins(
    machine: Machine, monkeypatch: pytest.MonkeyPatch, children_left: Callable[[], list[int]]
) -> None:
    monkeypatch.setattr(latency, "START_S", 0.3)
    monkeypatch.setattr(latency, "LEAVE_S", 0.1)
    monkeypatch.setattr(latency, "run_ticker", lambda *_: time.sleep(LONG_S))
    with pytest.raises(LatencyError, match="did not begin"):
        measure(machine, LONG_S)
    assert not children_left()


def test_it_says_so_on_another_system(machine: Machine, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "darwin")
    with pytest.raises(LatencyError, match="Linux only"):
        measure(machine, 1)


def run(*arguments: str) -> Done:
    return subprocess.run([*COMMAND, *arguments], capture_output=True, text=True, timeout=60, check=False)


def started(*arguments: str) -> "subprocess.Popen[str]":
    return subprocess.Popen([*COMMAND, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def children_of(pid: int) -> list[int]:
    """Oldest first."""
    return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def wait_for(condition: Callable[[], object], seconds: float = 30.0) -> None:
    end_s = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end_s, "waited in vain"
        time.sleep(0.05)


def wait_for_children(pid: int) -> None:
    """The ticker, and a canary on each processor."""
    canaries = min(len(os.sched_getaffinity(0)), MOST_PROCESSORS)
    wait_for(lambda: len(children_of(pid)) == canaries + 1)


def gone(pids: list[int]) -> bool:
    """Ended; a zombie that nobody collects has ended too."""
    stats = [Path(f"/proc/{pid}/stat") for pid in pids]
    return all(not stat.exists() or stat.read_text().rpartition(")")[2].split()[0] == "Z" for stat in stats)


def test_json() -> None:
    done = run("--hz", "200", "--seconds", "1", "--json")
    told = json.loads(done.stdout)
    assert (done.returncode, done.stderr) == (0, "")
    assert (told["machine"], told["tick_hz"], told["interrupted"]) == ("pcb-drill", 200, False)
    assert told["real_time"] == (told["refused"] == []) and told["grade"]["letter"] in "ABCDE"


def test_text() -> None:
    done = run("--seconds", "1")
    assert done.returncode == 0 and "ticks at 500 Hz" in done.stdout and "\ngrade " in done.stdout


def test_a_moving_machine_is_measured_too() -> None:
    """And the report says so, in both forms."""
    told = json.loads(run("--hz", "200", "--seconds", "1", "--moving", "--machine", "eight-axis", "--json").stdout)
    assert told["moving"] and told["ticker"]["wakes"] > 0 and told["machine"] == "eight-axis"
    assert ", moving: " in run("--hz", "200", "--seconds", "1", "--moving").stdout


@pytest.mark.parametrize("name", ["pcb-drill", "cnc-shield"])
def test_the_moves_of_the_measurement_go_on(name: str) -> None:
    """Homed, and then all axes there and back without a fault, for as long as it takes."""
    machine = shipped(name)
    moves, ticker = there_and_back(machine), Ticker.simulated(machine)
    ticker.queue.put(moves)
    ticker.run(20_000, lambda: ticker.controller.done == len(moves))
    for _ in range(3):
        ticker.queue.put(moves[1:])
        ticker.run(1)
        ticker.run(5_000, lambda: not len(ticker.queue) and not ticker.controller.busy)
    assert not ticker.controller.fault and ticker.controller.axes[0].made >= 3 * 2 * MOVED_STEPS
    assert ticker.controller.axes[2].made >= 3 * MOVED_STEPS // 2


def test_a_machine_too_quick_to_be_measured_is_refused() -> None:
    done = run("--machine", "boiler-drum")
    assert (done.returncode, done.stdout) == (2, "") and "choose a rate with --hz" in done.stderr


@pytest.mark.parametrize(
    "arguments",
    [("--hz", "0"), ("--hz", "20001"), ("--hz", "1.5"), ("--seconds", "0"), ("--seconds", "3601")],
    ids=" ".join,
)
def test_refusals(arguments: tuple[str, str]) -> None:
    done = run(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"drillctl: argument {arguments[0]}: ") and "whole number from 1" in done.stderr


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_it_with_what_was_measured(number: int, code: int) -> None:
    process = started("--seconds", str(LONG_S), "--json")
    wait_for_children(process.pid)
    time.sleep(1.5)
    children = children_of(process.pid)
    process.send_signal(number)
    out, err = process.communicate(timeout=30)
    assert (process.returncode, err) == (code, "")
    told = json.loads(out)
    assert told["interrupted"] and told["ticker"]["wakes"] > 0 and told["seconds"] < LONG_S / 2
    assert gone(children)


def test_the_children_of_a_killed_one_end_by_themselves() -> None:
    with started("--seconds", str(LONG_S)) as process:
        wait_for_children(process.pid)
        children = children_of(process.pid)
        process.kill()
    wait_for(lambda: gone(children))


@pytest.fixture
def told(machine: Machine) -> LatencyReport:
    """As the lab reports it, from made-up wakes: 98 punctual ones, one late alone, one with the canary."""
    log = WakeupLog()
    for second, late_ns in enumerate([20_000] * 98 + [11_000_000, 30_000_000], 1):
        log.add(second * 1_000_000_000 + late_ns, late_ns, PERIOD_NS)
    log.record["from_ns"], log.record["to_ns"], log.record["cpu_ns"] = 0, 200_000_000_000, 1_000_000_000
    canary = WakeupLog()
    canary.add(100_020_000_000, 10_000_000, PERIOD_NS)
    log.record["refused"] = b"real-time scheduling: no (grant it)"
    return latency._report(machine, log, [canary], interrupted=True)


def test_all_is_in_it(told: LatencyReport) -> None:
    text = "\n".join(latency_lines(told))
    assert "ended early" in text and "not real-time\n  real-time scheduling: no (grant it)" in text
    assert f"{told.late} of 100" in text and "0.5% of one core" in text
    assert "1 PLATFORM" in text and "1 OURS" in text
    assert f"grade {told.grade.letter}: " in text and "rate: " in text


def test_the_histogram_is_to_scale(told: LatencyReport) -> None:
    rows = [line for line in latency_lines(told) if " us #" in line]
    marks = [row.count("#") for row in rows]
    assert len(rows) == 3 and marks == [max(marks), 1, 1]


@pytest.mark.parametrize(("share", "doubted"), [(0.1, False), (0.11, True)])
def test_canaries_that_are_always_late_prove_nothing(told: LatencyReport, share: float, doubted: bool) -> None:
    text = "\n".join(latency_lines(replace(told, canary_late_share=share)))
    assert ("says little" in text) == doubted
