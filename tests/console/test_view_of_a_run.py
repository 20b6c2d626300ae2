"""What a view says of a program in execution: the commands to come, forcing pulses, and where carriages really are."""

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.machine import Library
from drillctl.plant import PlantChoice
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.console import MachineView

QUEUE = "KMD_RUCHd x=300\nKMD_RUCHd y=3\nKMD_RUCHd x=-12\nKMD_RUCHd y=-3\nKMD_RUCHd x=-288\n"
MOST_TURNS = 5000


@pytest.mark.parametrize("kind", ["ideal", "dynamic"])
def test_a_view_has_the_next_three_commands_and_the_place_of_the_carriage(kind: str) -> None:
    library = Library.standard()
    running = RunSettings(pace="free", plant=PlantChoice(kind), engine="tick")
    console = MachineConsole(library, library.machine("pcb-drill"), running)
    try:
        assert console.view().following == () and console.run_queue(QUEUE) == ()
        views = _views(console)
    finally:
        console.close()
    first, last = next(view for view in views if view.command), views[-1]
    assert first.command == "KMD_RUCHd x=300" and first.following == tuple(QUEUE.split("\n")[1:4])
    behind = [view.axes[0].behind_steps for view in views if view.moving]
    assert any(steps for steps in behind) == (kind == "dynamic"), "only a motor with time lags"
    assert last.following == () and abs(last.axes[0].behind_steps or 0.0) < 12, "no cycle is lost"
    rows = {name: row for name, row, _on in last.axes[0].wires}
    assert "X" in rows["24a"] and "x" not in rows["24a"] and "X" not in rows["1a"]


def _views(console: MachineConsole) -> list[MachineView]:
    views = []
    for _ in range(MOST_TURNS):
        console.turn()
        views.append(console.view())
        if not console.at_work:
            return views
    raise AssertionError(f"still at work: {views[-1].command}")
