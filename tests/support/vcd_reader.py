"""vcdvcd, a reader of VCD files that is not ours. Used by tests/trace and tests/cli."""

import signal
from typing import Any

import pytest


def vcdvcd_read(**source: str) -> Any:
    """What it understands of a file (``vcd_path``) or text (``vcd_string``). Skips the test where it is not installed.

    Its import makes a broken pipe end the process, which is the one that runs the tests: that is undone here.
    """
    before = signal.getsignal(signal.SIGPIPE)
    try:
        vcdvcd = pytest.importorskip("vcdvcd")
    finally:
        signal.signal(signal.SIGPIPE, before)
    return vcdvcd.VCDVCD(**source)
