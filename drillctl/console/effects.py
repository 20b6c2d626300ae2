"""What a change of a machine's file will do, in figures of the machine, before it is saved.

Rule: a figure is a row of a table, worked out for the machine as it is and as it would be; equal ones are not told.
"""

from collections.abc import Callable, Iterator

from drillctl.language import Counted, Message
from drillctl.machine import AxisTable, Machine
from drillctl.machine.travel import travel_ticks

MM_PER_INCH = 25.4
MS_PER_S = 1000
OfAxis = Callable[[Machine, AxisTable], str]


def _fastest(machine: Machine, axis: AxisTable) -> str:
    return f"{machine.tick_hz / min(axis.ramp.interval) / axis.columns_per_inch * MM_PER_INCH:.2f} mm/s"


def _step(machine: Machine, axis: AxisTable) -> str:
    return f"{1 / axis.steps_per_mm:.4f} mm"


def _range(machine: Machine, axis: AxisTable) -> str:
    return f"{axis.low_steps / axis.steps_per_mm:.2f}..{axis.high_steps / axis.steps_per_mm:.2f} mm"


def _longest_stroke(machine: Machine) -> str:
    return Counted("{count} tick", "{count} ticks", machine.longest_drilling_ticks)


def _through(machine: Machine, axis: AxisTable) -> str:
    return f"{travel_ticks(axis.ramp, axis.span_steps, 0, axis.columns_per_step) / machine.tick_hz:.2f} s"


OF_AXES: tuple[tuple[Message, OfAxis], ...] = (
    (Message("phase table"), lambda _machine, axis: axis.phase.name),
    (Message("ramp"), lambda _machine, axis: axis.ramp.name),
    (Message("fastest travel"), _fastest),
    (Message("length of a step"), _step),
    (Message("work range"), _range),
    (Message("way through the whole range"), _through),
)
OF_MACHINES: tuple[tuple[Message, Callable[[Machine], str]], ...] = (
    (Message("time between two ticks"), lambda machine: f"{MS_PER_S / machine.tick_hz:.4g} ms"),
    (Message("longest stroke before a fault"), _longest_stroke),
)


def effects(before: Machine, after: Machine) -> list[Message]:
    """A sentence for each figure that changes: of the machine, then axis by axis."""
    return [*_of_machine(before, after), *_of_axes(before, after)]


def _of_machine(before: Machine, after: Machine) -> Iterator[Message]:
    for what, figure in OF_MACHINES:
        if (was := figure(before)) != (will_be := figure(after)):
            yield Message("{what}: {before} now, then {after}", what=what, before=was, after=will_be)


def _of_axes(before: Machine, after: Machine) -> Iterator[Message]:
    for one, other in zip(before.axes, after.axes, strict=False):
        for what, figure in OF_AXES:
            if (was := figure(before, one)) != (will_be := figure(after, other)):
                name = other.name.upper()
                yield Message(
                    "{axis}: {what}: {before} now, then {after}", axis=name, what=what, before=was, after=will_be
                )
