"""A board of four holes and a machine to drill it: the shipped one, near to its sensors, so that a run takes seconds.

There is more room behind the sensors than the shipped machine has: on a busy computer the simulated processor, not the
line, says when a sensor answers. Used by tests/firmware alone.
"""

import subprocess
import sys
from pathlib import Path

from drillctl.machine import shipped_tables

BOARD = "M48\nMETRIC\nT1C0.800\nT2C1.000\n%\nG90\nG05\nT1\nX1.0Y1.0\nX2.4Y1.0\nX2.4Y1.9\nT2\nX1.7Y2.2\nM30\n"
HOLES_MM = ((0.0, 0.0), (1.4, 0.0), (1.4, 0.9), (0.7, 1.2))  # from the board's lowest X and Y: the working base
STEPS_PER_MM = 1200 / 25.4
SPINDLE_PIN = 48
CHANGES = {
    "start = 1200": "start = 60",
    "start = 600": "start = 40",
    "start = 0": "start = 25",
    "range = [-10, 825]": "range = [-80, 300]",
    "edge = 790": "edge = 120",
    "board_surface = { z = 600 }": "board_surface = { z = 90 }",
    "longest_drilling_s = 18": "longest_drilling_s = 18\nspin_up_s = 0.2",
    "[drill]": "[outputs]\nspindle = 24\n\n[drill]",
}


def write_job(folder: Path) -> Path:
    """The board as ``board.drl``; returns the machine's file."""
    (folder / "board.drl").write_text(BOARD)
    text = (shipped_tables() / "machines" / "pcb-drill.toml").read_text()
    for old, new in CHANGES.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    machine_file = folder / "near.toml"
    machine_file.write_text(text)
    return machine_file


def drillctl(folder: Path, device: str, *arguments: str) -> "subprocess.Popen[str]":
    """The program on the board at this serial line, paced, without a person."""
    call = [sys.executable, "-m", "drillctl", *arguments, "--port", f"firmata:{device}", "--pace", "real"]
    call += ["--tools", "assume", "--json"]
    return subprocess.Popen(call, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
