"""What a machine waits for, as rows of a table: those that every machine has, and how a row is chosen.

Rule: the first row whose condition holds is shown; a row names actions, never keys: which key does an action on the
screen on top is found in the key tables (ui/next_step.py).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from drillctl.language.words import N_
from drillctl.ui.screens.shell import Step
from drillctl.viewmodel.console import MachineView

WorkT = TypeVar("WorkT")
AT_WORK = N_("the machine is at work")


@dataclass(frozen=True)
class Row(Generic[WorkT]):
    """``holds`` is asked with the machine and its work (a board, a workpiece); the other fields are those of Step."""

    holds: Callable[[MachineView, WorkT], bool]
    attribute: str
    text: str
    refuses: str = ""


# Before anything that depends on the work. Actions: acknowledge, return_to_zero, queue.
FIRST_ROWS: tuple[Row[Any], ...] = (
    Row(lambda view, work: view.condition == "returning", "warning",
        N_("the machine returns to a known position"), AT_WORK),
    Row(lambda view, work: view.condition == "latched", "danger",
        N_("FAULT {fault}: put its cause right, then {acknowledge} acknowledges it"),
        N_("a fault is latched: acknowledge it first")),
    Row(lambda view, work: view.condition == "zero_only" and not view.at_work, "warning",
        N_("only the return to zero is allowed: {return_to_zero}"), N_("only the return to zero is allowed")),
    Row(lambda view, work: view.paused, "warning", N_("the clock is stopped: {queue} has the keys that go on")),
    Row(lambda view, work: view.condition == "stopping", "warning", N_("the job is being ended"), AT_WORK),
)  # fmt: skip


def is_held(view: MachineView, work: object) -> bool:
    """Whether the machine is held, or brakes on a hold."""
    return view.condition in ("held", "holding")


def chosen(
    rows: Sequence[Row[WorkT]], view: MachineView, work: WorkT, actions: Mapping[str, tuple[str, str]], **values: str
) -> Step:
    """Returns the first row that holds, as a step. ``values``: what stands in its text beside the fault's name."""
    row = next(row for row in rows if row.holds(view, work))
    fault = view.fault.name if view.fault else ""
    return Step(row.attribute, row.text, actions, {"fault": fault, **values}, row.refuses)
