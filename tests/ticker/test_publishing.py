"""What the ticker's process puts into the mapped file after a wake, on a time of its own."""

import os
import time
from pathlib import Path

import pytest

from drillctl.kmd.channel import Channel
from drillctl.plant import IdealPlant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ticker.edited_tables import TableSlot
from drillctl.ticker.ticker_process import DESK_IDLE_NS, TickerProcess
from tests.support.bench import shipped


@pytest.mark.parametrize(
    ("tick_hz", "recorded"), [(500, [1, 2, 3, 4, 5, 6]), (1000, [1, 2, 3, 4, 5, 6]), (5000, [1, 1, 1, 1, 1, 6])]
)
def test_each_tick_is_counted_and_the_record_comes_as_often_as_a_desk_can_read(
    tick_hz: int, recorded: list[int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A trace of a ticker that was killed goes up to the last tick that was counted, not to the last record."""
    machine, channel = shipped("pcb-drill").at_rate(tick_hz), Channel(tmp_path / "status", True)
    plant, ends, now_ns = IdealPlant(machine), os.pipe(), [10**9]
    body = TickerProcess(
        machine, SimulatedCard(plant), plant, channel, TableSlot(), None, False, ends[1], ends[1], DESK_IDLE_NS
    )
    monkeypatch.setattr(time, "monotonic_ns", lambda: now_ns[0])
    seen = []
    for _ in recorded:
        body.ticker.run(1)
        body._publish()
        seen.append((channel["ticks"], int(channel.status()["tick"])))
        now_ns[0] += 10**9 // tick_hz
    monkeypatch.undo()
    for end in ends:
        os.close(end)
    assert seen == list(enumerate(recorded, 1))
