"""Inputs that answer to what the outputs have switched: the foot's upper end, the chucks, the drives of X and Y.

Rule: what is switched is there at once; the drives of X and Y say that they stand in their place whenever they are
looked at. A wire that is stuck says the same whatever happens.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from drillctl.machine import Machine
from drillctl.machine.head_lines import answering_inputs
from drillctl.plant.carriage import Line
from drillctl.plant.faults import Faults


@dataclass(frozen=True)
class Answer:
    """``line`` is on where the outputs ``mask`` stand at ``level``; with ``mask`` 0 always. ``stuck``: its wire is high
    or low whatever happens.
    """

    line: Line
    mask: int
    level: int
    stuck: float | None = None

    def shown(self, image: int, inputs: int) -> int:
        """Returns the input image with what it says of an output image."""
        if self.stuck is not None:
            return inputs | self.line.bit if self.stuck else inputs & ~self.line.bit
        return self.line.put(inputs, not self.mask or bool(image & self.mask) == bool(self.level))


def answers_of(machine: Machine, known_faults: Faults | None = None) -> Sequence[Answer]:
    """Returns the answers that a machine has inputs for."""
    lines = {line.name: line for line in machine.inputs}
    return tuple(
        Answer(Line.of(lines[name]), mask, level, known_faults.of("stuck", name) if known_faults else None)
        for name, mask, level in answering_inputs(machine)
    )
