"""What can be done next on a screen itself, while the machine waits for nothing urgent: rows of a table, as those of
step_rows.py for the machine.

Rule: the first row that holds is shown; a row names methods of the screen, whose keys are found in its key table. A
screen has its rows as ``own_steps``; one without any shows what the machine waits for.
"""

import re
from collections.abc import Callable
from typing import Any, NamedTuple

import urwid

from drillctl.language.words import N_
from drillctl.ui.screens.shell import Step
from drillctl.viewmodel.console import MachineView

FIELD = re.compile(r"\{(\w+)\}")


class OwnRow(NamedTuple):
    """``holds`` is asked with the screen; ``paused``: the row is for a clock that is stopped."""

    holds: Callable[[Any], bool]
    attribute: str
    text: str
    paused: bool = False


def _always(_screen: object) -> bool:
    return True


TABLE_STEPS = (
    OwnRow(lambda screen: screen.has_problem, "warning",
           N_("a problem: put it right, or {undo} takes the change back")),
    OwnRow(lambda screen: screen.loses and screen.changed, "warning",
           N_("steps are lost: change it further, or {undo} takes the change back")),
    OwnRow(lambda screen: screen.loses, "warning",
           N_("steps are lost with the table as it was saved: change it")),
    OwnRow(lambda screen: screen.changed and not screen.tried, "warning",
           N_("changed: {try_out} tries it on the bench, {save} saves it")),
    OwnRow(lambda screen: screen.changed, "good", N_("no step is lost: {save} saves it")),
    OwnRow(_always, "good", N_("change what the cursor is on; {try_out} tries the table on the bench")),
)  # fmt: skip
LIST_STEPS = (OwnRow(_always, "good", N_("{edit} opens the one at the cursor, {copy} copies it under another name")),)
QUEUE_STEPS = (
    OwnRow(_always, "warning", N_("the clock is stopped: {tick} lets a tick through, {run_all} goes on"), paused=True),
    OwnRow(lambda screen: not screen.text.strip(), "good", N_("type a command; {complete} shows those there are")),
    OwnRow(_always, "good", N_("{run_all} runs the queue, {run_line} one line of it, {tick} one tick")),
)
SIGNAL_STEPS = (OwnRow(_always, "good", N_("{toggle} switches the signal at the cursor")),)
CONFIGURATION_STEPS = (
    OwnRow(lambda screen: screen.changed, "warning", N_("changed: {save} saves it, {undo} takes the change back")),
    OwnRow(_always, "good", N_("type over a value; {choose} drives the machine as it was saved")),
)
PLANT_STEPS = (OwnRow(_always, "good", N_("{choose_plant} chooses the plant, {ask} its faults and seed")),)
PORT_STEPS = (
    OwnRow(_always, "good", N_("{test} tests the port, and nothing moves; {choose_port} chooses the machine")),
)
SCOPE_STEPS = (OwnRow(_always, "good", N_("{choose_run} chooses a run, {search} finds a command in it")),)


def shown_step(step: Step, screen: urwid.Widget, view: MachineView) -> Step:
    """Returns what the machine waits for; in its place the screen's own step, where motions could be begun."""
    rows: tuple[OwnRow, ...] = () if step.refuses else getattr(screen, "own_steps", ())
    row = next((row for row in rows if row.paused == view.paused and row.holds(screen)), None)
    return Step(row.attribute, row.text, {name: ("", name) for name in FIELD.findall(row.text)}) if row else step
