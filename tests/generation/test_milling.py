"""Slots that are milled: by the machine's own commands, as far as they go, how fast, and who refuses."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import drillctl
from drillctl.cli import main
from drillctl.generation.order import TravelCost
from drillctl.generation.pcb_drill.milling import is_slot
from drillctl.generation.worklist import driven_ticks
from drillctl.machine import travel_table

CNC = "cnc-shield"
MM_MIN = 120.0  # of its file
HOLES = "T1\nX5.0Y5.0\nX10.0Y5.0G85X14.0Y8.0\nX20.0Y5.0\nX20.0Y10.0G85X20.0Y14.0\nX25.0Y12.0G85X23.0Y12.0\n"
SLOTS = {2: ((10, 5), (14, 8)), 4: ((20, 10), (20, 14)), 5: ((25, 12), (23, 12))}  # by number of the hole


@pytest.fixture
def board(tmp_path: Path) -> Path:
    file = tmp_path / "slots.drl"
    file.write_text(f"M48\nMETRIC\nT1C1.0\n%\n{HOLES}M30\n")
    return file


def in_the_board(run: Any) -> list[np.ndarray]:
    """For each stroke: where X and Y were while the bit was in the board, (ticks, 2), in steps from machine zero."""
    surface = run.machine.board_surface[2]
    inside = run.positions("z") > surface
    edges = np.flatnonzero(np.diff(inside.astype(int)))
    places = np.stack([run.positions("x"), run.positions("y")], axis=1)
    return [places[first + 1 : last + 1] for first, last in zip(edges[::2], edges[1::2], strict=True)]


@pytest.mark.parametrize("peck", [None, 1.0])
def test_the_bit_goes_along_each_slot_and_nowhere_else(board: Path, peck: float | None) -> None:
    job = drillctl.job(board, CNC, mill=True, origin="file", peck=peck)
    run = drillctl.run(job)
    assert run.fault is None and run.outcome.holes_done == run.outcome.holes_total == 5
    assert job.work is not None and is_slot(job.work).tolist() == [number in SLOTS for number in range(1, 6)]
    strokes = [places / 50 for places in in_the_board(run)]
    holes = [places for places in strokes if (np.ptp(places, axis=0) == 0).all()]
    slots = [places for places in strokes if (np.ptp(places, axis=0) > 0).any()]
    assert len(slots) == len(SLOTS) and len(holes) == 2 * (1 if peck is None else 3)
    for places, (begin, end) in zip(slots, SLOTS.values(), strict=True):
        assert places[0].tolist() == list(begin) and places[-1].tolist() == list(end)
        way = np.subtract(end, begin)
        along = (places - begin) @ way / (way @ way)
        off = np.abs((places - begin) @ (-way[1], way[0])) / np.hypot(*way)
        assert off.max() <= 0.5 / 50 * 1.5 and along.min() >= 0 and along.max() <= 1
        turns = np.count_nonzero(np.diff(np.sign(np.diff(along)[np.diff(along) != 0])))
        assert turns == (0 if peck is None else 4), "each pass but the last goes there and back"


def test_the_feed_is_the_machines_whatever_the_direction(board: Path) -> None:
    """Over the whole slot the bit is no faster than the file says, and hardly slower."""
    run = drillctl.run(drillctl.job(board, CNC, mill=True))
    for places in in_the_board(run):
        moved = np.flatnonzero((np.diff(places, axis=0) != 0).any(axis=1))
        if len(moved) > 1:
            way_mm = np.hypot(*(places[moved[-1]] - places[moved[0]])) / 50
            mm_min = way_mm / ((moved[-1] - moved[0]) / run.machine.tick_hz) * 60
            assert 0.85 * MM_MIN <= mm_min <= MM_MIN * 1.001


def test_as_a_queue_and_by_either_engine_it_is_the_same_run(board: Path, tmp_path: Path) -> None:
    queue = tmp_path / "slots.kmd"
    options = ["--machine", CNC, "-q"]
    assert main(["convert", str(board), "--to", str(queue), "--mill", *options]) == 0
    assert "KMD_LINIA x=" in queue.read_text() and "KMD_PREDKOSC 9" in queue.read_text()
    for engine in ("tick", "fast"):
        trace = str(tmp_path / f"{engine}.trace")
        assert main(["run", str(board), "--mill", "--engine", engine, "--trace", trace, *options]) == 0
    assert (tmp_path / "tick.trace").read_bytes() == (tmp_path / "fast.trace").read_bytes()
    of_queue = drillctl.run(drillctl.job(queue, CNC))
    of_board = drillctl.run(drillctl.job(board, CNC, mill=True))
    assert of_queue == of_board and of_queue.fault is None


def test_machines_that_can_not_refuse_and_nothing_is_written(
    board: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for machine in ("pcb-drill", "mega-28byj48"):
        assert main(["run", str(board), "--mill", "--machine", machine, "--holes", str(tmp_path / "h.csv")]) == 2
        told = capsys.readouterr().err
        assert f"{machine} does not mill" in told and "mill_mm_min" in told
    assert not (tmp_path / "h.csv").exists()
    assert main(["estimate", str(board), "--machine", "pcb-drill"]) == 0  # as overlapping holes
    assert "27 holes" in capsys.readouterr().out


def test_both_ends_of_a_slot_must_be_in_reach(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "long.drl"
    file.write_text("M48\nMETRIC\nT1C1.0\n%\nT1\nX10.0Y10.0G85X400.0Y10.0\nM30\n")
    assert main(["run", str(file), "--mill", "--machine", CNC, "--origin", "file"]) == 2
    assert "long.drl:6: hole of tool T1" in capsys.readouterr().err


@pytest.mark.parametrize("spot", [None, 0.2])
def test_the_best_order_counts_where_slots_end(tmp_path: Path, spot: float | None) -> None:
    rng = np.random.default_rng(5)
    lines = [f"X{a:.1f}Y{b:.1f}G85X{a + c:.1f}Y{b + d:.1f}" for a, b, c, d in
             (rng.uniform((0, 0, -5, -5), (60, 40, 5, 5)) for _ in range(12))]  # fmt: skip
    file = tmp_path / "many.drl"
    file.write_text("M48\nMETRIC\nT1C1.0\n%\nT1\n" + "\n".join(lines) + "\nM30\n")
    took = {order: drillctl.estimate(file, CNC, mill=True, order=order, spot=spot, offset=(8.0, 8.0)).ticks
            for order in ("file", "nearest", "optimised")}  # fmt: skip
    assert took["optimised"] <= min(took.values()) and took["nearest"] < took["file"]


def test_the_way_to_a_hole_begins_where_the_slot_before_ends() -> None:
    """There and back along two slots side by side: hardly any way in the air, and a long one if they were holes."""
    machine = drillctl.load_machine(CNC)
    x, y = (travel_table(machine.axes[axis].ramp, 2000, columns_per_step=2) for axis in (0, 1))
    begun, ends = np.array([[0, 0], [1000, 50]]), np.array([[1000, 0], [0, 50]])
    still = np.zeros(2, np.int64)
    along, as_holes = (driven_ticks(begun, left, still, TravelCost(x, y)) for left in (ends, begun))
    assert along == 1 + 2 * int(y[50]) and as_holes == 1 + 2 * int(x[1000])


def test_what_is_left_of_a_board_is_milled_too(board: Path, tmp_path: Path) -> None:
    job = drillctl.job(board, CNC, mill=True, origin="file")
    rest = job.without_holes({1, 2, 3})
    assert rest.work is not None and rest.work.ends.tolist() == [[1000, 700], [1150, 600]]
    run = drillctl.run(rest)
    assert run.fault is None and [len(np.unique(places, axis=0)) > 1 for places in in_the_board(run)] == [True, True]
