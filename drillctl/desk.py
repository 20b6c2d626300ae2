"""Wiring of layers 1 and 2: takes a job through the queue to its end, and says how it ended.

Rule: no layer is skipped; the desk knows a job, a queue and a status record, the ticker the rest. On every way out
the outputs are safe. Called by the verbs.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType

from drillctl.generation.feeder import Feeder
from drillctl.generation.job import Job, MadeHole, names_of
from drillctl.interrupts import caught
from drillctl.kmd import Request, to_text
from drillctl.lab import forecast
from drillctl.panel import Outcome, Progress, fault_report
from drillctl.ticker import Ticker
from drillctl.trace import Trace

Watcher = Callable[[Progress], None]


@dataclass(frozen=True)
class Run:
    """A job that is over: how it ended, the holes that the plant saw made, the trace if one was kept."""

    outcome: Outcome
    holes: list[MadeHole]
    trace: Trace | None
    signal: int | None  # that stopped it


def run(job: Job, watcher: Watcher, traced: bool = False, derived: bool = False) -> Run:
    """Drills a job on the simulated machine, free-running. Ctrl-C and SIGTERM stop it; a second one drops it."""
    ticker = Ticker.simulated(job.machine, traced, derived)
    feeder = Feeder(job.program, ticker.queue)
    # A queue written by hand can only be foreseen by running it; nobody wants to wait for that twice.
    total_ticks = forecast(job.program, job.machine).total_ticks if job.work else None
    try:
        with _stopping(ticker) as stopped:
            over = False
            while not over:
                feeder.feed()
                ticker.run(max(1, len(ticker.queue)), ticker.over)
                over = ticker.over()
                watcher(_progress(job, ticker, total_ticks))
        return _ended(job, ticker, stopped[0] if stopped else None)
    finally:
        ticker.port.close()


@contextmanager
def _stopping(ticker: Ticker) -> Iterator[list[int]]:
    """The first signal asks for a stop down the ramp, the second for an emergency stop. Yields those that came."""
    came: list[int] = []

    def ask(number: int, frame: FrameType | None) -> None:
        ticker.requests.post(Request.ESTOP if came else Request.STOP)
        came.append(number)

    with caught(ask):
        yield came


def _progress(job: Job, ticker: Ticker, total_ticks: int | None) -> Progress:
    m, hz = ticker.controller, job.machine.tick_hz
    left = None if total_ticks is None else max(0, total_ticks - m.tick) / hz
    return Progress(m.holes_done, job.holes_total, m.tool, m.tick, m.tick / hz, left)


def _ended(job: Job, ticker: Ticker, stopped_by: int | None) -> Run:
    status = ticker.report()
    names = job.machine.axis_names
    fault = fault_report(int(status["fault"]), bool(status["fault_kept"])) if status["fault"] else None
    outcome = Outcome(
        machine=job.machine.name,
        holes_done=int(status["holes_done"]),
        holes_total=job.holes_total,
        ticks=int(status["tick"]),
        tick_hz=job.machine.tick_hz,
        steps=dict(zip(names, status["steps"].tolist(), strict=False)),
        position=dict(zip(names, status["position"].tolist(), strict=False)),
        position_known=bool(status["position_known"]),
        lost_steps=dict(zip(names, map(round, ticker.lost_steps()), strict=True)),
        starved=int(status["starved"]),
        fault=fault,
        interrupted=stopped_by is not None,
    )
    holes = [job.made_hole(*touch) for touch in ticker.touched]
    return Run(outcome, holes, _trace(job, ticker), stopped_by)


def _trace(job: Job, ticker: Ticker) -> Trace | None:
    if ticker.sampler is None:
        return None
    return ticker.sampler.recorder.finish(ticker.controller.tick, trace_header(job))


def trace_header(job: Job) -> list[tuple[str, str]]:
    """What a trace says of itself, enough to run it again; the machine is named by whoever writes the file."""
    names = names_of(job.machine)
    commands = [("command", f"{record['sequence']} {to_text(record, names)}") for record in job.program]
    return [
        ("machine", job.machine.name),
        ("digest", job.machine.digest),
        ("tick_hz", str(job.machine.tick_hz)),
        ("plant", "ideal"),
        ("seed", "0"),
        *commands,
    ]
