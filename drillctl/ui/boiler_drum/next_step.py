"""What the boiler-drum drill waits for: a table from its condition to a sentence with the keys that do it.

Rule: the first row whose condition holds is shown; a row names actions, never keys (ui/next_step.py finds them).
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from drillctl.language.words import N_
from drillctl.ui.screens.shell import Step
from drillctl.viewmodel.console import Console, MachineView

ACTIONS: Mapping[str, tuple[str, str]] = {
    **{name: ("panel", name) for name in (
        "acknowledge", "resume", "pause", "return_to_zero", "stop", "initialise", "start", "call_workpiece",
        "list_workpieces",
    )},
    "queue": ("queue_editor", ""),
}  # fmt: skip
AT_WORK = N_("the machine is at work")


class Row(NamedTuple):
    """``holds`` is asked with the machine and whether a workpiece is called; the other fields are those of Step."""

    holds: Callable[[MachineView, bool], bool]
    attribute: str
    text: str
    refuses: str = ""


ROWS = (
    Row(lambda view, called: view.condition == "returning", "warning",
        N_("the machine returns to a known position"), AT_WORK),
    Row(lambda view, called: view.condition == "latched", "danger",
        N_("FAULT {fault}: put its cause right, then {acknowledge} acknowledges it"),
        N_("a fault is latched: acknowledge it first")),
    Row(lambda view, called: view.condition == "zero_only" and not view.at_work, "warning",
        N_("only the return to zero is allowed: {return_to_zero}"), N_("only the return to zero is allowed")),
    Row(lambda view, called: view.paused, "warning", N_("the clock is stopped: {queue} has the keys that go on")),
    Row(lambda view, called: view.condition == "stopping", "warning", N_("the job is being ended"), AT_WORK),
    Row(lambda view, called: view.condition in ("held", "holding"), "warning",
        N_("paused: {resume} goes on, {return_to_zero} returns the tool to zero"),
        N_("the program is paused: go on with it, or return to zero")),
    Row(lambda view, called: view.at_work or view.moving, "good",
        N_("at work: {pause} pauses, {stop} ends the program"), AT_WORK),
    Row(lambda view, called: not called, "good",
        N_("two digits and {call_workpiece} call a workpiece; {list_workpieces} lists them")),
    Row(lambda view, called: not view.position_known, "warning",
        N_("set the tool by single steps; {start} takes the place as zero and runs the workpiece")),
    Row(lambda view, called: True, "good", N_("ready: {start} runs the workpiece")),
)  # fmt: skip


def next_step(console: Console, view: MachineView) -> Step:
    """The first row of the table that holds."""
    stores = console.workpieces()
    called = stores is not None and stores.called() is not None
    row = next(row for row in ROWS if row.holds(view, called))
    return Step(row.attribute, row.text, ACTIONS, {"fault": view.fault.name if view.fault else ""}, row.refuses)
