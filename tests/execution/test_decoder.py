"""The words of whole runs, recounted by a decoder that knows only the tables: same steps, no column skipped."""

from dataclasses import replace

import pytest

from drillctl.kmd import Request
from drillctl.machine import Machine, shipped_tables
from drillctl.trace import Recorder, Trace, dense
from tests.support.bench import MACHINES, Bench, shipped
from tests.support.decoder import DecodeError, Decoder, Recount, Watch, Windings, decoders

JOB = """KMD_RUCHd x=1; KMD_RUCHd x=-1; KMD_RUCHd x=30 y=-17; KMD_RUCHd x=-5 y=30; KMD_LINIAd x=40 y=-13
KMD_LINIAd x=-9 y=26; KMD_CZEKAJ 4; KMD_INICJALIZACJA; KMD_GOTO_X_Y 37 25; KMD_WIERTLO_DOL; KMD_WIERTLO_GORA
KMD_PREDKOSC 3; KMD_RUCH x=5 y=50; KMD_RUCH x=0 y=0; KMD_CZEKAJ 9"""


def of_shipped(name: str) -> list[Decoder]:
    tables = shipped_tables()
    return decoders(tables / "machines" / f"{name}.toml", tables)


def run_traced(machine: Machine, text: str = JOB) -> tuple[Bench, Trace]:
    b = Bench(machine, traced=True).queue(text)
    b.finish()
    assert b.ticker.sampler is not None
    recorder = b.ticker.sampler.recorder
    assert isinstance(recorder, Recorder)
    return b, recorder.finish(b.m.tick)


def watch(trace: Trace, machine: Machine) -> Watch:
    """A command is popped only where the one before has come to rest, so there no forcing may stand."""
    ticks, _ = trace.changes_of("kmd")
    slowest = max(max(axis.ramp.interval) for axis in machine.axes)
    return Watch(frozenset(ticks.tolist()), slowest)


def check_recount(b: Bench, trace: Trace, decoder: Decoder) -> Recount:
    """The controller's position of every tick lies in what the words allow; at rest nothing else is allowed."""
    recount = decoder.recount(dense(trace, "out.0").tolist(), watch(trace, b.machine))
    axis = b.m.axes[b.index(decoder.axis)]
    assert recount.least[-1] <= axis.travelled <= recount.most[-1]
    looks_alike = 2 if isinstance(decoder, Windings) and decoder.forcing else 0
    spread = [most - least for least, most in zip(recount.least, recount.most, strict=True)]
    assert max(spread) <= looks_alike
    return recount


@pytest.mark.parametrize("name", MACHINES)
def test_the_recount_of_a_whole_job_is_the_controllers(name: str) -> None:
    b, trace = run_traced(shipped(name))
    for decoder in of_shipped(name):
        recount = check_recount(b, trace, decoder)
        axis = b.m.axes[b.index(decoder.axis)]
        assert axis.travelled == 0 or recount.least != recount.least[:1] * len(recount.least)


@pytest.mark.parametrize("name", MACHINES)
def test_every_position_on_the_way_is_recounted(name: str) -> None:
    """Before homing positions are steps from power-up, so they can be compared in every tick."""
    b, trace = run_traced(shipped(name), JOB.partition("KMD_INICJALIZACJA")[0])
    for decoder in of_shipped(name):
        recount = check_recount(b, trace, decoder)
        positions = dense(trace, f"{decoder.axis}.position").tolist()
        for least, most, position in zip(recount.least, recount.most, positions, strict=True):
            columns = position * decoder.columns_per_step
            assert least - decoder.columns_per_step <= columns <= most + decoder.columns_per_step


@pytest.mark.parametrize("name", ["pcb-drill", "boiler-drum", "eight-axis"])
def test_an_inverted_axis_plays_its_table_backwards(name: str) -> None:
    machine = shipped(name)
    x, *others = machine.axes
    b, trace = run_traced(replace(machine, axes=(replace(x, invert=True), *others)), "KMD_RUCHd x=30; KMD_RUCHd x=-12")
    decoder = of_shipped(name)[0]
    recount = check_recount(b, trace, replace(decoder, sense=-1))
    assert abs(recount.least[-1] - 18 * decoder.columns_per_step) <= 2


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.parametrize("request_", [Request.HOLD, Request.STOP, Request.ESTOP])
def test_stops_put_out_no_illegal_word(name: str, request_: Request) -> None:
    for start in range(5, 260, 23):
        b = Bench(shipped(name)).queue("KMD_LINIAd x=30 y=-17; KMD_LINIAd x=-12 y=4").tick(start)
        b.ask(request_).tick(60).ask(Request.RESUME).tick(2).ask(Request.ACK).tick(2)
        b.queue("KMD_RUCHd x=7 y=-9").tick(700)
        for decoder in of_shipped(name):
            recount = decoder.recount(b.images, Watch())
            axis = b.m.axes[b.index(decoder.axis)]
            assert not axis.counting
            assert recount.least[-1] <= axis.travelled <= recount.most[-1]


def word_errors(name: str, words: list[int], cold: int = -1, longest: int = 50) -> str:
    """What the first decoder of a machine says of words that were made wrong."""
    try:
        of_shipped(name)[0].recount(words, Watch(frozenset({cold}), longest))
    except DecodeError as error:
        return str(error)
    return ""


def test_the_decoder_itself_sees_what_is_wrong() -> None:
    """So that its silence above means something."""
    forced, plain, other = 0x25, 0x05, 0x49  # columns 1, 2 and 4 of the paper's table
    assert word_errors("pcb-drill", [0, forced, plain, plain, other]) == ""
    assert "no column" in word_errors("pcb-drill", [0, forced, other])
    assert "no column" in word_errors("pcb-drill", [0, forced, plain, other])
    assert "no column" in word_errors("pcb-drill", [0, 0x07])
    assert "no column" in word_errors("pcb-drill", [0, forced, plain | 0x40])
    assert "no column" in word_errors("pcb-drill", [0, plain])
    assert "at rest" in word_errors("pcb-drill", [0, forced, forced], cold=2)
    assert "at rest" in word_errors("pcb-drill", [0, forced, forced, forced], longest=2)
    assert "no column" in word_errors("boiler-drum", [0, 0x03, 0x06])
    assert word_errors("eight-axis", [0, 2, 3, 2, 0, 1]) == ""
    assert "direction changes" in word_errors("eight-axis", [0, 3])
    assert "direction changes" in word_errors("eight-axis", [2, 3, 1])


def test_a_drop_in_mid_pulse_still_is_one_whole_pulse() -> None:
    b = Bench(shipped("eight-axis")).queue("KMD_RUCHd x=9")
    b.until(lambda: b.m.axes[0].column_in_step == 1)
    b.ask(Request.ESTOP).tick(3).ask(Request.ACK).tick(2).queue("KMD_RUCHd x=-4")
    b.finish()
    recount = of_shipped("eight-axis")[0].recount(b.images, Watch())
    assert recount.least[-1] == b.m.axes[0].travelled == (1 - 4) * 2
