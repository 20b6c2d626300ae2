"""The cable is pulled while a board is drilled on the real firmware; the job is then gone on with on a new line."""

import json
import time
from itertools import groupby
from pathlib import Path
from typing import Any

import pytest

from drillctl.machine import Library
from drillctl.plant import IdealPlant
from tests.firmware import board as boards
from tests.firmware.board import SimulatedBoard, wait_until
from tests.firmware.job import HOLES_MM, STEPS_PER_MM, drillctl, write_job
from tests.firmware.loop import WiredPlant

pytestmark = [pytest.mark.paced, pytest.mark.skipif(bool(boards.missing()), reason=boards.missing())]

AGAIN_S = 1.0
RUN_S = 60.0
MOST_RESUMES = 3
OF_A_BUSY_COMPUTER = ("LATE_TICK", "PORT_SLOW")  # the latter where the simulated processor falls behind the line
NEAR_STEPS = 10  # where zero was found, and a rotor's rest; the holes are 33 steps apart and more


def test_a_pulled_plug_is_a_lost_port_and_a_new_line_moves_nothing_by_itself(host: Path, tmp_path: Path) -> None:
    plant = IdealPlant(Library.standard().machine(str(write_job(tmp_path))))
    first = SimulatedBoard(host, boards.MEGA, tmp_path)
    try:
        with WiredPlant(first, plant) as before:
            job = ("run", "board.drl", "--machine", "near.toml", "--journal", "j")
            run = drillctl(tmp_path, first.device, *job)
            wait_until(lambda: len(before.touches) == 2 or run.poll() is not None, "the second hole", RUN_S)
            assert run.poll() is None, run.communicate()
            first.pull_the_plug()
        out, err = run.communicate(timeout=RUN_S)
    finally:
        first.close()
    told = json.loads(out)
    assert (run.returncode, told["fault"]["name"], told["position_known"]) == (1, "PORT_LOST", False), err
    assert "can't be known, nor made safe by software" in told["fault"]["cause"]
    second = SimulatedBoard(host, boards.MEGA, tmp_path)
    try:
        with WiredPlant(second, plant) as after:
            time.sleep(AGAIN_S)
            assert not any(level for _, pin, level in second.changes() if pin in range(16, 40)), "it moved by itself"
            told, err = resume(tmp_path, second.device)
    finally:
        second.close()
    assert told["holes_done"] == len(HOLES_MM), err
    assert "hole 2 " in err and "was cut off; it is drilled again" in err
    drilled = [nearest(place) for place in before.touches + after.touches]
    assert drilled[:3] == [1, 2, 2] and [number for number, _ in groupby(drilled)] == [1, 2, 3, 4]


def resume(folder: Path, device: str) -> tuple[dict[str, Any], str]:
    """Until it is done: the outcome, and what was said. The new line has another name, which --elsewhere allows.
    A computer too busy for its ticks may cut it off again.
    """
    said = ""
    for _ in range(MOST_RESUMES):
        run = drillctl(folder, device, "resume", "j", "--elsewhere")
        out, err = run.communicate(timeout=RUN_S)
        said += err
        told = json.loads(out)
        if run.returncode == 0:
            break
        assert told["fault"]["name"] in OF_A_BUSY_COMPUTER, out
    return told, said


def nearest(place: tuple[float, float]) -> int | None:
    """The number of the hole that the bit met, None where there is none."""
    for number, hole_mm in enumerate(HOLES_MM, start=1):
        if all(abs(at - mm * STEPS_PER_MM) <= NEAR_STEPS for at, mm in zip(place, hole_mm, strict=True)):
            return number
    return None
