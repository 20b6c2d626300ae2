"""A work list as a program of a production drill: tool by tool, each by its own speeds, hole by hole with all chosen
spindles; tools are changed by the machine or by hand, and at the end the table is parked.

Rule: as of pcb_drill/program.py. Between the holes of a tool the heads lift by the working stroke alone.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.eight_axis.change import ChangeMaker
from drillctl.generation.eight_axis.feeds import interval_of
from drillctl.generation.eight_axis.magazine import EMPTY, Magazine, full_magazine
from drillctl.generation.eight_axis.tools import Stretch, is_automatic, speed_of, stretches
from drillctl.generation.errors import JobError
from drillctl.generation.pcb_drill.program import go_to_base, gotos, holes_of, spin_up, switch
from drillctl.generation.pcb_drill.strokes import drill_stroke, mask_of, spot_stroke
from drillctl.generation.sequences import Change, Records, numbered, record
from drillctl.generation.spindles import heads_of
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import Group, WorkList
from drillctl.kmd import Op
from drillctl.kmd.commands import Flag
from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.machine.head_lines import CONTACT, FOOT, head_input


def board_program(
    work: WorkList, machine: Machine, settings: WorkSettings, magazine: Magazine | None = None
) -> Records:
    """The program of a job, dtype RECORD, on a machine with parameters whose tools are as ``magazine`` says; None: all
    in their places. Raises JobError.
    """
    return _Program(work, machine, settings, magazine or full_magazine(machine)).made()


class _Program:
    def __init__(self, work: WorkList, machine: Machine, settings: WorkSettings, magazine: Magazine):
        self._work, self._machine, self._settings, self._magazine = work, machine, settings, magazine
        self._heads = _enabled(machine, heads_of(machine, settings.spindles))
        self._spindles = tuple(1 + machine.drill_axes.index(head) for head in self._heads)
        self._outputs = dict(machine.outputs)
        self._changes = ChangeMaker(machine, settings.base_steps)
        self._here: NDArray[np.int64] = np.zeros(2, np.int64)

    def made(self) -> Records:
        """Returns the commands from initialisation to parking, numbered from 1."""
        parts = [record(Op.INICJALIZACJA), *go_to_base(self._settings, self._machine)]
        parts += switch(self._outputs.get(FOOT), 1)
        if is_automatic(self._machine):
            parts += self._emptied()
        for group in self._work.groups:
            parts += self._group(group)
        parts += [record(Op.WRZECIONO, [0]), record(Op.WIERTLO_DOM), *switch(self._outputs.get(FOOT), 0)]
        return numbered([*parts, self._changes.parked(), record(Op.KONIEC)])

    def _group(self, group: Group) -> list[Records]:
        parts: list[Records] = []
        within = Change.NONE
        for stretch in stretches(group, self._machine, self._spindles, self._magazine):
            parts += [record(Op.WRZECIONO, [0]), *self._change(group, stretch, within)]
            rev_min = round(speed_of(self._machine, stretch.tool, "spindle_rev_min"))
            parts.append(record(Op.WRZECIONO, [rev_min]))
            if self._machine.spindle is None:  # else the command waits for its speed
                parts += spin_up(self._machine, self._outputs.get("spindle"))
            parts += [*self._found(stretch), *self._holes(group, stretch)]
            if stretch.tool is not None:
                renewed = self._magazine.renew(stretch.tool) if stretch.renewed else self._magazine
                self._magazine = renewed.hit(stretch.tool, stretch.stop - stretch.start)
            within = Change.WITHIN
        return parts

    def _change(self, group: Group, stretch: Stretch, within: Change) -> list[Records]:
        """What puts the tool of a stretch into the spindles."""
        tool = stretch.tool or 0
        if not is_automatic(self._machine):
            return self._changes.by_hand(group.number, within | _renewal(stretch), tool)
        parts = self._taken(tool)
        parts.append(record(Op.NARZEDZIE, [group.number, within | Change.AUTOMATIC, tool]))
        if stretch.renewed:
            parts += self._changes.by_hand(group.number, Change.WITHIN | Change.RENEWED, tool)
        return parts

    def _emptied(self) -> list[Records]:
        """Leaves what the spindles hold where that is not one tool in all. Raises JobError for what is unknown."""
        self._check_known()
        held = {spindle: self._magazine.chucks.get(spindle) or EMPTY for spindle in self._spindles}
        if len(set(held.values())) == 1:
            return []
        parts: list[Records] = []
        for tool in sorted(set(held.values()) - {EMPTY}):
            parts += self._moved(tool, EMPTY, [spindle for spindle, holds in held.items() if holds == tool])
        return parts

    def _taken(self, tool: int) -> list[Records]:
        """Leaves the tool in the spindles and takes this one; nothing where they hold it already."""
        old = self._magazine.chucks.get(self._spindles[0]) or EMPTY
        return [] if old == tool else self._moved(old, tool, self._spindles)

    def _moved(self, old: int, new: int, spindles: Sequence[int]) -> list[Records]:
        self._magazine = self._magazine.moved(self._machine, old, new, spindles)
        return self._changes.automatic(old, new, spindles)

    def _check_known(self) -> None:
        chucks, _ = self._magazine.unknown()
        unknown = [spindle for spindle in chucks if spindle in self._spindles]
        if unknown:
            listed = ", ".join(map(str, unknown))
            raise JobError(
                Message(
                    "it is unknown what the chucks of spindles {spindles} hold: look, and say so with `drillctl "
                    "magazine set`",
                    spindles=listed,
                ).at(self._machine.name)
            )

    def _found(self, stretch: Stretch) -> list[Records]:
        """Looks for the boards with new bits, over their first hole; the heads go fast to where they work. Nothing
        where no head has a contact and a detection descent.
        """
        machine, heads = self._machine, detecting(self._machine, self._heads)
        if not heads:
            return []
        self._here = self._work.steps[stretch.start]
        lowered = self._stroke(self._working_top())
        lowered["opcode"], lowered["flags"] = Op.RUCH, Flag.ABSOLUTE
        touch = record(Op.DOTYK, axes=mask_of(machine, heads))
        for head in heads:
            touch["args"][0, head] = interval_of(machine, head, *_detection_speed(machine))
        up = self._fed(record(Op.WIERTLO_GORA, axes=mask_of(machine, self._heads)), stretch.tool)
        return [gotos(self._here[None, :], machine), self._stroke(self._working_top()), lowered, touch, up]

    def _holes(self, group: Group, stretch: Stretch) -> list[Records]:
        """The holes of a stretch, spotted first where that is asked for, with strokes as short as they can be."""
        settings, machine = self._settings, self._machine
        drill = self._fed(drill_stroke(machine, settings.peck_mm, self._heads), stretch.tool)
        passes = [drill]
        if settings.spot_mm is not None:
            passes = [self._fed(spot_stroke(machine, settings.spot_mm, self._heads), stretch.tool), drill]
        part = Group(group.number, group.diameter_mm, stretch.start, stretch.stop, group.drill)
        made = [self._stroke(self._working_top())]
        for stroke in passes:
            made.append(holes_of(self._work, part, stroke, self._here, machine))
            self._here = self._work.steps[stretch.stop - 1]
        return [*made, self._stroke(self._tops()), record(Op.WIERTLO_GORA)]

    def _fed(self, stroke: Records, tool: int | None) -> Records:
        """The stroke at the feed and the lifting speed of a tool."""
        speeds = ((Op.WIERTLO_DOL, "feed_mm_min"), (Op.WIERTLO_GORA, "lift_mm_min"))
        for head in self._heads:
            for op, name in speeds:
                called = name if tool is None else f"parameters.tool.{tool}.{name}"
                ticks = interval_of(self._machine, head, speed_of(self._machine, tool, name), called)
                stroke["args"][stroke["opcode"] == op, head] = ticks
        return stroke

    def _working_top(self) -> list[int]:
        """By spindle chosen, where its head waits between two holes: the working stroke above the lowest place."""
        parameters = self._machine.parameters
        assert parameters is not None
        stroke_mm = parameters.number("machining", "working_stroke_mm") or 0.0
        clear, tops = self._machine.drill_clear_steps, []
        for head, top in zip(self._heads, self._tops(), strict=True):
            table = self._machine.axes[head]
            lowest = self._machine.drill_down_steps or table.high_steps
            place = max(top, lowest - round(stroke_mm * table.steps_per_mm))
            tops.append(place if clear is None else min(place, clear))
        return tops

    def _tops(self) -> list[int]:
        return [max(0, self._machine.reach(head)[0]) for head in self._heads]

    def _stroke(self, tops: Sequence[int]) -> Records:
        args = [0] * len(self._machine.axes)
        for head, steps in zip(self._heads, tops, strict=True):
            args[head] = steps
        return record(Op.SUW, args, sum(1 << head for head in self._heads))


def detecting(machine: Machine, heads: Sequence[int]) -> tuple[int, ...]:
    """Returns the heads that look for their boards: those with a contact and a detection descent."""
    known = machine.parameters
    assert known is not None
    descents = {head: known.of_axis(machine.axis_names[head]).number("depth_detection_descent_mm") for head in heads}
    return tuple(head for head in heads if descents[head] and head_input(machine, CONTACT, head))


def _detection_speed(machine: Machine) -> tuple[float, str]:
    """The speed of depth detection in mm/min, and the name of its parameter."""
    assert machine.parameters is not None
    name = "depth_detection_speed_mm_min"
    return machine.parameters.number("system", name) or 0.0, f"parameters.system.{name}"


def _renewal(stretch: Stretch) -> Change:
    return Change.RENEWED if stretch.renewed else Change.NONE


def _enabled(machine: Machine, heads: Sequence[int]) -> tuple[int, ...]:
    """The chosen spindles that are installed and enabled. Raises JobError where none is."""
    assert machine.parameters is not None
    used = tuple(head for head in heads if machine.parameters.in_use(machine.axis_names[head]))
    if not used:
        raise JobError(Message("no spindle that was chosen is installed and enabled").at(machine.name))
    return used
