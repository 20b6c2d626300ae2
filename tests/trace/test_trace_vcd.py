"""The VCD form, read back by readers that are not ours: vcdvcd, GTKWave's converters, sigrok."""

import io
import shutil
import subprocess
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from vcd import VCDWriter

from drillctl.trace import Recorder, Signal, Trace, VcdVar, dense, stretches, vcd_compiled, vcd_lines, vcd_pages
from drillctl.trace.vcd import write_vcd, write_vcd_run
from tests.support.vcd_reader import vcdvcd_read

LAYOUT = (
    VcdVar("x", "1a", "wire", "out.0", bit=0),
    VcdVar("x", "24a", "wire", "out.0", bit=5),
    VcdVar("x", "position", "integer", "x.position"),
    VcdVar("sensors", "x_min", "wire", "in.0", bit=1, invert=True),
    VcdVar("kmd", "seq", "integer", "kmd", part="seq"),
    VcdVar("kmd", "opcode", "integer", "kmd", part="opcode"),
    VcdVar("kmd", "running", "string", "kmd", part="running"),
    VcdVar("events", "fault", "string", "fault"),
    VcdVar("events", "fault_pl", "string", "fault", labels=("brak", "zakres przekroczony")),
)
WIRES = tuple(var for var in LAYOUT if var.kind == "wire")
NAMES = tuple(f"{var.name}:" for var in WIRES)


def vcd_of(trace: Trace, layout: tuple[VcdVar, ...] = LAYOUT) -> str:
    file = io.StringIO()
    write_vcd(trace, file, layout)
    return file.getvalue()


def written_change_by_change(trace: Trace, layout: tuple[VcdVar, ...]) -> str:
    """The same file as pyvcd alone writes it, one change after the other."""
    file = io.StringIO()
    head = vcd_of(trace, layout).partition("$comment ")[2].partition(" $end")[0]
    writer = VCDWriter(file, timescale="1 ms", date="", comment=head)
    sizes = {"wire": 1, "integer": 32, "string": 1}
    variables = [writer.register_var(var.scope, var.name, var.kind, sizes[var.kind]) for var in layout]
    for tick in range(trace.end):
        for variable, var in zip(variables, layout, strict=True):
            value = trace.value_at(var.source, tick)
            writer.change(variable, tick, (value >> var.bit & 1) ^ var.invert if var.bit is not None else value)
    writer.close(trace.end)
    return file.getvalue()


WIDE = (
    VcdVar("x", "1a", "wire", "out.0", bit=0), VcdVar("y", "1a", "wire", "out.0", bit=1),
    VcdVar("x", "position", "integer", "x.position"), VcdVar("sensors", "x_min", "wire", "out.0", bit=1, invert=True),
)  # fmt: skip
of_wide = st.lists(st.tuples(st.sampled_from([0, 1]), st.integers(1, 1100), st.integers(-3, 70_000)), max_size=40)


@pytest.fixture(params=["numpy", "as it stands", "compiled"])
def form(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each way to write the changes. The loop is cut into pieces by its room, as it is at a long file's megabytes."""
    compiled = vcd_compiled.compiled_form(vcd_lines)
    if request.param == "compiled" and compiled is None:
        pytest.skip("the loop is not compiled here (hatch_build.py)")
    loop = {"numpy": None, "as it stands": vcd_lines, "compiled": compiled}[request.param]
    monkeypatch.setattr(vcd_compiled, "compiled_form", lambda module: loop)
    monkeypatch.setattr(vcd_compiled, "OUT_BYTES", 1)


@pytest.mark.usefixtures("form")
@pytest.mark.parametrize("page_ticks", [1, 7, 1 << 16])
@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(of_wide)
def test_a_page_at_a_time_is_the_same_file_as_a_change_at_a_time(
    page_ticks: int, monkeypatch: pytest.MonkeyPatch, rows: list[tuple[int, int, int]]
) -> None:
    """Whatever the pages and stretches are cut to, and also where times begin to have more digits."""
    monkeypatch.setattr(vcd_pages, "PAGE_TICKS", page_ticks)
    monkeypatch.setattr(vcd_compiled, "PAGE_TICKS", page_ticks)
    monkeypatch.setattr(vcd_pages, "TAIL", 100)
    monkeypatch.setattr(vcd_pages, "TAILS", tuple(f"{rest:02}\n" for rest in range(100)))
    monkeypatch.setattr(stretches, "CHANGES_AT_ONCE", 3)
    signals = [Signal("out.0", "word", False), Signal("x.position", "count", False, True)]
    header = (("machine", "m"), ("tick_hz", "1000"), ("digest", "d"))
    columns = zip(*((tick, index, value & 3 if index == 0 else value) for index, tick, value in rows), strict=True)
    trace = Trace.of_changes(header, signals, *(columns if rows else ((), (), ())), end=1101)
    assert vcd_of(trace, WIDE) == written_change_by_change(trace, WIDE)


def changes(vcd: Any, name: str) -> list[tuple[int, int]]:
    """Times and values of a wire or (in two's complement) an integer, as the other reader found them."""
    values = [(time, int(bits, 2)) for time, bits in vcd[name].tv]
    return [(time, value - (value >> 31 << 32)) for time, value in values]


def at_rate(tick_hz: int, end: int = 7) -> Trace:
    recorder = Recorder([Signal("out.0", "word", stimulus=False)])
    header = (("machine", "two words$.toml"), ("tick_hz", str(tick_hz)), ("digest", "ab"))
    return recorder.finish(end, header)


@pytest.mark.usefixtures("form")
def test_values_as_an_independent_reader_finds_them(trace: Trace) -> None:
    vcd = vcdvcd_read(vcd_string=vcd_of(trace))
    assert changes(vcd, "x.1a") == [(0, 0), (12, 1)]
    assert changes(vcd, "x.24a") == [(0, 0), (12, 1), (20, 0)]
    assert changes(vcd, "x.position") == [(0, 0), (12, -1), (20, -2)]
    assert changes(vcd, "sensors.x_min") == [(0, 1)]
    assert changes(vcd, "kmd.seq") == [(0, 1), (22, 2), (24, 0)]
    assert changes(vcd, "kmd.opcode") == [(0, 1), (22, 2), (24, 0)]
    assert (vcd.timescale["magnitude"], vcd.timescale["unit"]) == (1, "ms")
    assert vcd.endtime == 30


@pytest.mark.usefixtures("form")
def test_strings_head_and_end(trace: Trace) -> None:
    """vcdvcd passes strings over, so these stand as written; blanks are escaped as GTKWave wants it."""
    lines = vcd_of(trace).splitlines()
    assert lines[0] == "$comment drillctl machine=pcb-drill.toml tick_hz=500 digest=0123abcd $end"
    assert "$date" not in "".join(lines)
    assert [line.split()[0] for line in lines if line.startswith("s")] == [
        "sKMD_GOTOdXdY",
        "s-",
        "sbrak",
        "sKMD_KONIEC",
        "s-",
        "sSOFT_LIMIT",
        "szakres\\x20przekroczony",
    ]
    assert lines[-1] == "#30"


@pytest.mark.usefixtures("form")
def test_a_value_without_a_label_is_found_on_the_way() -> None:
    names = Signal("fault", "name", False, names=("-", "ONE", "TWO"))
    frame = Trace.of_changes((("machine", "m"), ("tick_hz", "500"), ("digest", "d")), [names], [], [], [], end=9)
    layout = [VcdVar("events", "fault", "string", "fault", labels=("-", "one"))]
    run = [{0: (np.array([0, 3, 5]), np.array([0, 1, 2]))}]
    with pytest.raises(ValueError, match=r"events\.fault: signal fault has a value without a label"):
        write_vcd_run(frame, [names], run, io.StringIO(), layout)


@pytest.mark.usefixtures("form")
def test_of_several_values_of_one_tick_the_last_is_written() -> None:
    out = Signal("out.0", "word", False)
    frame = Trace.of_changes((("machine", "m"), ("tick_hz", "1000"), ("digest", "d")), [out], [], [], [], end=9)
    file = io.StringIO()
    run = [{0: (np.array([0, 3, 3, 4, 4]), np.array([0, 1, 0, 0, 1]))}]
    write_vcd_run(frame, [out], run, file, [VcdVar("x", "1a", "wire", "out.0", bit=0)])
    assert file.getvalue().endswith("$end\n#4\n1!\n#9\n")


def test_every_variable_is_dumped_at_time_zero(trace: Trace) -> None:
    dumped = vcd_of(trace).partition("#0\n$dumpvars\n")[2].partition("$end")[0]
    assert len(dumped.splitlines()) == len(LAYOUT)
    assert "x" not in dumped.replace("0x", "")


def test_a_run_in_which_no_command_came_is_idle_throughout() -> None:
    recorder = Recorder([Signal("kmd", "command", stimulus=True)])
    trace = recorder.finish(3, (("machine", "m"), ("tick_hz", "500"), ("digest", "d")))
    running = VcdVar("kmd", "running", "string", "kmd", part="running")
    assert "s- !" in vcd_of(trace, (running,)).splitlines()


def test_same_trace_same_bytes(trace: Trace, tmp_path: Path) -> None:
    for name in ("a.vcd", "b.vcd"):
        write_vcd(trace, tmp_path / name, LAYOUT)
    assert (tmp_path / "a.vcd").read_bytes() == (tmp_path / "b.vcd").read_bytes() == vcd_of(trace).encode()


@pytest.mark.parametrize(
    ("tick_hz", "end", "timescale", "end_time"),
    [
        (500, 7, "1 ms", 14),
        (1000, 7, "1 ms", 7),
        (1, 7, "1 ms", 7000),
        (2000, 7, "100 us", 35),
        (4000, 7, "10 us", 175),
        (580, 7, "1 us", 12069),  # 12068.97
        (4167, 7, "1 us", 1680),  # 1679.87
        (128, 1, "1 us", 7812),  # 7812.5: halves go to the even neighbour
        (128, 3, "1 us", 23438),  # 23437.5
        (10**6, 7, "1 us", 7),
    ],
)
def test_timescale_and_rounding(tick_hz: int, end: int, timescale: str, end_time: int) -> None:
    lines = vcd_of(at_rate(tick_hz, end), ()).splitlines()
    assert f"$timescale {timescale} $end" in lines
    assert lines[-1] == f"#{end_time}"


@settings(deadline=None)
@given(st.integers(1, 10**6), st.integers(1, 10**12))
def test_times_are_exact(tick_hz: int, end: int) -> None:
    lines = vcd_of(at_rate(tick_hz, end), ()).splitlines()
    magnitude, unit = next(line for line in lines if line.startswith("$timescale")).split()[1:3]
    unit_us = int(magnitude) * {"us": 1, "ms": 1000}[unit]
    assert int(lines[-1].removeprefix("#")) == round(Fraction(end * 10**6, tick_hz * unit_us))
    tick_us = Fraction(10**6, tick_hz)
    assert unit_us == max((u for u in (1, 10, 100, 1000) if tick_us % u == 0), default=1)


def test_nothing_in_the_head_ends_the_comment() -> None:
    assert vcd_of(at_rate(500), ()).startswith("$comment drillctl machine=two_words_.toml tick_hz=500 digest=ab $end")


@pytest.mark.parametrize(
    ("wrong", "reason"),
    [
        ({"kind": "real"}, "no real can show"),
        ({"kind": "wire", "bit": 32}, "needs a bit"),
        ({"kind": "wire"}, "needs a bit"),
        ({"kind": "string", "part": "seq"}, "part seq"),
        ({"scope": "two words"}, "without blanks"),
    ],
)
def test_a_variable_that_does_not_exist(wrong: dict[str, Any], reason: str) -> None:
    right: dict[str, Any] = {"scope": "x", "name": "y", "kind": "integer", "source": "out.0"}
    with pytest.raises(ValueError, match=reason):
        VcdVar(**(right | wrong))


def test_refusals_leave_no_file(trace: Trace, tmp_path: Path) -> None:
    target = tmp_path / "a.vcd"
    with pytest.raises(ValueError, match=r"out.0 is a word, it has no seq"):
        write_vcd(trace, target, [VcdVar("x", "seq", "integer", "out.0", part="seq")])
    with pytest.raises(ValueError, match="without a label"):
        write_vcd(trace, target, [VcdVar("x", "fault", "string", "fault", labels=("one",))])
    with pytest.raises(KeyError, match=r"out\.9"):
        write_vcd(trace, target, [VcdVar("x", "1a", "wire", "out.9", bit=0)])
    with pytest.raises(ValueError, match="tick_hz '0'"):
        write_vcd(at_rate(0), target, [])
    with pytest.raises(KeyError, match="machine"):
        write_vcd(Recorder([]).finish(1), target, [])
    assert not target.exists()


def run(*command: str) -> str:
    tool = shutil.which(command[0])
    if tool is None:
        pytest.skip(f"{command[0]} is not installed (Debian packages gtkwave and sigrok-cli)")
    done = subprocess.run([tool, *command[1:]], capture_output=True, text=True, timeout=60, check=True)
    return done.stdout


def test_gtkwave_takes_it_and_gives_it_back(trace: Trace, tmp_path: Path) -> None:
    source, fst, back = (tmp_path / name for name in ("a.vcd", "a.fst", "b.vcd"))
    write_vcd(trace, source, LAYOUT)
    run("vcd2fst", str(source), str(fst))
    run("fst2vcd", "-f", str(fst), "-o", str(back))
    ours, theirs = vcdvcd_read(vcd_string=source.read_text()), vcdvcd_read(vcd_string=back.read_text())
    for var in LAYOUT:
        if var.kind != "string":
            name = f"{var.scope}.{var.name}"
            assert changes(theirs, name) == changes(ours, name)
    assert theirs.endtime == ours.endtime == 30
    assert "sSOFT_LIMIT " in back.read_text()


def test_sigrok_samples_it(trace: Trace, tmp_path: Path) -> None:
    """PulseView's reader makes samples of the wires, one a millisecond here: each tick's value, twice."""
    source = tmp_path / "a.vcd"
    write_vcd(trace, source, WIRES)
    shown = run("sigrok-cli", "-i", str(source), "-I", "vcd", "-O", "bits:width=0")
    samples = dict(line.replace(" ", "").split(":") for line in shown.splitlines() if line.startswith(NAMES))
    for var in WIRES:
        bits = (dense(trace, var.source) >> (var.bit or 0)) & 1 ^ var.invert
        assert samples[var.name] == "".join(map(str, np.repeat(bits, 2)))
