"""drillctl on a simulated card whose answers to a tool change come late, so that each step lasts: run as a program of
its own.

    python tests/campaign/late_answers.py WITNESS VERB ...

Rule: nothing of the product is changed but the card behind the port. The witness is a file that the plant itself writes
to: which chucks hold a bit.
"""

import os
import sys
from collections import deque
from functools import partial

from drillctl.cli import main
from drillctl.machine.head_lines import FOOT_UP, IN_PLACE, OPEN, TOOL
from drillctl.plant import Plant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ticker import launch as machinery

LATE_LATCHES = 800  # 0.1 s
HUNTS, IN_PLACE_FOR = 1600, 400  # latches: the drives say that they stand for so many of each


class LateCard(SimulatedCard):
    """Foot, chucks and tool sensors answer ``LATE_LATCHES`` after they have changed; the drives of X and Y hunt."""

    def __init__(self, plant: Plant, witness: int):
        super().__init__(plant)
        names = {line.name: 1 << line.bit for line in MACHINE.inputs}
        late = (FOOT_UP, *(f"{kind}_{n}" for kind in (OPEN, TOOL) for n in range(1, 7)))
        self._late = sum(names[name] for name in late)
        self._in_place = names[IN_PLACE]
        self._tools = [names[f"{TOOL}_{n}"] for n in range(1, 7)]
        self._seen: deque[tuple[int, int]] = deque()  # latch, and the late bits from then on
        self._shown, self._latches, self._witness = -1, 0, witness

    def latch(self) -> int:
        image = super().latch()
        self._latches += 1
        bits = image & self._late
        if self._shown < 0:
            self._shown = bits
            self._tell(image)
        if bits != (self._seen[-1][1] if self._seen else self._shown):
            self._seen.append((self._latches, bits))
            self._tell(image)
        while self._seen and self._latches - self._seen[0][0] >= LATE_LATCHES:
            self._shown = self._seen.popleft()[1]
        image = image & ~self._late | self._shown
        return image if self._latches % HUNTS < IN_PLACE_FOR else image & ~self._in_place

    def _tell(self, image: int) -> None:
        held = "".join("1" if image & bit else "0" for bit in self._tools)
        os.write(self._witness, f"held {held}\n".encode())


def run(witness_file: str, arguments: list[str]) -> int:
    """One run of the program, to its exit code."""
    witness = os.open(witness_file, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    setattr(machinery, "SimulatedCard", partial(LateCard, witness=witness))  # noqa: B010  of another type
    return main(arguments)


if __name__ == "__main__":
    from drillctl.machine import Library, shipped_tables

    MACHINE = Library((shipped_tables(),)).machine("eight-axis")
    sys.exit(run(sys.argv[1], sys.argv[2:]))
