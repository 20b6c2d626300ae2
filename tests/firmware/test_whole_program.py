"""From a queue of commands to the AVR's pins: the whole program, paced, on the simulated Mega with real firmware."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from drillctl.trace import read_text
from tests.firmware import board as boards
from tests.firmware.board import SimulatedBoard

pytestmark = pytest.mark.skipif(bool(boards.missing()), reason=boards.missing())

QUEUE = "KMD_GOTOdXdY 300 200\nKMD_RUCHd z=100\nKMD_GOTOdXdY -300 -200\n"
MOTOR_PINS = range(16, 40)
SENSOR_PINS = range(40, 46)
PORTS = (2, 3, 4)  # x, y, z: a byte of the image each


def updates_of(trace: Path) -> list[tuple[int, int]]:
    """(Firmata port, value) for each byte of the output image that changed, in order."""
    _, words = read_text(trace).changes_of("out.0")
    updates, before = [], 0
    for word in map(int, words):
        for place, port in enumerate(PORTS):
            byte = word >> 8 * place & 0xFF
            if byte != before >> 8 * place & 0xFF:
                updates.append((port, byte))
        before = word
    return updates


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
        sent = updates_of(trace)
        seen = arduino.port_updates(MOTOR_PINS, since=0)
        starts = [at for at in range(len(seen)) if seen[at : at + len(sent)] == sent]
        assert len(sent) > 600 and len(starts) == 1
        assert {value for _, value in seen[starts[0] + len(sent) :]} == {0}
        assert not any(arduino.levels()[pin] for pin in MOTOR_PINS)
    finally:
        arduino.close()
