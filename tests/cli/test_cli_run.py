"""``drillctl run`` as a user sees it: what it prints, what it writes, and that it does so every time alike."""

import csv
import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.vcd_reader import vcdvcd_read

Drillctl = Callable[..., "subprocess.CompletedProcess[str]"]
HALF_STEP_MM = 25.4 / 1200 / 2 + 0.00006  # and the rounding to four decimals
HOLES_MM = [(1, 0.8, 10.16, 30.48), (1, 0.8, 29.21, 30.48), (2, 1.0, 16.51, 52.07)]
FIELDS = [
    "machine", "holes_done", "holes_total", "ticks", "tick_hz", "machine_seconds", "steps", "position",
    "position_known", "lost_steps", "late", "starved", "interrupted", "suspect", "fault",
]  # fmt: skip


def holes(file: Path) -> list[tuple[int, float, float, float]]:
    with file.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert list(rows[0])[:4] == ["tool", "diameter_mm", "x_mm", "y_mm"]
    first = [r for r in rows if r.get("spindle", "1") == "1"]  # the others make the same holes
    return [(int(r["tool"]), float(r["diameter_mm"]), float(r["x_mm"]), float(r["y_mm"])) for r in first]


def assert_drilled(file: Path, half_step_mm: float = HALF_STEP_MM) -> None:
    """Every hole of the board, in its order, within half a step."""
    found = holes(file)
    assert [tool for tool, *_ in found] == [tool for tool, *_ in HOLES_MM]
    for (_, diameter, x, y), (_, wanted_diameter, wanted_x, wanted_y) in zip(found, HOLES_MM, strict=True):
        assert abs(diameter - wanted_diameter) < 0.001
        assert abs(x - wanted_x) <= half_step_mm and abs(y - wanted_y) <= half_step_mm


def test_a_queue_in_json(drillctl: Drillctl) -> None:
    done = drillctl("run", "hole.kmd", "--json")
    assert done.returncode == 0 and done.stderr == ""
    told = json.loads(done.stdout)
    assert list(told) == FIELDS
    assert told["machine"] == "pcb-drill" and told["tick_hz"] == 500
    assert told["machine_seconds"] == told["ticks"] / 500
    assert told["position"] == {"x": 100, "y": 50, "z": 0} and told["position_known"] is True
    assert told["lost_steps"] == {"x": 0, "y": 0, "z": 0}
    assert told["late"] == {"count": 0, "greatest_ms": 0.0} and told["starved"] == 0
    assert told["fault"] is None and told["interrupted"] is False
    assert (told["holes_done"], told["holes_total"]) == (0, 0)
    assert all(steps > 0 for steps in told["steps"].values())


@pytest.mark.parametrize("board", ["kicad.drl", "inch.drl", "lz.drl", "tz.drl", "metric-tz.drl"])
def test_a_board_in_every_format(board: str, drillctl: Drillctl, folder: Path) -> None:
    done = drillctl("run", board, "--json", "--holes", "h.csv")
    assert done.returncode == 0
    told = json.loads(done.stdout)
    assert (told["holes_done"], told["holes_total"]) == (3, 3) and told["fault"] is None
    assert_drilled(folder / "h.csv")


@pytest.mark.parametrize(
    ("options", "half_step_mm"),
    [
        (["--origin", "file"], HALF_STEP_MM),
        (["--tick-hz", "123"], HALF_STEP_MM),
        (["--machine", "pcb-drill-ramp-lab"], 0.127 / 2 + 0.00006),
        (["--machine", "eight-axis"], 0.005 + 0.00006),
    ],
)
def test_wherever_and_however_fast_the_holes_are_the_files(
    options: list[str], half_step_mm: float, drillctl: Drillctl, folder: Path
) -> None:
    done = drillctl("run", "kicad.drl", "--holes", "h.csv", *options)
    assert done.returncode == 0, done.stderr
    assert "3 of 3 holes drilled" in done.stdout
    assert_drilled(folder / "h.csv", half_step_mm)


def test_the_tick_rate_stretches_time_and_nothing_else(drillctl: Drillctl) -> None:
    told = [json.loads(drillctl("run", "hole.kmd", "--json", "--tick-hz", hz).stdout) for hz in ("500", "250")]
    assert [one["tick_hz"] for one in told] == [500, 250]
    assert told[0]["ticks"] == told[1]["ticks"] and 2 * told[0]["machine_seconds"] == told[1]["machine_seconds"]


def test_two_runs_are_alike_to_the_byte(drillctl: Drillctl, folder: Path) -> None:
    kinds = ("trace", "vcd", "csv")
    outputs = []
    for run in ("1", "2"):
        done = drillctl(
            "run", "kicad.drl", "--json", "--trace", f"{run}.trace", "--vcd", f"{run}.vcd", "--holes", f"{run}.csv"
        )
        outputs.append([done.stdout, done.stderr, *((folder / f"{run}.{kind}").read_bytes() for kind in kinds)])
    assert outputs[0] == outputs[1] and all(outputs[0][2:])


def test_a_trace_replays_the_same(drillctl: Drillctl, folder: Path) -> None:
    assert drillctl("run", "hole.kmd", "--trace", "h.trace").returncode == 0
    done = drillctl("replay", "h.trace", "--same-tables")
    assert done.returncode == 0 and done.stderr == ""
    assert done.stdout.startswith("h.trace: same, ") and done.stdout.endswith("ticks on pcb-drill\n")
    assert not [name.name for name in folder.iterdir() if name.name.startswith(".")]


def test_a_vcd_can_be_read(drillctl: Drillctl, folder: Path) -> None:
    done = drillctl("run", "hole.kmd", "--vcd", "h.vcd", "--json")
    vcd = vcdvcd_read(vcd_path=str(folder / "h.vcd"))
    assert vcd.timescale["magnitude"] == 1 and vcd.timescale["unit"] == "ms"
    position = next(name for name in vcd.signals if name.startswith("x.position"))
    assert int(vcd[position].tv[-1][1], 2) == json.loads(done.stdout)["position"]["x"] == 100
    scopes = {name.split(".")[0] for name in vcd.signals}
    assert {"x", "y", "z", "sensors", "kmd", "plant"} <= scopes
    assert any(name.startswith("x.24a") for name in vcd.signals)


def test_another_machine_runs_a_queue(drillctl: Drillctl, folder: Path) -> None:
    (folder / "drum.kmd").write_text("KMD_INICJALIZACJA\nKMD_LINIA x=400 y=90\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\n")
    done = drillctl("run", "drum.kmd", "--machine", "boiler-drum", "--json")
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["machine"] == "boiler-drum"
    assert told["position"] == {"x": 400, "y": 0}  # back by distance, short of its limit switch
    assert told["lost_steps"] == {"x": 0, "y": 0}


def test_a_fault_is_exit_1_with_words(drillctl: Drillctl, folder: Path) -> None:
    (folder / "far.kmd").write_text("KMD_INICJALIZACJA\nKMD_RUCH x=99999\n")
    done = drillctl("run", "far.kmd", "--json")
    fault = json.loads(done.stdout)["fault"]
    assert done.returncode == 1
    assert list(fault) == ["code", "name", "cause", "remedy", "position", "axes"]
    assert (fault["code"], fault["name"], fault["position"]) == (3, "SOFT_LIMIT", "kept")
    plain = drillctl("run", "far.kmd")
    assert plain.returncode == 1
    told = ("FAULT SOFT_LIMIT", fault["cause"], fault["remedy"], "position kept")
    assert all(words in plain.stdout for words in told)


def test_an_absolute_move_before_initialisation_is_a_fault(drillctl: Drillctl, folder: Path) -> None:
    (folder / "q.kmd").write_text("KMD_GOTO_X_Y 5 5\n")
    done = drillctl("run", "q.kmd", "--json")
    told = json.loads(done.stdout)
    assert done.returncode == 1 and told["fault"]["name"] == "HOMING_REQUIRED" and not told["position_known"]


def test_plain_lines_where_nobody_watches(drillctl: Drillctl) -> None:
    """Into a pipe: no colour, no bar, no control character."""
    done = drillctl("run", "kicad.drl")
    assert all(character.isprintable() or character == "\n" for character in done.stdout + done.stderr)
    assert done.stdout.splitlines()[0].startswith("pcb-drill: 3 of 3 holes drilled, ")
    assert done.stdout.splitlines()[1].endswith("(known)")


def test_dangerous_tables_are_warned_about_and_run(drillctl: Drillctl, folder: Path) -> None:
    from drillctl.machine import shipped_tables

    text = (shipped_tables() / "phase" / "two-phase-forced.toml").read_text()
    (folder / "t" / "phase").mkdir(parents=True)
    edited = text.replace('"xxxxxx......"', '"xxxxxxx....."')
    (folder / "t" / "phase" / "two-phase-forced.toml").write_text(edited)
    done = drillctl("run", "hole.kmd", "--tables", "t")
    assert done.returncode == 0
    assert done.stderr == (
        "drillctl: warning: two-phase-forced: column 7: 1a and 1b are both on: the halves of one winding cancel\n"
    )
