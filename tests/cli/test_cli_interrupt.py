"""Ctrl-C and SIGTERM: the machine stops, the outputs are off, the exit code tells, and no half file stays behind."""

import json
import os
import signal
import subprocess
import time
from collections.abc import Callable
from contextlib import closing, suppress
from pathlib import Path

import pytest

from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.jobs.outcome import JobResult
from drillctl.jobs.runner import JobRunner
from drillctl.machine import Library, shipped_tables
from drillctl.ports import SAFE_IMAGE
from drillctl.ticker.link import LocalLink
from drillctl.ticker.ticker import Ticker
from drillctl.viewmodel.records import Progress

Started = Callable[..., "subprocess.Popen[str]"]
SIGNALS = pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
LONG = "KMD_CZEKAJ 40000000\n" * 2
PACING = "KMD_RUCHd x=4000\nKMD_RUCHd x=-4000\n" * 5000


def wait_for(condition: Callable[[], object], seconds: float = 20.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


@SIGNALS
def test_in_the_middle_of_a_queue(number: int, code: int, started: Started, folder: Path) -> None:
    (folder / "long.kmd").write_text("KMD_INICJALIZACJA\n" + LONG)
    process = started("run", "long.kmd", "--engine", "tick", "--json", "--trace", "l.trace", "--holes", "l.csv")
    wait_for(lambda: len(list(folder.glob(".l.*"))) == 2)
    time.sleep(0.7)
    process.send_signal(number)
    out, err = process.communicate(timeout=30)
    assert (process.returncode, err) == (code, "")
    told = json.loads(out)
    assert told["interrupted"] and told["fault"] is None and told["position_known"]
    assert not list(folder.glob(".*")), "half-written files"
    assert (folder / "l.trace").read_text().splitlines()[-1] == f"end {told['ticks']}"


@SIGNALS
def test_before_anything_runs(number: int, code: int, started: Started, folder: Path) -> None:
    """The job is standard input, to which nobody writes: the program waits for it."""
    process = started("run", "/dev/stdin", "--trace", "l.trace", stdin=subprocess.PIPE)
    own = Path(f"/proc/{process.pid}/fd")

    def is_read() -> bool:
        """Opened once more by its name."""
        with suppress(OSError):  # a descriptor that was closed meanwhile
            opened = [os.readlink(entry) for entry in own.iterdir()]
            return opened.count(os.readlink(own / "0")) > 1
        return False

    wait_for(is_read)
    process.send_signal(number)
    out, err = process.communicate(timeout=30)
    assert (process.returncode, out, err) == (code, "", "")
    assert not list(folder.glob(".*")) and not (folder / "l.trace").exists()


@pytest.fixture
def tickers(monkeypatch: pytest.MonkeyPatch) -> list[Ticker]:
    """Every ticker that is made in this process, so that its card can be looked at afterwards."""
    made: list[Ticker] = []
    simulated = Ticker.simulated.__func__

    def spy(cls: type[Ticker], /, *args: object, **named: object) -> Ticker:
        ticker: Ticker = simulated(cls, *args, **named)
        made.append(ticker)
        return ticker

    monkeypatch.setattr(Ticker, "simulated", classmethod(spy))
    return made


def run(folder: Path, text: str, watcher: Callable[[Progress], None]) -> JobResult:
    (folder / "q.kmd").write_text(text)
    machine = Library((shipped_tables(),)).machine("pcb-drill")
    job = load_job(folder / "q.kmd", machine, JobSetup("pcb-drill"))
    with closing(LocalLink(Ticker.simulated(machine))) as link:
        return JobRunner(job, link, watcher).run()


def at_tick(ticks: int, act: Callable[[], None]) -> Callable[[Progress], None]:
    """A watcher that acts every time from then on."""
    return lambda progress: act() if progress.ticks >= ticks else None


def outputs(ticker: Ticker) -> int:
    assert ticker.plant is not None
    return ticker.plant.image


def test_outputs_are_off_after_a_job(tmp_path: Path, tickers: list[Ticker]) -> None:
    assert run(tmp_path, "KMD_RUCHd x=5\n", lambda progress: None).signal is None
    assert outputs(tickers[0]) == SAFE_IMAGE and tickers[0].controller.image != SAFE_IMAGE


def test_outputs_are_off_after_an_error_of_ours(tmp_path: Path, tickers: list[Ticker]) -> None:
    def fail() -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        run(tmp_path, PACING, at_tick(300, fail))
    assert outputs(tickers[0]) == SAFE_IMAGE and tickers[0].controller.moving


@SIGNALS
def test_one_signal_brakes_and_keeps_the_position(
    number: int, code: int, tmp_path: Path, tickers: list[Ticker]
) -> None:
    sent: list[bool] = []
    before = signal.getsignal(number)

    def once() -> None:
        if not sent:
            sent.append(True)
            os.kill(os.getpid(), number)

    done = run(tmp_path, "KMD_INICJALIZACJA\n" + PACING, at_tick(4000, once))
    assert done.signal == number and done.outcome.interrupted and done.outcome.fault is None
    assert done.outcome.position_known and done.outcome.lost_steps == {"x": 0, "y": 0, "z": 0}
    assert outputs(tickers[0]) == SAFE_IMAGE and signal.getsignal(number) is before


def test_a_second_signal_drops_the_outputs_at_once(tmp_path: Path, tickers: list[Ticker]) -> None:
    """The first of them gives the exit code."""

    def both() -> None:
        os.kill(os.getpid(), signal.SIGTERM)
        os.kill(os.getpid(), signal.SIGINT)

    done = run(tmp_path, PACING, at_tick(300, both))
    assert done.signal == signal.SIGTERM and done.outcome.fault is not None
    assert done.outcome.fault.name == "EMERGENCY_STOP" and not done.outcome.position_known
    assert outputs(tickers[0]) == SAFE_IMAGE
