"""Runs kept in segments: the same run as the text form has, small, replayed, and judged by other tables."""

import shutil
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from drillctl.cli import main
from drillctl.kmd import RECORD, Op
from drillctl.machine import Library, shipped_tables
from drillctl.replay.compare import replay
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.forecast import forecast
from drillctl.trace import Segments, Signal, Trace, read_segments, segment_bytes
from drillctl.trace.files import read_trace
from drillctl.trace.segments import MOST_STRIP_TICKS

ROOT = Path(__file__).resolve().parents[2]
LIBRARY = Library((shipped_tables(),))
SQUARE = str(ROOT / "examples" / "square.kmd")


def run(*arguments: str) -> None:
    assert main(["run", *arguments]) == 0


def test_both_forms_tell_the_same_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text, segments, again, back = (tmp_path / name for name in ("a.trace", "a.seg", "b.seg", "b.trace"))
    run(SQUARE, "--trace", str(text), "--engine", "tick")
    run(SQUARE, "--trace", str(segments))
    assert read_trace(segments) == read_trace(text)
    assert main(["convert", str(text), "--to", str(again)]) == main(["convert", str(segments), "--to", str(back)]) == 0
    assert again.read_bytes() == segments.read_bytes() and back.read_bytes() == text.read_bytes()
    assert len(segments.read_bytes()) * 20 < len(text.read_bytes())
    for engine in ("tick", "fast"):
        assert main(["replay", str(text), str(segments), "--engine", engine]) == 0
    assert capsys.readouterr().out.count(": same, ") == 4


def test_a_run_that_was_ticked_is_kept_in_segments_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "a.seg"
    run(SQUARE, "--trace", str(file), "--engine", "tick")
    assert main(["replay", str(file)]) == 0


def test_other_tables_are_judged_and_the_first_tick_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, tables = tmp_path / "a.seg", tmp_path / "tables"
    run(SQUARE, "--trace", str(file))
    shutil.copytree(ROOT / "tables", tables)
    phase = tables / "phase" / "two-phase-forced.toml"
    phase.write_text(phase.read_text("utf-8").replace("x.....x.....", "xx....x....."), "utf-8")
    capsys.readouterr()
    assert main(["replay", str(file), "--tables", str(tables)]) == 1
    assert "first difference at tick " in capsys.readouterr().out


def test_the_verdict_is_the_text_forms(tmp_path: Path) -> None:
    """A tick in the middle of the file changed: both forms name it."""
    file = tmp_path / "a.seg"
    run(SQUARE, "--trace", str(file))
    kept = read_segments(file)
    wrong = Segments(kept.rest, kept.signals, kept.images(0, kept.end), Segments.of_trace(kept.trace()).tapes)
    wrong.pool[5000] ^= 1
    file.write_bytes(segment_bytes(wrong))
    difference = replay(file, LIBRARY).difference
    assert difference is not None and difference.tick == 5000


def test_a_large_board_is_a_small_file() -> None:
    """1000 holes in a tenth of what 10,000 may take, with their program; and the file says where the wires were."""
    rng, holes = np.random.default_rng(720), 1000
    program = np.zeros(3 * holes + 2, RECORD)
    program["opcode"][[0, -1]] = Op.INICJALIZACJA, Op.KONIEC
    go = program[1:-1].reshape(holes, 3)
    go["opcode"], go["flags"][:, 0], go["axes"][:, 0] = (Op.GOTO_X_Y, Op.WIERTLO_DOL, Op.WIERTLO_GORA), 1, 3
    go["args"][:, 0, :2] = rng.integers(0, (4724, 3780), (holes, 2))
    program["sequence"] = np.arange(1, len(program) + 1)
    machine = LIBRARY.machine("pcb-drill")
    ticker = FastTicker.ideal(machine, taped=True)
    ticker.queue.put(program)
    while not (ticker.turn(ticker.over) and ticker.over()):
        pass
    places = enumerate(go["args"][:, 0, :2].tolist(), 1)
    segments = ticker.record([("command", f"{n} KMD_GOTO_X_Y {x} {y}") for n, (x, y) in places])
    assert isinstance(segments, Segments)
    assert len(segment_bytes(segments)) < 32_000  # of which a constant 5,000
    assert segments.end == forecast(program, machine).total_ticks
    everything = segments.images(0, segments.end)
    for tick in rng.integers(0, segments.end, 200).tolist():
        assert segments.images(tick, tick + 1)[0] == everything[tick]


def test_a_machine_of_three_cards_is_told_before_it_moves(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    machine = tmp_path / "wide.toml"
    text = (ROOT / "tables" / "machines" / "pcb-drill.toml").read_text("utf-8")
    machine.write_text(text.replace('"x.1a" = 0', '"x.1a" = 64'), "utf-8")
    assert main(["run", SQUARE, "--machine", str(machine), "--trace", str(tmp_path / "a.seg")]) == 2
    assert "segments hold the outputs of 2 cards" in capsys.readouterr().err
    assert not (tmp_path / "a.seg").exists()


def test_the_fast_engine_says_where_it_may_not(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    dynamic = ["--plant", "dynamic", "--vcd", str(tmp_path / "a.vcd")]
    assert main(["run", SQUARE, "--engine", "fast", *dynamic]) == 2
    assert "on the dynamic plant it writes no --vcd" in capsys.readouterr().err


def test_segments_of_any_number_of_changes_become_text_a_stretch_at_a_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The text is that of a run that was ticked, wherever the stretches are cut; a part can be replayed."""
    file, whole, ticked, part = (tmp_path / name for name in ("a.seg", "a.trace", "ticked.trace", "part.trace"))
    run(SQUARE, "--trace", str(file))
    run(SQUARE, "--trace", str(ticked), "--engine", "tick")
    monkeypatch.setattr("drillctl.trace.files.MOST_CHANGES", 0)
    for stretch_ticks in (1 << 17, 997, 64):
        monkeypatch.setattr("drillctl.trace.segments.STRETCH_TICKS", stretch_ticks)
        assert main(["convert", str(file), "--to", str(whole)]) == 0
        assert whole.read_bytes() == ticked.read_bytes()
    assert main(["convert", str(file), "--to", str(part), "--to-tick", "300"]) == 0
    assert part.read_text().splitlines()[-1] == "end 300"
    assert main(["replay", str(part)]) == main(["replay", str(file)]) == 0


def test_a_ticked_run_of_more_ticks_than_segments_hold_is_refused_before_it_moves(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("wait.kmd").write_text(f"KMD_CZEKAJ {MOST_STRIP_TICKS}\n")
    assert main(["run", "wait.kmd", "--plant", "dynamic", "--trace", "a.seg"]) == 2
    out, err = capsys.readouterr()
    assert not out and f"ticks; a trace has room for {MOST_STRIP_TICKS}" in err
    assert [path.name for path in tmp_path.iterdir()] == ["wait.kmd"]


def test_the_longest_strip_is_written_and_read(tmp_path: Path) -> None:
    """In 64 bits, with a change every tick that no packing makes small."""
    words = np.random.default_rng(1).integers(0, 1 << 32, MOST_STRIP_TICKS)
    ticks = np.arange(MOST_STRIP_TICKS)
    cards = [Signal("out.0", "word", False), Signal("out.1", "word", False)]
    trace = Trace.of_changes([], cards, ticks, np.zeros(len(ticks), np.int32), words, MOST_STRIP_TICKS)
    (tmp_path / "a.seg").write_bytes(segment_bytes(Segments.of_trace(trace)))
    assert read_segments(tmp_path / "a.seg").end == MOST_STRIP_TICKS


@pytest.mark.parametrize("kept", ["--trace=a.trace", "--trace=a.seg", "--vcd=a.vcd"])
def test_a_run_of_more_ticks_than_a_trace_holds_is_refused_before_it_moves(
    kept: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("wait.kmd").write_text("KMD_CZEKAJ 2147483647\n")
    assert main(["run", "wait.kmd", kept]) == 2
    out, err = capsys.readouterr()
    assert not out and "wait.kmd: 2147483648 ticks; a trace has room for 100000000" in err
    assert [path.name for path in tmp_path.iterdir()] == ["wait.kmd"]
    assert main(["run", "wait.kmd"]) == 0


def test_a_long_queue_of_long_waits_is_refused_without_being_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A wait takes 4 MiB of a record, and all of them would take 400."""
    monkeypatch.chdir(tmp_path)
    Path("waits.kmd").write_text("KMD_CZEKAJ 2147483647\n" * 100)
    tracemalloc.start()
    try:
        assert main(["run", "waits.kmd", "--trace=a.seg"]) == 2
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert "a trace has room for 100000000" in capsys.readouterr().err and peak < 100 * 2**20
