"""Reading takes at most ten times the input and 100 MB of memory, whatever the input; benchmarks/reader_memory.py."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the highest resident size is read from /proc")
def test_every_reader_stays_within_its_memory() -> None:
    command = [sys.executable, "-m", "benchmarks.reader_memory", "--bytes", "300000"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=100, check=False)
    assert done.returncode == 0 and "segments: images" in done.stdout, done.stdout + done.stderr
