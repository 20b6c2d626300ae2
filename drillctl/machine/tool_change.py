"""The tool changer of a machine: its steps one after the other, each with its time limit and its fault.

Rule: ``[[tool_change]]`` rows say what is done, in order; steps of the ``old`` tool are left out where no tool is in
the spindles, those of the ``new`` one where none is wanted. Where the places of the magazine lie, and how deep the
spindles go there, are parameters.
"""

from dataclasses import dataclass

from drillctl.language import Message
from drillctl.machine.shape import MachineFile
from drillctl.machine.source import Source

TOGETHER, IN_TURN = "together", "in turn"
OLD, NEW, PARKING = "old", "new", "parking"
TO = ("x", "y", "xy")  # steps that go somewhere
LOOKING = ("left", "taken")  # steps that look at the tool sensors
LEVELLED = ("foot", "chuck")  # steps that set an output to a level


@dataclass(frozen=True, slots=True)
class ChangeStep:
    """One step.

    do       "home": all heads up to their sensors; "foot": the presser foot to ``level``; "x", "y", "xy": to the place
             ``to``; "height": the heads down to the change height; "chuck": to ``level``, 1 is open; "delay": a pause;
             "left", "taken": the tool sensors say so
    part     "old" or "new": belongs to leaving the old tool or to taking the new one; "" to any change
    input    must read ``reads`` then: the name of an input, or ``NAME`` for ``NAME_1`` and so on of the spindles that
             change; "" where nothing answers
    in_turn  carried out for one spindle after the other, where the spindles change in turn
    """

    do: str
    limit_s: float
    fault: str
    part: str = ""
    to: str = ""
    level: int = 0
    delay_s: float = 0.0
    input: str = ""
    reads: int = 1
    in_turn: bool = False


@dataclass(frozen=True, slots=True)
class ToolChanger:
    """``order`` is "together" or "in turn". The spindles lie ``spindle_pitch_mm`` apart along X, the bits of one place
    of the magazine ``magazine_pitch_mm``.
    """

    order: str
    spindle_pitch_mm: float
    magazine_pitch_mm: float
    steps: tuple[ChangeStep, ...]

    def shift_mm(self, spindle: int) -> float:
        """Returns how far X must go beyond a place for a spindle, by its number from 1, to stand over its own bit."""
        return (spindle - 1) * (self.magazine_pitch_mm - self.spindle_pitch_mm)


def tool_changer(source: Source, raw: MachineFile) -> ToolChanger | None:
    """Returns the tool changer of a machine's file, None for a machine without one. Raises TableError."""
    if raw.tool_changer is None:
        if raw.tool_change:
            raise source.error(Message("[[tool_change]] rows need a [tool_changer]"), "tool_change", 0)
        return None
    steps = tuple(_step(source, raw, index) for index in range(len(raw.tool_change)))
    part = raw.tool_changer
    if part.order == TOGETHER and part.spindle_pitch_mm != part.magazine_pitch_mm:
        reason = Message('tool_changer: spindles that are not as far apart as the bits of a place change "in turn"')
        raise source.error(reason, "tool_changer", "order")
    return ToolChanger(part.order, part.spindle_pitch_mm, part.magazine_pitch_mm, steps)


def _step(source: Source, raw: MachineFile, index: int) -> ChangeStep:
    row = raw.tool_change[index]
    wrong: tuple[tuple[bool, str, Message], ...] = (
        ((row.to is not None) != (row.do in TO), "to", Message("a step has a place where it is x, y or xy")),
        (row.to in (OLD, NEW) and row.to != row.part, "to", Message("the place of a tool belongs to the part of it")),
        ((row.level is not None) != (row.do in LEVELLED), "level", Message("foot and chuck have a level, no others")),
        ((row.delay_s is not None) != (row.do == "delay"), "delay_s", Message("delay has a time, no others")),
        (row.input is None and row.reads is not None, "reads", Message("what it reads belongs to an input")),
        (row.input is not None and not _known(raw, row.input), "input", Message("the machine has no such input")),
        (row.input is not None and row.do in LOOKING, "input", Message("it looks at the tool sensors")),
        ((row.delay_s or 0.0) >= row.limit_s, "limit_s", Message("the time limit must be longer than the delay")),
        (row.do in (*LOOKING, "chuck") and row.part is None, "part", Message("it belongs to old or to new")),
    )
    for is_wrong, key, reason in wrong:
        if is_wrong:
            at = (key,) if getattr(row, key) is not None else ()
            named = Message("tool_change step {n}: {why}", n=index + 1, why=reason)
            raise source.error(named, "tool_change", index, *at)
    return ChangeStep(
        row.do, row.limit_s, row.fault, row.part or "", row.to or "", row.level or 0, row.delay_s or 0.0,
        row.input or "", 1 if row.reads is None else row.reads, row.in_turn,
    )  # fmt: skip


def _known(raw: MachineFile, name: str) -> bool:
    """Whether a machine has this input, or one of the name for each of its spindles."""
    names = {row.name for row in raw.input}
    heads = len(raw.drill.axes) if raw.drill else 0
    return name in names or (heads > 0 and all(f"{name}_{number}" in names for number in range(1, heads + 1)))
