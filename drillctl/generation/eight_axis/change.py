"""The steps of a tool change as records: by the rows of the machine's table, or by hand at the parking place.

Rule: each step begins with its KMD_KROK, so that the status names it. The records that open or close a chuck, and
those that look whether the tool went, carry the tool's number, negative, as their tag (transfers.py).
"""

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np

from drillctl.generation.eight_axis.magazine import EMPTY, place_of
from drillctl.generation.pcb_drill.program import gotos, switch
from drillctl.generation.sequences import Change, Records, record
from drillctl.generation.worklist import positioning_axes
from drillctl.kmd import Op
from drillctl.kmd.commands import Flag
from drillctl.machine import Machine
from drillctl.machine.head_lines import FOOT
from drillctl.machine.tool_change import IN_TURN, NEW, OLD, PARKING, ChangeStep

CHUCK, SENSOR = "chuck_{}", "tool_{}"


class ChangeMaker:
    """Makes the records for a machine whose working base lies at ``base_steps``."""

    def __init__(self, machine: Machine, base_steps: tuple[int, int]):
        self._machine = machine
        self._base = base_steps
        self._outputs = dict(machine.outputs)
        self._inputs = {line.name: line.bit for line in machine.input_lines}

    def automatic(self, old: int, new: int, spindles: Sequence[int]) -> list[Records]:
        """The steps that leave the tool ``old`` and take ``new``, 0 for none, with these spindles."""
        changer = self._machine.tool_changer
        assert changer is not None
        tools = {OLD: old, NEW: new}
        wanted = [(n, step) for n, step in enumerate(changer.steps, start=1) if tools.get(step.part, -1) != 0]
        parts: list[Records] = []
        for turn, rows in groupby(wanted, key=lambda row: row[1].in_turn and changer.order == IN_TURN):
            block = list(rows)
            for chosen in [[spindle] for spindle in spindles] if turn else [spindles]:
                for number, step in block:
                    parts += [record(Op.KROK, [number]), *self._step(step, tools.get(step.part, 0), chosen)]
                    parts += self._answered(step, chosen)
                    if old == EMPTY and number == wanted[0][0]:
                        parts += self._chucks(spindles, 1)  # nothing can fall out
        return [*parts, record(Op.KROK, [0])]

    def by_hand(self, number: int, change: Change, tool: int) -> list[Records]:
        """The heads home, the foot up, to the parking place; the operator is asked there for the file's tool."""
        return [
            record(Op.WIERTLO_DOM), *switch(self._outputs.get(FOOT), 0), self.parked(),
            record(Op.NARZEDZIE, [number, change, tool]), *switch(self._outputs.get(FOOT), 1),
        ]  # fmt: skip

    def parked(self) -> Records:
        """X and Y to the parking place."""
        return gotos(np.array([self._place(PARKING, 0)], np.int64), self._machine)

    def _step(self, step: ChangeStep, tool: int, spindles: Sequence[int]) -> Iterator[Records]:
        if step.do == "home":
            yield record(Op.WIERTLO_DOM)
        elif step.do == "foot":
            yield from switch(self._outputs.get(FOOT), step.level)
        elif step.do in ("x", "y", "xy"):
            yield self._travel(step, tool, spindles)
        elif step.do == "height":
            yield self._lowered(spindles)
        elif step.do == "chuck":
            yield from (_of_tool(part, tool) for part in self._chucks(spindles, step.level))
        elif step.do == "delay":
            yield record(Op.CZEKAJ, [round(step.delay_s * self._machine.tick_hz)])
        else:
            looks = self._look(spindles, int(step.do == "taken"), self._limit(step))
            yield from (_of_tool(part, tool) for part in looks)

    def _answered(self, step: ChangeStep, spindles: Sequence[int]) -> list[Records]:
        """Waits until what answers to a step has done so."""
        if not step.input:
            return []
        own = [self._inputs.get(step.input)]
        bits = [self._inputs[f"{step.input}_{n}"] for n in spindles] if own == [None] else own
        return [record(Op.CZEKAJ_WE, [bit or 0, step.reads, self._limit(step)]) for bit in bits]

    def _limit(self, step: ChangeStep) -> int:
        """The time limit of a step in ticks."""
        return max(1, round(step.limit_s * self._machine.tick_hz))

    def _travel(self, step: ChangeStep, tool: int, spindles: Sequence[int]) -> Records:
        changer = self._machine.tool_changer
        assert changer is not None
        shift_mm = changer.shift_mm(spindles[0]) if changer.order == IN_TURN and step.to != PARKING else 0.0
        x_steps, y_steps = self._place(step.to, tool, shift_mm)
        axes = positioning_axes(self._machine)
        args, mask = [0] * len(self._machine.axes), 0
        for axis, name, steps in zip(axes, "xy", (x_steps, y_steps), strict=True):
            if name in step.do:
                args[axis], mask = steps, mask | 1 << axis
        return record(Op.RUCH, args, mask, Flag.ABSOLUTE)

    def _place(self, to: str, tool: int, shift_mm: float = 0.0) -> tuple[int, int]:
        """X and Y, in steps from the working base, of the parking place or of a tool's place in the magazine."""
        parameters = self._machine.parameters
        assert parameters is not None
        if to == PARKING:
            at_mm = [parameters.number("system", f"parking_{name}_mm") for name in "xy"]
        else:
            row = parameters.place(place_of(self._machine, tool))
            at_mm = [row.number(f"{name}_mm") if row else None for name in "xy"]
        shifted = (at_mm[0] or 0.0) + shift_mm, at_mm[1] or 0.0
        axes = (self._machine.axes[axis] for axis in positioning_axes(self._machine))
        x, y = (
            round(mm * table.steps_per_mm) - base for mm, table, base in zip(shifted, axes, self._base, strict=True)
        )
        return x, y

    def _lowered(self, spindles: Sequence[int]) -> Records:
        parameters = self._machine.parameters
        assert parameters is not None
        args, mask = [0] * len(self._machine.axes), 0
        for spindle in spindles:
            axis = self._machine.drill_axes[spindle - 1]
            height_mm = parameters.number("system", "change_height_mm") or 0.0
            args[axis], mask = round(height_mm * self._machine.axes[axis].steps_per_mm), mask | 1 << axis
        return record(Op.RUCH, args, mask, Flag.ABSOLUTE)

    def _chucks(self, spindles: Sequence[int], level: int) -> list[Records]:
        bits = dict.fromkeys(self._outputs.get(CHUCK.format(n), self._outputs.get("chuck")) for n in spindles)
        return [record(Op.WYJSCIE, [bit, level]) for bit in bits if bit is not None]

    def _look(self, spindles: Sequence[int], level: int, ticks: int) -> list[Records]:
        """Waits for the tool sensors; on a machine without any, the step is over at once."""
        bits = [self._inputs[SENSOR.format(n)] for n in spindles if SENSOR.format(n) in self._inputs]
        return [record(Op.CZEKAJ_WE, [bit, level, ticks]) for bit in bits] or [record(Op.CZEKAJ, [1])]


def _of_tool(part: Records, tool: int) -> Records:
    part["tag"] = -tool
    return part
