"""``--plant dynamic`` from end to end: a board drilled with inertia, faults told on the command line, replay."""

import csv
import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Drillctl = Callable[..., "subprocess.CompletedProcess[str]"]
MACHINES = pytest.mark.parametrize("machine", ["pcb-drill", "pcb-drill-ramp-lab"])
DYNAMIC = ("--plant", "dynamic")


def outcome(done: "subprocess.CompletedProcess[str]") -> dict[str, Any]:
    told = json.loads(done.stdout)
    assert isinstance(told, dict)
    return told


def places(file: Path) -> list[tuple[float, float]]:
    with file.open(newline="") as stream:
        return [(float(row["x_mm"]), float(row["y_mm"])) for row in csv.DictReader(stream)]


@MACHINES
def test_a_board_is_drilled_and_nothing_lost(machine: str, drillctl: Drillctl, folder: Path) -> None:
    """The holes are where the bit was: friction leaves each as far from the ideal place as from the last one."""
    call = ("run", "kicad.drl", "--machine", machine, "--json", "--holes")
    ideal, dynamic = drillctl(*call, "ideal.csv"), drillctl(*call, "dynamic.csv", *DYNAMIC)
    assert ideal.returncode == dynamic.returncode == 0
    told = outcome(dynamic)
    assert told["lost_steps"] == {"x": 0, "y": 0, "z": 0} and told["holes_done"] == 3 and told["fault"] is None
    found, wanted = places(folder / "dynamic.csv"), places(folder / "ideal.csv")
    pairs = zip(found, wanted, strict=True)
    off = [abs(a - b) for hole, ideal_hole in pairs for a, b in zip(hole, ideal_hole, strict=True)]
    assert 0 < max(off) < 0.05


@MACHINES
def test_a_blunt_drill_passes_zmax_without_the_lower_sensor(machine: str, drillctl: Drillctl) -> None:
    """The paper's own symptom, and not told to anybody: the motor stalls in the board, the controller counts on."""
    done = drillctl("run", "kicad.drl", "--machine", machine, "--json", *DYNAMIC, "--fault", "blunt=3")
    told = outcome(done)
    assert done.returncode == 1 and told["fault"]["code"] and told["fault"]["name"] == "DRILL_NOT_DOWN"
    assert told["lost_steps"]["z"] > 0 and told["lost_steps"]["x"] == 0 and told["holes_done"] == 0


def test_a_plant_that_can_not_be_had_leaves_no_journal(drillctl: Drillctl, folder: Path) -> None:
    before = sorted(folder.iterdir())
    refused = drillctl("run", "kicad.drl", *DYNAMIC, "--fault", "stuck.no_sensor=1", "--journal", "j")
    assert refused.returncode == 2 and "no_sensor" in refused.stderr
    assert sorted(folder.iterdir()) == before


def test_too_fast_loses_steps_and_the_outcome_says_so(drillctl: Drillctl, folder: Path) -> None:
    """Without a sensor on the way nobody but the plant knows."""
    (folder / "far.kmd").write_text("KMD_RUCHd x=900\n")
    kept, lost = (drillctl("run", "far.kmd", *DYNAMIC, "--tick-hz", hz) for hz in ("500", "700"))
    assert kept.returncode == lost.returncode == 0
    assert "lost steps" not in kept.stdout and "WARNING: lost steps: x " in lost.stdout


def test_the_same_run_gives_the_same_bytes_and_another_seed_others(drillctl: Drillctl, folder: Path) -> None:
    """Trace, VCD with the plant's scope, and holes."""
    outputs = ("--trace", "t.trace", "--vcd", "t.vcd", "--holes", "t.csv")
    kept = []
    for seed in ("1", "1", "2"):
        assert drillctl("run", "hole.kmd", *DYNAMIC, "--seed", seed, *outputs).returncode == 0
        kept.append([(folder / name).read_bytes() for name in outputs[1::2]])
    assert kept[0] == kept[1] and kept[0][0] != kept[2][0]
    assert b"$scope module plant" in kept[0][1]
    assert kept[0][0].split(b"\n")[4:6] == [b"plant dynamic", b"seed 1"]


def test_a_trace_tells_its_plant_and_replays_without_it(drillctl: Drillctl, folder: Path) -> None:
    drillctl("run", "hole.kmd", *DYNAMIC, "--fault", "loose.x=0.4", "--fault", "blunt=0.5", "--trace", "t.trace")
    assert "\nplant dynamic loose.x=0.4 blunt=0.5\nseed 0\n" in (folder / "t.trace").read_text()
    assert drillctl("replay", "t.trace").returncode == 0


def test_a_golden_of_the_dynamic_plant_is_recorded_again_on_it(drillctl: Drillctl, folder: Path) -> None:
    from drillctl.machine import Library
    from drillctl.replay.compare import record_again

    drillctl("run", "hole.kmd", *DYNAMIC, "--fault", "dirty.z_bottom=0.1", "--seed", "3", "--trace", "t.trace")
    before = (folder / "t.trace").read_bytes()
    record_again(folder / "t.trace", Library.standard())
    assert (folder / "t.trace").read_bytes() == before


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        ((*DYNAMIC, "--fault", "blunt"), "fault 'blunt': not known"),
        ((*DYNAMIC, "--port", "gpio", "--tools", "assume"), "a real machine is no plant"),
        ((*DYNAMIC, "--seed", "-1"), "is not a whole number"),
    ],
)
def test_what_is_refused_before_anything_moves(arguments: tuple[str, ...], reason: str, drillctl: Drillctl) -> None:
    done = drillctl("run", "kicad.drl", *arguments, "--json")
    assert done.returncode == 2 and reason in done.stderr
    assert reason in json.loads(done.stdout)["error"]["reason"]


def test_the_faults_are_listed(drillctl: Drillctl) -> None:
    done = drillctl("run", "hole.kmd", "--fault", "list")
    assert done.returncode == 0 and len(done.stdout.splitlines()) == 11
