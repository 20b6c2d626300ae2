"""Tuning: the ramp found loses nothing on the load asked for, every change of it does or is slower, and it lands."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.execution.axis import Axis
from drillctl.lab import ramp_trials
from drillctl.lab.errors import LabError
from drillctl.lab.ramp_trials import Bench
from drillctl.lab.retargeting import first_missed, targets_tried
from drillctl.lab.tune import Profile, Tuned, _faster, ramp_of, ramp_text, tune
from drillctl.machine import Library, shipped_tables
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_file import read_ramp

LIBRARY = Library((shipped_tables(),))
LAB = LIBRARY.machine("pcb-drill-ramp-lab")
BENCH = Bench(LAB.axes[0], 500, 1.2)
RAMPS = [read_ramp(file) for file in sorted((shipped_tables() / "ramp").glob("*.toml"))]


def profile_of(ramp: RampTable) -> Profile:
    return ramp.interval[: ramp.top + 1]


@pytest.fixture(scope="module")
def quick(request: pytest.FixtureRequest) -> None:
    """Fewer moves, loads and columns: a search of some seconds."""
    patch = pytest.MonkeyPatch()
    request.addfinalizer(patch.undo)
    patch.setattr(ramp_trials, "SHORT", (1, 10))
    patch.setattr(ramp_trials, "starts", lambda axis: range(1))
    patch.setattr(ramp_trials, "PROOF_STEPS", 6)
    patch.setattr(ramp_trials, "PROOF_LOADS", 2)
    patch.setattr(ramp_trials, "PROOF_COLUMNS", 120)
    patch.setattr("drillctl.lab.tune.DWELLS", (1,))
    patch.setattr("drillctl.lab.tune.CRUISES", (2, 3))
    patch.setattr("drillctl.lab.tune.SLOWEST", 2)


@pytest.fixture(scope="module")
def tuned(quick: None) -> Tuned:
    return tune(BENCH, "found")


def test_the_ramp_found_is_faster_than_the_one_that_was_and_loses_nothing(tuned: Tuned, quick: None) -> None:
    assert tuned.proof.lost_at_steps is None and tuned.proof.worst_full_steps < 1 and tuned.proof.trials > 300
    assert tuned.mean_ticks < tuned.mean_ticks_before
    assert BENCH.losing([tuned.ramp]) == [False] and BENCH.proof(tuned.ramp) == tuned.proof


def test_no_single_change_is_faster_and_loses_nothing(tuned: Tuned, quick: None) -> None:
    faster = [ramp_of("next", each) for _, each in _faster(BENCH, profile_of(tuned.ramp), tuned.mean_ticks)]
    assert faster and all(BENCH.losing(faster))
    assert all(BENCH.mean_ticks(ramp) < tuned.mean_ticks for ramp in faster)


def test_a_ramp_that_is_too_bold_is_found_out(quick: None) -> None:
    """At full speed from the first step; and the same ramp on a load that the motor can't carry."""
    direct, gentle = ramp_of("direct", (1, 1)), ramp_of("gentle", (2, 1))
    assert BENCH.losing([direct, gentle]) == [True, False]
    assert Bench(BENCH.axis, 500, 5.0).losing([gentle]) == [True]
    assert BENCH.proof(direct).lost_at_steps is not None


def test_the_file_is_the_ramp_with_its_evidence(tuned: Tuned, tmp_path: Path) -> None:
    file = tmp_path / "found.toml"
    file.write_text(ramp_text(tuned, BENCH, LAB))
    assert read_ramp(file) == tuned.ramp
    comments = " ".join(line for line in file.read_text().splitlines() if line.startswith("#"))
    for evidence in ("pcb-drill-ramp-lab", "500 Hz", "1.2 times", f"{tuned.proof.trials} moves", "not on a machine"):
        assert evidence in comments
    assert LIBRARY.check(file) == []


@pytest.mark.parametrize("profile", [(3, 1), (7, 4, 2, 1), (9, 9, 5, 5, 5, 2), (12, 8, 6, 5, 4, 3, 3, 2, 2, 1)])
def test_every_profile_makes_a_ramp_that_lands(profile: Profile) -> None:
    ramp = ramp_of("made", profile)
    assert ramp.first_inexact() is None and first_missed(ramp, LAB.axes[0]) is None
    assert profile_of(ramp) == profile and ramp.interval[-1] == profile[1]
    assert targets_tried(ramp) > 100


@pytest.mark.parametrize("ramp", [ramp for ramp in RAMPS if ramp.top < 20], ids=lambda ramp: ramp.name)
def test_the_shipped_ramps_land_on_new_targets(ramp: RampTable) -> None:
    assert first_missed(ramp, LAB.axes[0]) is None


def test_a_ramp_that_misses_a_new_target_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """An automaton that calls any state rest loses its count of where it should stop."""

    def rest(ramp: RampTable, state: int, direction: int, to_go: int, may_rise: bool) -> int:
        return 0 if to_go <= 3 else state + direction * (state == 0)

    monkeypatch.setattr(RampTable, "after_step", rest)
    settle = Axis._settle

    def settle_and_rest(axis: Axis) -> None:
        settle(axis)
        if axis.state == 0:
            axis._rest()

    monkeypatch.setattr(Axis, "_settle", settle_and_rest)
    assert first_missed(RAMPS[0], LAB.axes[0]) is not None


def test_no_ramp_can_save_a_motor_that_is_too_weak(quick: None) -> None:
    with pytest.raises(LabError, match="loses steps however gently it starts"):
        tune(Bench(BENCH.axis, 2000, 5.0), "found")


@pytest.mark.parametrize(
    ("bench", "reason"),
    [
        (lambda: Bench(LIBRARY.machine("mega-28byj48").axes[0], 500, 1.3), "no dynamics"),
        (lambda: Bench(BENCH.axis, 20, 1.3), "20 Hz is outside 50 to 20000"),
    ],
)
def test_what_can_not_be_tuned_is_refused(bench: Callable[[], Bench], reason: str) -> None:
    with pytest.raises(LabError, match=reason):
        bench()


def test_the_verb_writes_once(
    tuned: Tuned, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The search itself is tried above."""
    ramp = replace(tuned.ramp, name="mine")
    monkeypatch.setattr("drillctl.lab.tune.tune", lambda bench, name, told: replace(tuned, ramp=ramp))
    out = tmp_path / "ramps" / "mine.toml"
    call = ["tune", "pcb-drill-ramp-lab", "--margin", "1.2", "--name", "mine", "--out", str(out)]
    assert main(call) == 0
    written = out.read_bytes()
    assert read_ramp(out).name == "mine" and 'ramp = "mine"' in capsys.readouterr().out
    assert main(call) == 2
    assert "is there already" in capsys.readouterr().err and out.read_bytes() == written
    assert [file.name for file in out.parent.iterdir()] == ["mine.toml"]


def test_the_verb_refuses_a_name_that_is_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["tune", "pcb-drill", "--name", "../x", "--out", str(tmp_path / "x.toml")]) == 2
    assert "can't name a table" in capsys.readouterr().err and not list(tmp_path.iterdir())


@pytest.mark.long
def test_a_whole_search() -> None:
    """With the margin that is the default."""
    bench = replace(BENCH, margin=1.3)
    found = tune(bench, "found")
    assert found.proof.lost_at_steps is None and found.mean_ticks < found.mean_ticks_before
