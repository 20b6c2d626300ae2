"""What the queue editor says around its text: the commands that there are, what is wrong, where the clock stopped.

Rule: functions of what the console answered; nothing here asks it.
"""

from collections.abc import Sequence

from drillctl.language.words import _, translated
from drillctl.ui.models.editing import written
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import AxisView, MachineView
from drillctl.viewmodel.tables import CommandHelp, TextFinding

MOST_FINDINGS = 5


def reference_lines(commands: Sequence[CommandHelp], columns: int) -> list[Line]:
    """How each command is written, and what it does below it."""
    lines: list[Line] = []
    for command in commands:
        lines += [[("lit", written(command))], [("dark", f"  {translated(command.meaning)}")]]
    return folded(lines, columns)


def stopped_lines(view: MachineView) -> list[Line]:
    """Where the clock stopped: tick and command, and a part for each axis."""
    place = _("stopped after tick {tick}: {command}").format(tick=view.tick, command=view.command or "-")
    return [[("warning", place)], ["  ".join(map(_axis, view.axes))]]


def _axis(axis: AxisView) -> str:
    text = _("{axis} column {column} ({state}) at {steps}")
    return text.format(axis=axis.name.upper(), column=axis.column, state=f"{axis.state:+d}", steps=axis.position_steps)


def finding_lines(found: Sequence[TextFinding], attribute: str) -> list[Line]:
    """The first findings in one look, and how many more there are."""
    lines: list[Line] = [[(attribute, translated(finding.message))] for finding in found[:MOST_FINDINGS]]
    more = len(found) - MOST_FINDINGS
    rest: list[Line] = [[_("and {count} more").format(count=more)]] if more > 0 else []
    return [*lines, *rest]
