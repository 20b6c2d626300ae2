"""PACE beyond the tick: in both kinds of ticker, in traces, their replay and VCD form, on the dynamic plant."""

import io
import sys
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

from drillctl.execution.clock import PacedClock
from drillctl.generation.job import names_of
from drillctl.kmd import parse_program, to_text
from drillctl.lab.dynamic_rerun import rerun_axis
from drillctl.lab.errors import LabError
from drillctl.machine import Library, shipped_tables
from drillctl.plant import IDEAL_PLANT, PlantChoice
from drillctl.plant.dynamic.coefficients import coefficients
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.portio.simulated import SimulatedCard
from drillctl.replay.compare import replay, taped_again
from drillctl.ticker import paced_link
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.launch import RunSettings, start
from drillctl.ticker.link import Link, LocalLink
from drillctl.ticker.paced_link import PacedLink
from drillctl.ticker.sampler import vcd_layout
from drillctl.ticker.ticker import Ticker
from drillctl.trace import TraceError, read_text, write_text
from drillctl.trace.vcd import write_vcd

pytestmark = pytest.mark.paced

LIBRARY = Library((shipped_tables(),))
MACHINE = LIBRARY.machine("pcb-drill").at_rate(100)  # a gap of less than 70 ms is no news to a motor then
MOST_TURNS = 3000
LINKS = ["local", "fast", pytest.param("paced", marks=pytest.mark.skipif(sys.platform != "linux", reason="real pace"))]
QUEUE = "KMD_RUCHd x=9\nKMD_RUCHd x=-4\n"
PROGRAM = parse_program(QUEUE, names_of(MACHINE))


@pytest.fixture(params=LINKS)
def link(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Link]:
    plant = IDEAL_PLANT.build(MACHINE)
    made: Link
    if request.param == "local":
        made = LocalLink(Ticker(MACHINE, SimulatedCard(plant), plant, traced=True))
    elif request.param == "fast":
        made = LocalLink(FastTicker.ideal(MACHINE, traced=True))
    else:
        made = PacedLink(MACHINE, SimulatedCard(plant), plant, tmp_path / "status", traced=True, derived=False)
    yield made
    made.close()


def recorded(link: Link, folder: Path) -> Path:
    """A run of two moves at 100 Hz, then a rate of 125 Hz, and the file of its trace."""
    program = PROGRAM.copy()
    link.queue.put(program[:1])
    turn_until(link, lambda: link.status()["done"] == 1)
    link.queue.put(program[1:])
    turn_until(link, lambda: link.status()["done"] == len(program))
    position, known = link.status()["position"].tolist(), link.status()["position_known"]
    assert link.set_rate(125)
    turn_until(link, lambda: link.status()["tick_hz"] == 125)
    assert link.status()["position"].tolist() == position and link.status()["position_known"] == known
    names = names_of(MACHINE)
    commands = [("command", f"{record['sequence']} {to_text(record, names)}") for record in program]
    told = [("machine", MACHINE.name), ("digest", MACHINE.digest), ("tick_hz", "100"), *link.plant_header, *commands]
    trace = link.trace(told)
    assert trace is not None
    write_text(trace, folder / "t.trace")
    return folder / "t.trace"


def turn_until(link: Link, holds: object) -> None:
    assert callable(holds)
    for _ in range(MOST_TURNS):
        if holds():
            return
        link.turn()
    raise AssertionError("never came")


def test_it_is_in_the_trace_with_its_value_and_replays(link: Link, tmp_path: Path) -> None:
    file = recorded(link, tmp_path)
    text = file.read_text()
    assert text.count(" request PACE\n") == 1 and text.count(" pace 125\n") == 1
    for engine in ("tick", "fast"):
        assert not replay(file, LIBRARY, engine).failed(same_tables_wanted=True)
    file.write_text(text.replace(" pace 125\n", " pace 0125\n"))
    with pytest.raises(TraceError):
        replay(file, LIBRARY)


def test_a_trace_without_one_has_no_such_signal() -> None:
    ticker = Ticker.simulated(MACHINE, traced=True)
    ticker.queue.put(PROGRAM.copy())
    ticker.run(40)
    trace = ticker.finished_trace([])
    assert trace is not None and not trace.has("pace")


@pytest.mark.parametrize("rate", [0, 100_001, -5])
def test_what_is_no_rate_in_a_trace_is_refused(rate: int, tmp_path: Path) -> None:
    file = recorded(LocalLink(Ticker.simulated(MACHINE, traced=True)), tmp_path)
    file.write_text(file.read_text().replace(" pace 125\n", f" pace {rate}\n"))
    if rate:
        with pytest.raises(TraceError, match=rf"pace {rate} at tick \d+ is no tick rate"):
            replay(file, LIBRARY)


def test_the_segment_form_has_it_too(tmp_path: Path) -> None:
    file = recorded(LocalLink(Ticker.simulated(MACHINE, traced=True)), tmp_path)
    trace = read_text(file)
    assert taped_again(trace, MACHINE, file).trace() == trace


def test_every_tick_stands_at_its_time_in_a_vcd(tmp_path: Path) -> None:
    """A tick is 10 ms long, up to and with the one that changes the rate; from there on 8 ms."""
    ticker = Ticker.simulated(MACHINE, traced=True, derived=True)
    changed = [3, 11]
    for rate, tick in zip((125, 7), changed, strict=True):
        ticker.run(tick - ticker.controller.tick)
        ticker.requests.set_rate(rate)
    ticker.run(30 - ticker.controller.tick)
    header = [("machine", "m"), ("digest", "d"), ("tick_hz", "100")]
    trace = ticker.finished_trace(header)
    assert trace is not None
    file = io.StringIO()
    write_vcd(trace, file, [var for var in vcd_layout(MACHINE) if var.source.startswith("out")])
    text = file.getvalue()
    assert "tick_hz=100 " in text and "tick_hz=125@4" in text and "tick_hz=7@12" in text
    end_us = (4 * Fraction(1, 100) + 8 * Fraction(1, 125) + 18 * Fraction(1, 7)) * 1_000_000
    assert "timescale 1 us" in text and text.rstrip().endswith(f"#{round(end_us)}")


def test_a_picture_with_one_scale_of_time_refuses(tmp_path: Path) -> None:
    file = recorded(LocalLink(Ticker.simulated(MACHINE, traced=True)), tmp_path)
    with pytest.raises(LabError, match="PACE"):
        rerun_axis(file, LIBRARY)


def test_the_dynamic_plant_has_ticks_of_the_new_length() -> None:
    ticker = Ticker.simulated(MACHINE.at_rate(500), plant_choice=PlantChoice("dynamic"))
    plant = ticker.plant
    assert isinstance(plant, DynamicPlant)
    ticker.run(5)
    ticker.requests.set_rate(580)
    ticker.run(5)
    for motor, table in zip(plant.motors, MACHINE.axes, strict=True):
        assert table.dynamics is not None
        assert motor.axis.law == coefficients(table.dynamics, 580)


def test_the_clock_has_its_new_period_from_the_next_tick_on() -> None:
    now = [0]

    def sleep(seconds: float) -> None:
        now[0] += round(seconds * 1e9)

    clock = PacedClock(100, now_ns=lambda: now[0], sleep_s=sleep)
    begun = []
    for tick in range(5):
        clock.wait()
        begun.append(clock.begun_ns)
        if tick == 1:
            clock.set_rate(125)
    assert [after - before for before, after in pairwise(begun)] == [
        10_000_000, 10_000_000, 8_000_000, 8_000_000,
    ]  # fmt: skip
    assert not clock.late


@pytest.mark.skipif(sys.platform != "linux", reason="real pace")
def test_who_watches_the_beat_knows_of_a_longer_tick(tmp_path: Path) -> None:
    """At one tick a second the ticker is silent for longer than the guard bears of a quick one."""
    plant = IDEAL_PLANT.build(MACHINE)
    made = PacedLink(MACHINE, SimulatedCard(plant), plant, tmp_path / "status", traced=False, derived=False)
    try:
        assert made.set_rate(1)
        turn_until(made, lambda: made.status()["tick_hz"] == 1)
        for _ in range(160):
            made.turn()
        assert not made.lost() and not made.status()["fault"]
    finally:
        made.close()


@pytest.mark.skipif(sys.platform != "linux", reason="real pace")
@pytest.mark.parametrize("waits", [True, False])
def test_a_turn_sleeps_unless_the_caller_waits_between_turns(
    waits: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    running = RunSettings(pace="real", kept=True, sliced=True, waits=waits)
    made = start(MACHINE, running, tmp_path / "status")
    slept: list[float] = []
    try:
        with monkeypatch.context() as patched:
            patched.setattr(paced_link.time, "sleep", slept.append)
            made.turn()
    finally:
        made.close()
    assert bool(slept) == waits
