"""From a queue of commands to the AVR's pins: the whole program, paced, on the simulated Mega with real firmware."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from drillctl.trace import read_text
from tests.firmware import board as boards
from tests.firmware.board import SimulatedBoard
from tests.firmware.updates import check_seen, updates_of

pytestmark = [pytest.mark.paced, pytest.mark.skipif(bool(boards.missing()), reason=boards.missing())]

QUEUE = "KMD_GOTOdXdY 300 200\nKMD_RUCHd z=100\nKMD_GOTOdXdY -300 -200\n"
MOTOR_PINS = range(16, 40)
SENSOR_PINS = range(40, 46)


def test_the_traces_images_are_the_pins_images(host: Path, tmp_path: Path) -> None:
    """Every byte that the trace says was put out is seen at the pins, once and in order; afterwards all is low."""
    arduino = SimulatedBoard(host, boards.MEGA, tmp_path)
    try:
        for pin in SENSOR_PINS:
            arduino.set_input(pin, 0)
        (tmp_path / "job.kmd").write_text(QUEUE)
        trace = tmp_path / "job.trace"
        command = [sys.executable, "-m", "drillctl", "run", str(tmp_path / "job.kmd"), "--json", "--tools", "assume"]
        command += ["--port", f"firmata:{arduino.device}", "--trace", str(trace)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        assert done.returncode == 0, done.stderr
        assert json.loads(done.stdout)["steps"] == {"x": 600, "y": 400, "z": 100}
        sent = updates_of(read_text(trace))
        assert len(sent) > 600
        arduino.wait_for_low(MOTOR_PINS)
        check_seen(sent, arduino.port_updates(MOTOR_PINS, since=0))
    finally:
        arduino.close()
