"""A rate that this computer can't work off is refused before anything moves, with the rate that it can."""

from pathlib import Path

import pytest

from drillctl.machine import Library
from drillctl.ports import PortRefused
from drillctl.ticker import realtime as capacity
from drillctl.ticker.launch import RunSettings, start
from drillctl.ticker.realtime import most_ticks_hz

pytestmark = pytest.mark.paced

MACHINE = Library.standard().machine("pcb-drill")


def test_the_papers_rate_is_no_trouble_for_any_computer_of_today() -> None:
    assert most_ticks_hz(MACHINE) > MACHINE.tick_hz


def test_a_slow_computer_refuses_and_says_what_it_can(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(capacity, "_seconds_a_tick", lambda ticker: 0.004)
    with pytest.raises(PortRefused, match=r"500 ticks a second of pcb-drill are too many .*--tick-hz 250 is the most"):
        start(MACHINE, RunSettings(pace="real"), tmp_path / "status")
