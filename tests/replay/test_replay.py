"""A recorded run again: the same tables give the same trace; others are judged by what they do."""

from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.machine import Library
from drillctl.replay.compare import record_again, replay
from drillctl.trace import TraceError, read_text

QUEUE = "KMD_INICJALIZACJA\nKMD_GOTO_X_Y 60 40\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\nKMD_LINIAd x=30 y=-7\n"
LIBRARY = Library.standard()
SHIPPED = Path(__file__).resolve().parents[2] / "tables"


@pytest.fixture
def trace(tmp_path: Path) -> Path:
    (tmp_path / "job.kmd").write_text(QUEUE)
    assert main(["run", str(tmp_path / "job.kmd"), "--trace", str(tmp_path / "job.trace")]) == 0
    return tmp_path / "job.trace"


def changed(trace: Path, old: str, new: str) -> Path:
    text = trace.read_text()
    assert old in text
    trace.write_text(text.replace(old, new, 1))
    return trace


def other_tables(folder: Path, kind: str, name: str, old: str, new: str) -> Library:
    """The shipped tables with one replacement in one of them, in front of the shipped ones."""
    text = (SHIPPED / kind / f"{name}.toml").read_text("utf-8")
    assert old in text
    (folder / kind).mkdir(parents=True)
    (folder / kind / f"{name}.toml").write_text(text.replace(old, new), "utf-8")
    return Library.standard(folder)


def test_same_tables_same_trace(trace: Path) -> None:
    verdict = replay(trace, LIBRARY)
    assert verdict.difference is None and verdict.same_tables
    assert verdict.actual == verdict.recorded
    assert "other tables" not in verdict.remark()


def test_a_changed_output_is_named_with_tick_and_command(trace: Path) -> None:
    recorded = read_text(trace)
    ticks, values = recorded.changes_of("out.0")
    tick, value = int(ticks[20]), int(values[20])
    changed(trace, f"\n{tick} out.0 0x{value:08x}", f"\n{tick} out.0 0x{value ^ 1:08x}")
    verdict = replay(trace, LIBRARY)
    assert verdict.difference is not None and verdict.difference.tick == tick
    assert "KMD_INICJALIZACJA" in verdict.message()


@pytest.mark.parametrize("engine", ["tick", "fast"])
def test_from_a_tick_on_the_next_difference_counts_and_none_before(trace: Path, engine: str) -> None:
    recorded = read_text(trace)
    ticks, values = recorded.changes_of("out.0")
    places = [int(ticks[20]), int(ticks[900])]
    for tick, value in zip(places, (int(values[20]), int(values[900])), strict=True):
        changed(trace, f"\n{tick} out.0 0x{value:08x}", f"\n{tick} out.0 0x{value ^ 1:08x}")
    for from_tick, found in ((0, 0), (places[0], 0), (places[0] + 40, 1), (places[1], 1), (places[1] + 40, None)):
        difference = replay(trace, LIBRARY, engine, from_tick).difference
        assert (difference and difference.tick) == (None if found is None else places[found])


def test_a_tick_behind_the_end_is_refused(trace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    end = read_text(trace).end
    assert main(["replay", str(trace), "--from-tick", str(end - 1)]) == 0
    assert f", judged from tick {end - 1} on" in capsys.readouterr().out
    assert main(["replay", str(trace), "--from-tick", str(end)]) == 2
    assert f"no tick {end}: it has {end} ticks" in capsys.readouterr().err


def test_another_ramp_differs_in_the_first_move_that_it_changes(trace: Path, tmp_path: Path) -> None:
    library = other_tables(tmp_path / "t", "ramp", "seven-state", "interval = 4", "interval = 5")
    verdict = replay(trace, library)
    assert not verdict.same_tables and verdict.failed()
    assert "recorded with other tables" in verdict.remark()


def test_other_tables_of_the_same_behaviour_pass_unless_asked_for(trace: Path, tmp_path: Path) -> None:
    old = "longest_drilling_s = 18"
    library = other_tables(tmp_path / "t", "machines", "pcb-drill", old, "longest_drilling_s = 19")
    verdict = replay(trace, library)
    assert not verdict.failed() and not verdict.same_tables
    assert verdict.failed(same_tables_wanted=True)


def test_record_again_makes_a_golden_of_the_new_tables(trace: Path, tmp_path: Path) -> None:
    library = other_tables(tmp_path / "t", "ramp", "seven-state", "interval = 4", "interval = 5")
    record_again(trace, library)
    verdict = replay(trace, library)
    assert not verdict.failed(same_tables_wanted=True)


def test_record_again_with_the_same_tables_changes_no_byte(trace: Path) -> None:
    before = trace.read_bytes()
    record_again(trace, LIBRARY)
    assert trace.read_bytes() == before


def test_requests_are_played_again(trace: Path) -> None:
    """A hold put into the middle of a move must show in the outputs, soon after."""
    head, _, body = trace.read_text().partition("\n\n")
    names = [line.split()[1] for line in head.splitlines() if line.startswith("signal")]
    changes = [line for line in body.splitlines() if line[0].isdigit()] + ["300 request HOLD", "301 request -"]
    changes.sort(key=lambda line: (int(line.split()[0]), names.index(line.split()[1])))
    trace.write_text("\n".join([head, "", *changes, body.splitlines()[-1]]) + "\n")
    verdict = replay(trace, LIBRARY)
    assert verdict.difference is not None
    assert 300 < verdict.difference.tick < 320


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("machine pcb-drill", "machine no-such", "no machine of this name"),
        ("tick_hz 500", "tick_hz fast", "no tick rate"),
        ("command 2 KMD_GOTO_X_Y 60 40", "command 2 KMD_GOTO_X_Y 60", "KMD_GOTO_X_Y"),
        ("command 2 ", "command 7 ", "not numbered"),
        ("digest ", "digests ", "no 'digest' line"),
    ],
)
def test_a_trace_that_cannot_be_run_is_refused(
    trace: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, reason: str
) -> None:
    changed(trace, old, new)
    assert main(["replay", str(trace)]) == 2
    assert reason in capsys.readouterr().err


def test_a_missing_trace_is_an_error_of_the_file(tmp_path: Path) -> None:
    with pytest.raises(TraceError, match=r"gone\.trace: can't be read"):
        replay(tmp_path / "gone.trace", LIBRARY)


def test_a_machine_of_ones_own_is_found_beside_the_trace(tmp_path: Path) -> None:
    text = (SHIPPED / "machines" / "pcb-drill.toml").read_text("utf-8").replace('"pcb-drill"', '"mine"')
    (tmp_path / "mine.toml").write_text(text, "utf-8")
    (tmp_path / "traces").mkdir()
    (tmp_path / "job.kmd").write_text("KMD_GOTOdXdY 9 -9\n")
    trace = tmp_path / "traces" / "job.trace"
    machine = str(tmp_path / "mine.toml")
    assert main(["run", str(tmp_path / "job.kmd"), "--machine", machine, "--trace", str(trace)]) == 0
    assert "\nmachine ../mine.toml\n" in trace.read_text()
    assert not replay(trace, LIBRARY).failed(same_tables_wanted=True)
