"""What a machine that drills boards waits for: a table from its condition to a sentence with the keys that do it.

Rule: the first row whose condition holds is shown. A row names actions, never keys: which key does an action on the
screen on top is found in the key tables (ui/next_step.py).
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from drillctl.language.words import N_
from drillctl.ui.screens.machine_lines import tool_name
from drillctl.ui.screens.shell import Step
from drillctl.viewmodel.console import BoardView, Console, MachineView

ACTIONS: Mapping[str, tuple[str, str]] = {
    **{name: ("drilling", name) for name in (
        "acknowledge", "tool_changed", "hold_or_resume", "stop", "initialise", "return_to_zero", "start", "dry_run",
        "examples",
    )},
    "files": ("files", ""),
    "queue": ("queue_editor", ""),
}  # fmt: skip
AT_WORK = N_("the machine is at work")


class Row(NamedTuple):
    """``holds`` is asked with the machine and the board; the other fields are those of Step."""

    holds: Callable[[MachineView, BoardView | None], bool]
    attribute: str
    text: str
    refuses: str = ""


ROWS = (
    Row(lambda view, board: view.condition == "returning", "warning",
        N_("the machine returns to a known position"), AT_WORK),
    Row(lambda view, board: view.condition == "latched", "danger",
        N_("FAULT {fault}: put its cause right, then {acknowledge} acknowledges it"),
        N_("a fault is latched: acknowledge it first")),
    Row(lambda view, board: view.condition == "zero_only" and not view.at_work, "warning",
        N_("only the return to zero is allowed: {return_to_zero}"), N_("only the return to zero is allowed")),
    Row(lambda view, board: view.paused, "warning", N_("the clock is stopped: {queue} has the keys that go on")),
    Row(lambda view, board: view.condition == "stopping", "warning", N_("the job is being ended"), AT_WORK),
    Row(lambda view, board: view.condition in ("held", "holding"), "warning",
        N_("held: {hold_or_resume} goes on, {stop} ends the job"),
        N_("the job is held: go on with it, or end it first")),
    Row(lambda view, board: view.tool_wanted is not None, "warning",
        N_("{tool} is wanted: put it in, then {tool_changed}"), N_("the job waits for a tool")),
    Row(lambda view, board: view.at_work or view.moving, "good",
        N_("at work: {hold_or_resume} holds, {stop} ends the job"), AT_WORK),
    Row(lambda view, board: board is None, "warning",
        N_("no board: {files} opens one, {examples} shows the examples")),
    Row(lambda view, board: not view.position_known, "warning",
        N_("position not known: {initialise} initialises; {start} does, then drills")),
    Row(lambda view, board: True, "good",
        N_("ready: {start} drills the board, {dry_run} goes over it with the drill up")),
)  # fmt: skip


def next_step(console: Console, view: MachineView) -> Step:
    """The first row of the table that holds."""
    board = console.board()
    row = next(row for row in ROWS if row.holds(view, board))
    values = {
        "fault": view.fault.name if view.fault else "",
        "tool": tool_name(view.tool_wanted) if view.tool_wanted else "",
    }
    return Step(row.attribute, row.text, ACTIONS, values, row.refuses)
