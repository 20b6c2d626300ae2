"""What happened at the machine, the newest last: what changed from one view to the next, in words.

Rule: a function of the views alone, so that the same run gives the same list. Times are the machine's own.
"""

from collections import deque
from collections.abc import Iterator

from drillctl.language.number_text import clock
from drillctl.language.words import N_, _, translated
from drillctl.viewmodel.console import MachineView

MOST_EVENTS = 200
BY_CONDITION = {
    "ready": ("good", N_("ready")),
    "holding": ("warning", N_("braking")),
    "held": ("warning", N_("held")),
    "stopping": ("warning", N_("the job is being ended")),
    "returning": ("warning", N_("the machine returns to a known position")),
    "zero_only": ("warning", N_("only the return to zero is allowed")),
}

Event = tuple[str, str, str]  # time, role of its meaning, text


class Events:
    """The last MOST_EVENTS events of the machine that is shown."""

    def __init__(self) -> None:
        self.listed: deque[Event] = deque(maxlen=MOST_EVENTS)
        self._before: MachineView | None = None

    def see(self, view: MachineView) -> bool:
        """Adds what is new in a view; returns whether anything was."""
        before, self._before = self._before, view
        if before is None or before is view or before.machine != view.machine:
            return False
        new = [(clock(view.tick / max(view.tick_hz, 1)), *event) for event in _changes(before, view)]
        self.listed.extend(new)
        return bool(new)


def _changes(before: MachineView, view: MachineView) -> Iterator[tuple[str, str]]:
    if view.at_work and not before.at_work:
        yield "good", _("the machine is at work")
    if view.fault and view.fault.code and (before.fault is None or before.fault.code != view.fault.code):
        yield "danger", f"{_('FAULT')} {view.fault.name}"
    if view.condition != before.condition and view.condition in BY_CONDITION:
        attribute, text = BY_CONDITION[view.condition]
        yield attribute, _(text)
    if view.tool and view.tool != before.tool:
        yield "body", _("tool T{number} is in").format(number=view.tool)
    if view.position_known != before.position_known:
        yield ("good", _("position known")) if view.position_known else ("warning", _("position not known"))
    for notice in view.notices[len(before.notices) :]:
        yield "warning", translated(notice)
    if view.lost_steps and before.lost_steps and sum(map(abs, view.lost_steps)) > sum(map(abs, before.lost_steps)):
        yield "danger", _("steps are lost: {steps}").format(steps=" ".join(map(str, view.lost_steps)))
    if before.at_work and not view.at_work:
        yield "body", _("the machine is at rest")
