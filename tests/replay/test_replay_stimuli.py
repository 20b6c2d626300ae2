"""Whatever comes from outside while the queue is empty, or while time stands still, is in the trace and replays."""

from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.generation.job import names_of
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.kmd import Request, parse_program
from drillctl.machine import Library, shipped_tables
from drillctl.replay.compare import replay
from drillctl.replay.header import trace_header
from drillctl.ticker.link import header_of
from drillctl.ticker.ticker import Ticker
from drillctl.trace import write_text

LIBRARY = Library((shipped_tables(),))


def run_with(folder: Path, text: str, act: Callable[[Ticker, int], None]) -> Path:
    """A queue that is fed as ``act`` says (it is called before each of many wakes), and the trace of that."""
    machine = LIBRARY.machine("pcb-drill")
    (folder / "q.kmd").write_text(text)
    job = load_job(folder / "q.kmd", machine, JobSetup("pcb-drill"))
    ticker = Ticker.simulated(machine, traced=True)
    ticker.queue.put(job.program[:1])
    for wake in range(400):
        act(ticker, wake)
        if wake == 200:
            ticker.queue.put(job.program[1:])
        ticker.run(1)
    assert ticker.over()
    trace = ticker.finished_trace(trace_header(job, header_of(ticker.plant)))
    assert trace is not None
    write_text(trace, folder / "q.trace")
    return folder / "q.trace"


def test_a_resume_that_comes_while_the_queue_is_empty_is_in_the_trace(tmp_path: Path) -> None:
    """It is served in a wake that is no tick."""

    def act(ticker: Ticker, wake: int) -> None:
        if wake in (150, 170):
            assert ticker.controller.job and not len(ticker.queue)
            ticker.requests.post(Request.HOLD if wake == 150 else Request.RESUME)

    trace = run_with(tmp_path, "KMD_RUCHd x=9\nKMD_RUCHd x=9\n", act)
    assert {"HOLD", "RESUME"} <= set(trace.read_text().split())
    assert not replay(trace, LIBRARY).failed()


def test_outputs_set_by_hand_are_played_again_each_in_its_tick(tmp_path: Path) -> None:
    """At rest between two jobs of one trace, and in vain within one; without them the run would be another."""
    coil = LIBRARY.machine("pcb-drill").axes[0].wire_bits[0]

    def act(ticker: Ticker, wake: int) -> None:
        if wake in (0, 5, 30, 350):
            ticker.requests.set_output(coil, int(wake != 5))

    trace = run_with(tmp_path, "KMD_CZEKAJ 9\nKMD_RUCHd x=9\n", act)
    assert trace.read_text().count(f" hand {coil}=") == 4 and "request OUTPUT" in trace.read_text()
    assert not replay(trace, LIBRARY).failed()
    trace.write_text(trace.read_text().replace(f"hand {coil}=1\n", f"hand {coil + 1}=1\n"))
    assert replay(trace, LIBRARY).failed()


@pytest.mark.parametrize("granted", [1, 2, 7, 300])
def test_a_run_let_through_by_ticks_is_the_run_that_was_not(granted: int, tmp_path: Path) -> None:
    machine = LIBRARY.machine("pcb-drill")
    text = "KMD_RUCHd x=30 y=-9\nKMD_CZEKAJ 3\nKMD_LINIAd x=5 y=7\n"
    (tmp_path / "q.kmd").write_text(text)
    job = load_job(tmp_path / "q.kmd", machine, JobSetup("pcb-drill"))
    traces = []
    for paused in (False, True):
        ticker = Ticker.simulated(machine, traced=True)
        ticker.queue.put(job.program)
        while not ticker.over() or not ticker.controller.tick:
            if paused and not ticker.gate.left:
                now = ticker.controller.tick
                ticker.gate.grant(0)
                assert not ticker.advance(9) and ticker.controller.tick == now, "it waits"
                ticker.gate.grant(granted)
            ticker.advance(5, ticker.over)
        traces.append(ticker.finished_trace([]))
    assert traces[0] == traces[1]


def test_a_stop_passes_a_shut_gate() -> None:
    machine = LIBRARY.machine("pcb-drill")
    ticker = Ticker.simulated(machine)
    ticker.queue.put(parse_program("KMD_RUCHd x=200", names_of(machine)))
    ticker.run(80)
    ticker.gate.grant(0)
    ticker.requests.post(Request.STOP)
    for _ in range(100):
        ticker.advance(1)
    assert ticker.over() and ticker.controller.axes[0].position > 0


def test_at_a_shut_gate_sensors_are_seen() -> None:
    ticker = Ticker.simulated(LIBRARY.machine("pcb-drill"))
    ticker.gate.grant(0)
    ticker.advance(1)
    seen = int(ticker.report()["sensors"])
    assert ticker.plant is not None
    ticker.plant.inputs ^= 0b11
    ticker.advance(1)
    assert int(ticker.report()["sensors"]) == seen ^ 0b11 and ticker.report()["tick"] == 0


@pytest.mark.parametrize("gaps", [(8,), (9, 9, 9), (30,), (200,)])
def test_gaps_are_played_again_each_in_its_tick(gaps: tuple[int, ...], tmp_path: Path) -> None:
    """Of equal gaps in a row, too: the trace lists changes only. 8 ticks stop a motor, 30 hold, 200 are a fault."""

    def act(ticker: Ticker, wake: int) -> None:
        if 30 <= wake < 30 + len(gaps):
            ticker.controller.gap = gaps[wake - 30]
        if wake == 120:
            ticker.requests.post(Request.RESUME)

    trace = run_with(tmp_path, "KMD_RUCHd x=40\nKMD_RUCHd x=9\n", act)
    assert f"late {gaps[0]}\n" in trace.read_text()
    assert not replay(trace, LIBRARY).failed()
    trace.write_text(trace.read_text().replace(f"late {gaps[0]}\n", "late 1\n"))
    assert replay(trace, LIBRARY).failed()
