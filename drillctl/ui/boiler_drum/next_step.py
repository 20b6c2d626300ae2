"""What the boiler-drum drill waits for, after what every machine does (ui/screens/step_rows.py): a table from its
condition, and whether a workpiece is called, to a sentence with the keys that do it.
"""

from collections.abc import Mapping

from drillctl.language.words import N_
from drillctl.ui.screens.shell import Step
from drillctl.ui.screens.step_rows import AT_WORK, FIRST_ROWS, Row, chosen, is_held
from drillctl.viewmodel.console import Console, MachineView

ACTIONS: Mapping[str, tuple[str, str]] = {
    **{name: ("panel", name) for name in (
        "acknowledge", "resume", "pause", "return_to_zero", "stop", "initialise", "start", "call_workpiece",
        "list_workpieces",
    )},
    "queue": ("queue_editor", ""),
}  # fmt: skip
ROWS: tuple[Row[bool], ...] = (
    *FIRST_ROWS,
    Row(is_held, "warning",
        N_("paused: {resume} goes on, {return_to_zero} returns the tool to zero"),
        N_("the program is paused: go on with it, or return to zero")),
    Row(lambda view, called: view.at_work or view.moving, "good",
        N_("at work: {pause} pauses, {stop} ends the program"), AT_WORK),
    Row(lambda view, called: not called, "good",
        N_("two digits and {call_workpiece} call a workpiece; {list_workpieces} lists them")),
    Row(lambda view, called: not view.position_known, "warning",
        N_("set the tool by single steps; {start} takes the place as zero and runs")),
    Row(lambda view, called: True, "good", N_("ready: {start} runs the workpiece")),
)  # fmt: skip


def next_step(console: Console, view: MachineView) -> Step:
    """The first row of the table that holds."""
    stores = console.workpieces()
    called = stores is not None and stores.called() is not None
    return chosen(ROWS, view, called, ACTIONS)
