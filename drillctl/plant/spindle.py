"""A spindle that its converter brings to the speed in a word of the outputs, and whose speed is a word of the inputs.

Rule: it turns where it is switched on (the output ``spindle``, on a machine that has one) and a speed is wanted.
"""

from drillctl.machine import Machine
from drillctl.machine.levels import SPEED_ACTUAL, SPEED_WANTED, Word


class Spindle:
    """``rev_min`` is its speed, ``rate`` by how much that can change in a second."""

    def __init__(self, wanted: Word, actual: Word, switch: int, rate: float):
        self._wanted, self._actual, self._switch = wanted, actual, switch
        self.rate = rate
        self.rev_min = 0.0

    def asked(self, image: int) -> int:
        """Returns the speed, in rev/min, that an output image asks for."""
        on = not self._switch or image & self._switch
        return self._wanted.value(image) if on else 0

    def at_once(self, image: int, inputs: int) -> int:
        """Takes the speed that is asked for, and returns the input image with it: a spindle without inertia."""
        self.rev_min = float(self.asked(image))
        return self._shown(inputs)

    def turn(self, image: int, inputs: int, seconds: float) -> int:
        """Comes nearer to what is asked for, for so long; returns the input image with its speed."""
        asked, most = self.asked(image), self.rate * seconds
        self.rev_min += max(-most, min(most, asked - self.rev_min))
        return self._shown(inputs)

    def turns_on(self, image: int) -> bool:
        """Whether it has not come to the speed that is asked for."""
        return self.rev_min != self.asked(image)

    def _shown(self, inputs: int) -> int:
        return self._actual.put(inputs, min(round(self.rev_min), self._actual.greatest))


def spindle_of(machine: Machine) -> Spindle | None:
    """Returns the spindle of a machine that has both words; None for another."""
    wanted, actual = machine.output_word(SPEED_WANTED), machine.input_word(SPEED_ACTUAL)
    if wanted is None or actual is None:
        return None
    switch = sum(1 << bit for name, bit in machine.outputs if name == "spindle")
    return Spindle(wanted, actual, switch, machine.surroundings.spindle_rev_min_s)
