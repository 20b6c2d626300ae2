"""Whatever comes from outside while the queue is empty, or while time stands still, is in the trace and replays."""

from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.generation.job import load_job
from drillctl.generation.wishes import Wishes
from drillctl.kmd import Request
from drillctl.machine import Library, shipped_tables
from drillctl.trace import write_text
from drillctl.wiring.desk import trace_header
from drillctl.wiring.replay import replay
from drillctl.wiring.ticker import Ticker

LIBRARY = Library((shipped_tables(),))


def run_with(folder: Path, text: str, act: Callable[[Ticker, int], None]) -> Path:
    """A queue that is fed as ``act`` says (it is called before each of many wakes), and the trace of that."""
    machine = LIBRARY.machine("pcb-drill")
    (folder / "q.kmd").write_text(text)
    job = load_job(folder / "q.kmd", machine, Wishes())
    ticker = Ticker.simulated(machine, traced=True)
    ticker.queue.put(job.program[:1])
    for wake in range(400):
        act(ticker, wake)
        if wake == 200:
            ticker.queue.put(job.program[1:])
        ticker.run(1)
    assert ticker.over()
    trace = ticker.finished_trace(trace_header(job))
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
