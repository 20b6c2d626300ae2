"""The tool change on the screen: the queue waits at rest, and goes on, is held, or ends, as the operator says."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.console.operator_state import asks_for_tools
from drillctl.machine import Library
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.console import ToolWanted
from drillctl.viewmodel.job_options import JobOptions
from tests.support.operator import until

TWO_TOOLS = "M48\nMETRIC\nT1C0.800\nT2C1.000\n%\nT1\nX10.0Y10.0\nT2\nX12.0Y10.0\nM30\n"


@pytest.fixture
def console(tmp_path: Path) -> Iterator[MachineConsole]:
    library = Library.standard()
    made = MachineConsole(library, library.machine("pcb-drill").at_rate(5000), RunSettings(pace="free"), tools="ask")
    (tmp_path / "two.drl").write_text(TWO_TOOLS)
    assert made.load(str(tmp_path / "two.drl"), JobOptions(format="mm,decimal")) == ()
    yield made
    made.close()


def wanted(console: MachineConsole) -> ToolWanted | None:
    return console.view().tool_wanted


def test_each_tool_is_waited_for_and_the_job_ends_with_all_holes(console: MachineConsole) -> None:
    assert console.tool_changed() == ("no tool is waited for",)
    assert console.start(dry=False) == ()
    until(console, lambda: wanted(console) == ToolWanted(1, 0.8))
    view = console.view()
    assert not view.moving and view.position_known and console.at_work
    tick = view.tick
    for _ in range(30):
        console.turn()
    assert console.view().tick == tick, "a wait for the operator is no tick"
    assert console.tool_changed() == ()
    until(console, lambda: wanted(console) == ToolWanted(2, 1.0))
    progress = console.progress()
    assert progress is not None and progress.holes_done == 1
    assert console.tool_changed() == ()
    until(console, lambda: not console.at_work)
    progress = console.progress()
    assert progress is not None and progress.holes_done == 2 and wanted(console) is None
    assert console.view().fault is None


def test_a_hold_and_a_stop_are_served_while_a_tool_is_waited_for(console: MachineConsole) -> None:
    console.start(dry=False)
    until(console, lambda: wanted(console) is not None)
    assert console.hold() == ()
    until(console, lambda: console.view().condition == "held")
    assert console.tool_changed() == ()
    for _ in range(30):
        console.turn()
    assert not console.view().moving, "held: the tool is in, and nothing moves yet"
    assert console.resume() == ()
    until(console, lambda: wanted(console) == ToolWanted(2, 1.0))
    assert console.stop() == ()
    until(console, lambda: not console.at_work)
    view, progress = console.view(), console.progress()
    assert view.tool_wanted is None and view.position_known and view.condition == "ready"
    assert progress is not None and progress.holes_done == 1


def test_a_hole_that_waits_for_its_tool_has_not_begun(console: MachineConsole) -> None:
    console.start(dry=False)
    until(console, lambda: wanted(console) is not None)
    console.stop()
    until(console, lambda: not console.at_work)
    assert not console.unfinished(), "nothing was drilled, nothing is left over"
    console.start(dry=False)
    until(console, lambda: wanted(console) is not None)
    console.tool_changed()
    until(console, lambda: wanted(console) == ToolWanted(2, 1.0))
    console.stop()
    until(console, lambda: not console.at_work)
    (job,) = console.unfinished()
    assert job.holes_done == 1 and job.again == ()


def test_an_emergency_stop_ends_the_wait(console: MachineConsole) -> None:
    console.start(dry=False)
    until(console, lambda: wanted(console) is not None)
    console.emergency_stop()
    until(console, lambda: not console.at_work)
    assert console.view().condition == "latched" and wanted(console) is None


def test_a_dry_run_asks_for_no_tool(console: MachineConsole) -> None:
    assert console.start(dry=True) == ()
    until(console, lambda: not console.at_work)
    progress = console.progress()
    assert progress is not None and progress.holes_done == 2


@pytest.mark.parametrize(
    ("machine", "simulated", "wish", "asks"),
    [
        ("pcb-drill", True, None, False),
        ("eight-axis", True, None, True),
        ("pcb-drill", False, None, True),
        ("eight-axis", True, "assume", False),
        ("pcb-drill", True, "ask", True),
    ],
    ids=["AUTOMATIC", "MANUAL", "no changer on a real port", "--tools assume wins", "--tools ask wins"],
)
def test_the_machine_s_file_decides_and_the_option_wins(
    machine: str, simulated: bool, wish: str | None, asks: bool
) -> None:
    assert asks_for_tools(Library.standard().machine(machine), simulated, wish) == asks


def test_the_time_left_is_exact_though_the_job_starts_elsewhere_and_waits(console: MachineConsole) -> None:
    """Compared at the second tool: what was left there is what the rest then takes, a poll of the status apart."""
    console.initialise()
    until(console, lambda: not console.at_work)
    console.start(dry=False)
    until(console, lambda: wanted(console) is not None)
    console.tool_changed()
    until(console, lambda: wanted(console) == ToolWanted(2, 1.0))
    before = console.progress()
    console.tool_changed()
    until(console, lambda: not console.at_work)
    after = console.progress()
    assert before is not None and after is not None and before.seconds_left is not None
    assert after.seconds_left is None, "nothing of a job that is over is left"
    taken_s = after.machine_seconds - before.machine_seconds
    assert taken_s > 0.2 and abs(before.seconds_left - taken_s) <= 2 / 5000
