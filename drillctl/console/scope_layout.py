"""Which lanes the scope has for a machine, in what order, and which of them an event shows in.

Rule: the lanes are those of the VCD form (ticker/sampler.py), the command above them, what else was recorded below.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

from drillctl.machine import Machine
from drillctl.ports import CARD_BITS
from drillctl.ticker.sampler import vcd_layout
from drillctl.trace import Signal, VcdVar
from drillctl.trace.lanes import Lane
from drillctl.viewmodel.scope import Find, ScopeSignal, Shape

KMD, RUN, SENSORS, OUTPUTS, POSITION = "kmd", "run", "sensors", "outputs", "position"
SHAPES: dict[str, Shape] = {"wire": "wire", "integer": "count", "count": "count", "name": "words", "command": "words"}
Row = tuple[ScopeSignal, Lane]


class Landmark(NamedTuple):
    """The lanes that show an event. ``onset``: only a value other than 0 is one."""

    shows: Callable[[ScopeSignal], bool]
    onset: bool


LANDMARKS: dict[Find, Landmark] = {
    "step": Landmark(lambda signal: signal.name == POSITION, False),
    "command": Landmark(lambda signal: signal.group == KMD, True),
    "sensor": Landmark(lambda signal: signal.group == SENSORS, False),
    "request": Landmark(lambda signal: (signal.group, signal.name) == (RUN, "request"), True),
    "late": Landmark(lambda signal: (signal.group, signal.name) == (RUN, "late"), True),
    "fault": Landmark(lambda signal: (signal.group, signal.name) == (RUN, "fault"), True),
}


def lanes_of(machine: Machine, signals: Sequence[Signal]) -> list[Row]:
    """The lanes that can be drawn of these signals, from top to bottom."""
    index = {signal.name: number for number, signal in enumerate(signals)}
    layout = [var for var in vcd_layout(machine) if var.part is None and var.bits is None and var.source in index]
    shown = {var.source for var in layout}
    command = [(ScopeSignal(KMD, "command", "words"), Lane(index["kmd"]))] if "kmd" in index else []
    rest = [signal for signal in signals if signal.kind != "word" and signal.name not in {*shown, "kmd"}]
    return [
        *command,
        *(_lane_of(var, index) for var in layout),
        *_outputs(machine, index),
        *((ScopeSignal(RUN, signal.name, SHAPES[signal.kind]), Lane(index[signal.name])) for signal in rest),
    ]


def _lane_of(var: VcdVar, index: dict[str, int]) -> Row:
    return ScopeSignal(var.scope, var.name, SHAPES[var.kind]), Lane(index[var.source], var.bit, var.invert)


def _outputs(machine: Machine, index: dict[str, int]) -> Iterator[Row]:
    """A lane for each output that is no motor wire."""
    for name, bit in machine.outputs:
        card, place = divmod(bit, CARD_BITS)
        if f"out.{card}" in index:
            yield ScopeSignal(OUTPUTS, name, "wire"), Lane(index[f"out.{card}"], place)


def lanes_with(what: Find, signal: int, signals: Sequence[ScopeSignal]) -> Iterable[int]:
    """The lanes to search for an event: those of the signal's axis, if any, else all; ``change``: the signal's own."""
    if what == "change":
        return (signal,)
    found = [number for number, each in enumerate(signals) if LANDMARKS[what].shows(each)]
    of_axis = [number for number in found if signals[number].group == signals[signal].group]
    return of_axis or found
