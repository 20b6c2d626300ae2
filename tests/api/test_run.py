"""A run's arrays against what others read of it: its text trace and VCD file, decoded here by their descriptions."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import drillctl

ROOT = Path(__file__).resolve().parent.parent.parent
QUEUES = {
    "pcb-drill": ["KMD_GOTOdXdY 30 -12", "KMD_WIERTLO_DOL", "KMD_WIERTLO_GORA", "KMD_CZEKAJ 5"],
    "pcb-drill-ramp-lab": ["KMD_RUCHd x=9 y=-4", "KMD_CZEKAJ 5"],
    "boiler-drum": ["KMD_RUCHd x=40", "KMD_RUCHd x=-15 y=7"],
    "cnc-shield": ["KMD_RUCHd x=40", "KMD_RUCHd x=-15 y=7"],
    "eight-axis": ["KMD_RUCHd x=40", "KMD_RUCHd x=-15 y=7 z6=3"],
}


def words_of_trace(file: Path) -> dict[str, list[int]]:
    """The values of the signals that are numbers, one a tick (docs/TRACES.md)."""
    head, _, body = file.read_text("utf-8").partition("\n\n")
    names = [line.split()[1] for line in head.splitlines() if line.startswith("signal ")]
    changes = [line.split(" ", 2) for line in body.splitlines() if not line.startswith(("end ", "#"))]
    end = int(body.rpartition("end ")[2].split()[0])
    values: dict[str, list[int]] = {name: [] for name in names if name.startswith(("in.", "out."))}
    for name, found in values.items():
        for tick, changed, value in changes:
            if changed == name:
                found.extend(found[-1:] * (int(tick) - len(found)) + [int(value, 16)])
        found.extend(found[-1:] * (end - len(found)))
    return values


def values_of_vcd(file: Path, ticks: int, tick_hz: int) -> dict[str, list[int]]:
    """Every whole number of a VCD file, one a tick: ``scope.name``."""
    names: dict[str, str] = {}
    found: dict[str, list[int]] = {}
    scope, units_a_tick, tick = "", 0.0, 0
    for words in map(str.split, file.read_text("utf-8").splitlines()):
        match words:
            case ["$timescale", count, unit, "$end"]:
                units_a_tick = 1 / (int(count) * {"s": 1, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}[unit] * tick_hz)
            case ["$scope", _, name, "$end"]:
                scope = name
            case ["$var", "integer" | "wire", _, code, name, "$end"]:
                names[code], found[f"{scope}.{name}"] = f"{scope}.{name}", []
            case [time] if time.startswith("#"):
                tick = round(int(time[1:]) / units_a_tick)
                for values in found.values():
                    values.extend(values[-1:] * (tick - len(values)))
            case [value, code] if value.startswith("b") and code in names:
                bits = value[1:]
                found[names[code]][tick:] = [int(bits, 2) - (1 << 32 if len(bits) == 32 and bits[0] == "1" else 0)]
            case [change] if change[0] in "01" and change[1:] in names:
                found[names[change[1:]]][tick:] = [int(change[0])]
    for values in found.values():
        values.extend(values[-1:] * (ticks - len(values)))
    return found


def wiring(machine: str, axis: str) -> dict[str, int]:
    """Bits of an axis's wires, as the machine's file has them."""
    text = (ROOT / "tables" / "machines" / f"{machine}.toml").read_text("utf-8")
    wires = tomllib.loads(text)["wiring"].items()
    return {name.partition(".")[2]: bit for name, bit in wires if name.startswith(f"{axis}.")}


@pytest.mark.parametrize("machine", QUEUES)
def test_arrays_say_what_the_files_say(machine: str, tmp_path: Path) -> None:
    run = drillctl.run(QUEUES[machine], machine)
    run.save(tmp_path / "run.trace")
    run.save(tmp_path / "run.vcd")
    words = words_of_trace(tmp_path / "run.trace")
    seen = values_of_vcd(tmp_path / "run.vcd", run.ticks, run.machine.tick_hz)
    for name, values in words.items():
        assert run.signal(name).tolist() == values
    images = sum(np.array(words[f"out.{card}"], object) << 32 * card for card in range(run.machine.cards))
    for axis in run.machine.axis_names:
        assert run.columns(axis).tolist() == seen[f"{axis}.column"]
        assert run.positions(axis).tolist() == seen[f"{axis}.position"]
        assert run.states(axis).tolist() == seen[f"{axis}.state"]
        bits, wires = wiring(machine, axis), run.wires(axis)
        assert sorted(run.wire_names(axis)) == sorted(bits)
        for lane, name in enumerate(run.wire_names(axis)):
            by_word = [int(image) >> bits[name] & 1 for image in images]
            assert wires[:, lane].astype(int).tolist() == by_word == seen[f"{axis}.{name}"]


@pytest.mark.parametrize("plant", ["ideal", "dynamic"])
def test_a_drive_lags_behind_its_pulses_whichever_way_it_goes(plant: str) -> None:
    """Two columns do not tell the way, the direction wire does."""
    run = drillctl.run(["KMD_RUCHd x=200", "KMD_RUCHd x=-150", "KMD_CZEKAJ 1200"], "eight-axis", plant=plant)
    lag = run.lag("x") / 4  # pulses
    assert abs(lag[-1]) < 1 < lag.max() < 40 and lag.min() < -1


def test_what_a_run_keeps_can_not_be_written_to() -> None:
    run = drillctl.run("KMD_GOTOdXdY 3 0", plant="dynamic")
    for kept in (run.time_s, run.holes, run.currents("x"), run.speed("x")):
        with pytest.raises(ValueError, match="read-only"):
            kept[:] = 0
    positions = run.positions("x")
    positions[:] = 7
    assert run.positions("x").tolist() != positions.tolist()


def test_a_run_is_shown_in_a_line(tmp_path: Path) -> None:
    run = drillctl.run("KMD_GOTOdXdY 30 0", plant="dynamic")
    assert repr(run) == "<Run of commands on pcb-drill, dynamic plant: 52 ticks, no fault>"
    assert repr(run.job) == "<Job commands for pcb-drill: 2 commands, 0 holes>"
    run.save(tmp_path / "run.trace")
    verdict = drillctl.replay_trace(tmp_path / "run.trace")
    assert verdict.headline() == "no tick differs" and len(repr(verdict)) < 200


def test_a_run_that_can_not_be_saved_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "old.trace").write_text("old")
    without = drillctl.run("KMD_KONIEC", trace=False)
    with_record = drillctl.run("KMD_KONIEC")
    for run, name in ((without, "old.trace"), (with_record, "run.png"), (with_record, "missing/run.trace")):
        with pytest.raises(drillctl.Refused):
            run.save(tmp_path / name)
    assert [file.name for file in tmp_path.iterdir()] == ["old.trace"]
    assert (tmp_path / "old.trace").read_text() == "old"


@pytest.mark.parametrize(
    ("machine", "options", "spindles"),
    [("pcb-drill", {"peck": 0.5}, {1}), ("eight-axis", {}, {1, 2, 3, 4, 5, 6}),
     ("eight-axis", {"spindles": (2, 5)}, {2, 5})],
)  # fmt: skip
def test_a_board_is_the_same_run_in_its_trace(
    machine: str, options: dict[str, object], spindles: set[int], tmp_path: Path
) -> None:
    """What its commands say, the feeds of single heads among it, is all in the text of the trace."""
    run = drillctl.run(ROOT / "examples" / "blinker.drl", machine, skip_tools=(1, 2), **options)
    assert run.fault is None and set(run.holes["spindle"].tolist()) == spindles
    assert {axis: run.positions(axis)[-1] for axis in run.machine.axis_names} == run.outcome.position
    run.save(tmp_path / "board.trace")
    assert drillctl.replay_trace(tmp_path / "board.trace").difference is None
