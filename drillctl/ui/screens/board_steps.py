"""What a machine that drills boards waits for, after what every machine does (step_rows.py): a table from its
condition, and the board that is loaded, to a sentence with the keys that do it.
"""

from collections.abc import Mapping

from drillctl.language.words import N_
from drillctl.ui.screens.machine_lines import tool_name
from drillctl.ui.screens.shell import Step
from drillctl.ui.screens.step_rows import AT_WORK, FIRST_ROWS, Row, chosen, is_held
from drillctl.viewmodel.console import BoardView, Console, MachineView

ACTIONS: Mapping[str, tuple[str, str]] = {
    **{name: ("drilling", name) for name in (
        "acknowledge", "tool_changed", "hold_or_resume", "stop", "initialise", "return_to_zero", "start", "dry_run",
        "examples",
    )},
    "files": ("files", ""),
    "queue": ("queue_editor", ""),
}  # fmt: skip
ROWS: tuple[Row[BoardView | None], ...] = (
    *FIRST_ROWS,
    Row(is_held, "warning",
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
    tool = tool_name(view.tool_wanted) if view.tool_wanted else ""
    return chosen(ROWS, view, board, ACTIONS, tool=tool)
