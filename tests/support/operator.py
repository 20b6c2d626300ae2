"""Somebody at a console, who turns it until something holds.

Rule: every wait ends. A hold for a gap in time is gone on from, as a person would: on a busy computer a paced machine
meets such gaps, and no test here is about them. Used by tests/console.
"""

import time
from collections.abc import Callable

from drillctl.console.machine_console import MachineConsole

PATIENCE_S = 60.0


def until(console: MachineConsole, holds: Callable[[], object]) -> None:
    """Turns the console until it holds; fails with what is seen of the machine."""
    until_s = time.monotonic() + PATIENCE_S
    view = console.view()
    while not holds():
        assert time.monotonic() < until_s, view
        if view.condition == "held" and not view.paused:
            console.resume()
        console.turn()
        view = console.view()  # before it is asked: a hold that is waited for is not gone on from


def settle(console: MachineConsole) -> None:
    """Until nothing runs any more. A console is turned once at the least: an emergency stop at rest begins no job."""
    console.turn()
    until(console, lambda: not console.at_work)
