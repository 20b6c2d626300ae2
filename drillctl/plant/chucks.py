"""The chucks of a machine's spindles, the bits in them, and the magazine whose places hold bits.

Rule: a chuck acts in the tick in which its output changes. Opened over a free place of the magazine at the change
height it leaves its bit there, elsewhere the bit is lost; closed over a place with a bit it takes it. What stands in a
place when a simulation begins is not known: the first action decides it, a place that is asked for a bit has one.
Without a magazine a person puts a new bit in while the chuck is open.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from drillctl.machine import Machine
from drillctl.machine.head_lines import CHUCK, TOOL, head_input, head_output
from drillctl.plant.answers import Answer, answers_of
from drillctl.plant.carriage import Line
from drillctl.plant.faults import Faults
from drillctl.plant.magazine import Bit, Magazine, magazine_of

PIECE_MM = 3.0  # by which a broken bit is shorter


@dataclass
class Chuck:
    """The chuck of one head, and the bit in it.

    number       of the spindle, from 1; ``axis`` is that of its head
    short_steps  the length that has broken off its bit; ``holes`` how often this bit has met the board
    breaks_at    at which of these its bit breaks; 0: it doesn't
    drops_at     which of the bits that it takes falls out on the way up; 0: none
    """

    axis: int
    number: int
    output: int
    tool: Line
    steps_per_mm: float
    breaks_at: int = 0
    drops_at: int = 0
    held: bool = True
    short_steps: float = 0.0
    holes: int = 0
    taken: int = 0
    slips: bool = False

    @property
    def whole(self) -> bool:
        """Whether it holds a bit that can drill."""
        return self.held and self.short_steps == 0.0

    def insert(self) -> None:
        """Takes a new bit."""
        self.held, self.short_steps, self.holes = True, 0.0, 0
        self.taken += 1
        self.slips = self.taken == self.drops_at

    def begin_hole(self) -> None:
        """Its bit has met the board."""
        self.holes += 1
        if self.holes == self.breaks_at:
            self.break_off()

    def break_off(self) -> None:
        """A piece of PIECE_MM breaks off its bit, which reaches the board that much later from now on."""
        self.short_steps = PIECE_MM * self.steps_per_mm


class Chucks:
    """All chucks of a machine, and the inputs that answer to their outputs and the presser foot's. ``outputs`` are the
    bits of these, ``slipping`` says that a bit may fall.
    """

    def __init__(self, chucks: Sequence[Chuck], magazine: Magazine | None, answers: Sequence[Answer] = ()):
        self._chucks = {chuck.axis: chuck for chuck in chucks}
        self._magazine, self._answers = magazine, answers
        self._image = self.outputs = 0
        for part in (*(chuck.output for chuck in chucks), *(answer.mask for answer in answers)):
            self.outputs |= part
        self.slipping = False

    def of(self, axis: int) -> Chuck | None:
        """Returns the chuck of a head by its axis, or None."""
        return self._chucks.get(axis)

    def shown(self, inputs: int) -> int:
        """Returns the input image with what the tool sensors and the answering inputs say."""
        for chuck in self._chucks.values():
            inputs = chuck.tool.put(inputs, chuck.held)
        for answer in self._answers:
            inputs = answer.shown(self._image, inputs)
        return inputs

    def switch(self, before: int, image: int, place_mm: Callable[[int], float]) -> None:
        """Opens and closes what has changed between two output images; ``place_mm`` says where an axis is."""
        for chuck in self._chucks.values():
            if (before ^ image) & chuck.output:
                (self._open if image & chuck.output else self._close)(chuck, place_mm)
        self._image = image
        self.slipping = any(chuck.slips for chuck in self._chucks.values())

    def lifted(self, axis: int, height_mm: float) -> bool:
        """Takes a head's new height; returns whether its bit has fallen out."""
        chuck = self._chucks.get(axis)
        if chuck is None or not chuck.slips or self._magazine is None or self._magazine.reached(height_mm):
            return False
        chuck.held = chuck.slips = False
        return True

    def _open(self, chuck: Chuck, place_mm: Callable[[int], float]) -> None:
        """The bit stays in the chuck only where the place that it is held into is taken."""
        if chuck.held:
            chuck.slips = False
            over = self._over(chuck, place_mm)
            chuck.held = over is not None and not self._put(over)

    def _close(self, chuck: Chuck, place_mm: Callable[[int], float]) -> None:
        if chuck.held:
            return
        over = self._over(chuck, place_mm)
        if self._magazine is None or (over is not None and self._magazine.take(over)):
            chuck.insert()

    def _over(self, chuck: Chuck, place_mm: Callable[[int], float]) -> Bit | None:
        return None if self._magazine is None else self._magazine.bit_under(chuck.number, chuck.axis, place_mm)

    def _put(self, bit: Bit) -> bool:
        return self._magazine is not None and self._magazine.put(bit)


def chucks_of(machine: Machine, known_faults: Faults | None = None) -> Chucks:
    """Returns the chucks of a machine, none of one whose heads have no output for them."""
    found = []
    for number, axis in enumerate(machine.drill_axes, start=1):
        output, table = head_output(machine, CHUCK, axis), machine.axes[axis]
        if output:
            line = Line.of(head_input(machine, TOOL, axis))
            breaks, drops = (_count(known_faults, kind, table.name) for kind in ("breaks", "dropped"))
            found.append(Chuck(axis, number, output, line, table.steps_per_mm, breaks, drops))
    return Chucks(found, magazine_of(machine, known_faults), answers_of(machine, known_faults))


def _count(known_faults: Faults | None, kind: str, head: str) -> int:
    """Returns which bit or hole a fault of a head is about, 0 for none."""
    return int((known_faults.of(kind, head) if known_faults else None) or 0)
