"""A board with a converter whose line is cut: nobody is there, so the job ends by itself, and is resumed with the same
converter.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from drillctl.jobs.operator import HoldLimit
from drillctl.kmd import STATUS
from drillctl.machine import Library, shipped_tables
from tests.support.near_file import BOARD, near_text
from tests.ticker.test_converter_run import WITHIN_S, Rig, rigged

MACHINE = Library((shipped_tables(),)).machine("eight-axis")
FAULT = next(1 << line.bit for line in MACHINE.inputs if line.name == "converter_fault")


def start(rig: Rig, *arguments: str) -> "subprocess.Popen[str]":
    environment = {**os.environ, "XDG_STATE_HOME": str(rig.folder / "state")}
    return subprocess.Popen(
        [sys.executable, "-m", "drillctl", *arguments, "--json", "--hold-limit", "2"], cwd=rig.folder, text=True,
        env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


@pytest.mark.paced
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="processes of their own need Linux")
def test_a_job_that_its_converter_holds_ends_and_is_resumed_with_it(tmp_path: Path) -> None:
    slower = re.sub(r"spindle_rev_min = \d+", "spindle_rev_min = 24000", near_text())
    (tmp_path / "near.toml").write_text(slower)
    (tmp_path / "job.drl").write_text(BOARD)
    with rigged(tmp_path) as rig:
        converter = f"delta-gs20:{rig.wire.ours}"
        begun = start(
            rig, "run", "job.drl", "--machine", "near.toml", "--pace", "real", "--journal", "j",
            "--converter", converter, "--spindles", "1",
        )  # fmt: skip
        rig.until(lambda: rig.converter.hz == 400.0)
        rig.wire.cut = True
        out, err = begun.communicate(timeout=WITHIN_S)
        assert begun.returncode == 1, err
        assert "converter_fault held the job for 2 s; it was stopped, and can be resumed" in err
        assert json.loads(out)["interrupted"] and json.loads((tmp_path / "j").read_text().splitlines()[0])["site"][
            "converter"] == converter  # fmt: skip

        rig.wire.cut = False
        rig.converter.writes.clear()
        resumed = start(rig, "resume", "j")
        out, err = resumed.communicate(timeout=WITHIN_S)
        assert resumed.returncode == 0, err
        assert f"as it ran: port simulated, pace real, plant ideal, converter {converter}" in err
        assert json.loads(out)["holes_done"] == 3 and (0x2000, 0x12) in rig.converter.writes


def status(sensors: int, job: int = 1) -> np.void:
    made = np.zeros(1, STATUS)[0]
    made["sensors"], made["job"] = sensors, job
    return made


def test_a_hold_counts_from_the_input_on_and_anew_after_it_was_off() -> None:
    now_s = 100.0
    limit = HoldLimit(MACHINE, 60.0, lambda: now_s)
    for seconds, sensors, job, ends in (
        (0, FAULT, 1, False), (59, FAULT, 1, False), (0, 0, 1, False), (0, FAULT, 1, False), (59.9, FAULT, 1, False),
        (0.1, FAULT, 1, True), (0, FAULT, 0, False), (0, FAULT, 1, False), (0, 0xFFFF, 1, False),
    ):  # fmt: skip
        now_s += seconds
        assert (limit.exceeded(status(sensors, job)) is not None) == ends
