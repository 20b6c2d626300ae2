"""Somebody at a station, who turns it until something holds.

Rule: every wait ends. A hold for a gap in time is gone on from, as a person would: on a busy computer a paced machine
meets such gaps, and no test here is about them. Used by tests/station.
"""

import time
from collections.abc import Callable

from drillctl.console.machine_console import MachineConsole

PATIENCE_S = 60.0


def until(station: MachineConsole, holds: Callable[[], object]) -> None:
    """Turns the station until it holds; fails with what is seen of the machine."""
    until_s = time.monotonic() + PATIENCE_S
    view = station.view()
    while not holds():
        assert time.monotonic() < until_s, view
        if view.condition == "held" and not view.paused:
            station.resume()
        station.turn()
        view = station.view()  # before it is asked: a hold that is waited for is not gone on from


def settle(station: MachineConsole) -> None:
    """Until nothing runs any more. A station is turned once at the least: an emergency stop at rest begins no job."""
    station.turn()
    until(station, lambda: not station.at_work)
