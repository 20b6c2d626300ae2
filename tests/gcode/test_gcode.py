"""Boards as G-code, read back by LinuxCNC's own interpreter: the holes, depths and tools that were meant, and no move
through the board.
"""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import drillctl
from drillctl.cli import main
from drillctl.generation.job import Job

ROOT = Path(__file__).resolve().parents[2]
CACHE = Path(os.environ.get("DRILLCTL_TEST_CACHE", Path.home() / ".cache" / "drillctl-tests")) / "rs274"
RS274 = CACHE / "usr" / "bin" / "rs274"
BOARDS = ("amplifier-inch.drl", "blinker.drl", "panel.drl", "relay.drl")
PLACINGS: tuple[dict[str, object], ...] = (
    {"origin": "file"}, {"mirror": "x", "order": "nearest"}, {"rotate": 90.0}, {"offset": (3.0, 4.0), "peck": 0.7},
    {"spot": 0.3, "order": "optimised"},
)  # fmt: skip
MOVE = re.compile(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED)\((-?[\d.]+), (-?[\d.]+), (-?[\d.]+),")
HALF_STEP_MM = 25.4 / 1200 / 2

pytestmark = pytest.mark.skipif(not RS274.is_file(), reason="no rs274 here (tests/gcode/install.sh fetches it)")


def interpreted(program: Path, tools: int) -> list[str]:
    """The canonical commands of a program."""
    table = program.with_suffix(".tbl")
    table.write_text("".join(f"T{number} P{number} Z0 D1\n" for number in range(1, tools + 1)))
    libraries = ":".join(map(str, [CACHE / "usr" / "lib", *sorted((CACHE / "usr" / "lib").glob("*-linux-gnu"))]))
    call = [str(RS274), "-t", table.name, "-v", "rs274.var", "-g", program.name]
    done = subprocess.run(
        call, cwd=program.parent, env={**os.environ, "LD_LIBRARY_PATH": libraries}, capture_output=True, text=True,
        timeout=60, check=True,
    )  # fmt: skip
    lines = done.stdout.splitlines()
    assert lines[-3].endswith("PROGRAM_END()"), done.stderr
    return lines


def drilled(lines: list[str]) -> tuple[list[tuple[float, float]], set[float]]:
    """Where the bit has gone into the board, in order (spots and pecks of a hole once), and how deep at most."""
    x = y = z = 0.0
    holes: list[tuple[float, float]] = []
    deepest: dict[tuple[float, float], float] = {}
    for line in lines:
        if not (found := MOVE.search(line)):
            continue
        to_x, to_y, to_z = map(float, found.groups()[1:])
        if (to_x, to_y) != (x, y):
            assert z > 0 and to_z > 0 and found[1] == "STRAIGHT_TRAVERSE", f"through the board: {line}"
        if to_z < 0:
            assert found[1] == "STRAIGHT_FEED", f"a rapid into the board: {line}"
            if (to_x, to_y) not in deepest:
                holes.append((to_x, to_y))
            deepest[to_x, to_y] = min(to_z, deepest.get((to_x, to_y), 0.0))
        x, y, z = to_x, to_y, to_z
    return holes, set(deepest.values())


def wanted_mm(job: Job) -> np.ndarray:
    assert job.work is not None
    places: np.ndarray = job.work.steps / [job.machine.axes[axis].steps_per_mm for axis in (0, 1)]
    return np.unique(places.round(4), axis=0) if len(places) != len(np.unique(places, axis=0)) else places


@pytest.mark.parametrize("style", ["grbl", "linuxcnc"])
@pytest.mark.parametrize("board", BOARDS)
def test_boards_are_read_back_to_the_same_holes(board: str, style: str, tmp_path: Path) -> None:
    file = ROOT / "examples" / board
    for number, placing in enumerate(PLACINGS):
        options = [f"--{name}={','.join(map(str, value)) if isinstance(value, tuple) else value}"
                   for name, value in placing.items()]  # fmt: skip
        program = tmp_path / f"{number}.ngc"
        assert main(["convert", str(file), "--to", str(program), "--style", style, "-q", *options]) == 0
        job = drillctl.job(file, **placing)
        assert job.work is not None
        lines = interpreted(program, max(group.number for group in job.work.groups))
        holes, depths = drilled(lines)
        wanted = wanted_mm(job)
        assert len(holes) == len(wanted)
        if len(wanted) == len(job.work.steps):
            assert np.abs(np.array(holes) - wanted).max() <= HALF_STEP_MM + 1e-4
        assert len(depths) == 1 and -5 < depths.pop() < -3
        asked = "PROGRAM_STOP" if style == "grbl" else "CHANGE_TOOL"
        assert sum(asked in line for line in lines) == len(job.work.groups)


@pytest.mark.parametrize("mirror", ["x", "y"])
def test_both_sides_of_a_board_meet_on_their_pins(mirror: str, tmp_path: Path) -> None:
    """The back's program has the front's holes turned over about the middle of the front's pins, and no pins."""
    board = str(ROOT / "examples" / "blinker.drl")
    read: dict[str, np.ndarray] = {}
    for side, options in (("front", []), ("back", ["--mirror", mirror])):
        program = tmp_path / f"{side}.ngc"
        words = ["convert", board, "--to", str(program), "--pins", "3:corners:6", "-q"]
        assert main([*words, *options]) == 0
        read[side] = np.array(drilled(interpreted(program, 4))[0])
    holes, pins = read["front"][:-4], read["front"][-4:]
    axis = "xy".index(mirror)
    holes[:, axis] = pins[:, axis].min() + pins[:, axis].max() - holes[:, axis]
    assert read["back"] == pytest.approx(holes, abs=2e-4)


SLOTS = ((10, 5, 14, 8), (20, 10, 20, 14), (25, 12, 23, 12))


@pytest.mark.parametrize("style", ["grbl", "linuxcnc"])
@pytest.mark.parametrize("peck", [[], ["--peck", "1.5"]])
def test_milled_slots_are_read_back_from_end_to_end(peck: list[str], style: str, tmp_path: Path) -> None:
    """In the board the bit moves by feeds alone, along each slot: in pecks there and back, deeper at its beginning."""
    board, program = tmp_path / "b.drl", tmp_path / "b.ngc"
    lines = "".join(f"X{a}.0Y{b}.0G85X{c}.0Y{d}.0\n" for a, b, c, d in SLOTS)
    board.write_text(f"M48\nMETRIC\nT1C1.0\n%\nT1\nX5.0Y5.0\n{lines}M30\n")
    options = ["--mill", "--origin", "file", "--style", style, *peck]
    assert main(["convert", str(board), "--to", str(program), "-q", *options]) == 0
    x = y = z = 0.0
    cuts: list[tuple[float, ...]] = []
    for line in interpreted(program, 1):
        if not (found := MOVE.search(line)):
            continue
        to_x, to_y, to_z = map(float, found.groups()[1:])
        if (to_x, to_y) != (x, y) and z <= 0:
            assert found[1] == "STRAIGHT_FEED" and to_z == z, f"through the board: {line}"
            cuts.append((x, y, to_x, to_y))
        x, y, z = to_x, to_y, to_z
    there = [tuple(map(float, slot)) for slot in SLOTS]
    back = [(*slot[2:], *slot[:2]) for slot in there]
    before = 2 if peck else 0  # the PCB drill goes 4.2 mm deep
    assert cuts == [way for slot, home in zip(there, back, strict=True) for way in (*[slot, home] * before, slot)]
    assert "F120" in program.read_text()


def test_pecks_are_written_out_and_chips_come_out_between_them(tmp_path: Path) -> None:
    program = tmp_path / "b.nc"
    file = ROOT / "examples" / "blinker.drl"
    assert main(["convert", str(file), "--to", str(program), "--peck", "1", "--skip-tools", "2,3", "-q"]) == 0
    found = [MOVE.search(line) for line in interpreted(program, 1)]
    heights = [float(move[4]) for move in found if move]
    first = heights[heights.index(-1.0) :][:8]
    assert first == [-1.0, 0.5, -2.0, 0.5, -3.0, 0.5, -4.0, 0.5] and heights.count(-1.0) == 16


@pytest.mark.parametrize(
    ("words", "said"),
    [(["examples/square.kmd", "--to", "a.nc"], "only a drill file"),
     (["examples/blinker.drl", "--to", "a.nc", "--style", "fanuc"], "grbl, linuxcnc")],
)  # fmt: skip
def test_what_is_no_board_or_no_style_is_refused(
    words: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    assert main(["convert", *words]) == 2
    assert said in capsys.readouterr().err and not Path("a.nc").exists()
