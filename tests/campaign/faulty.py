"""drillctl on a simulated card that fails as planned, with a witness: run as a program of its own, by the campaign.

    python tests/campaign/faulty.py WITNESS PLAN VERB ...      PLAN as JSON, {} for a card that does not fail

Rule: nothing of the product is changed but the card behind the port (and the disk under its journal). The witness is
a file that the plant itself writes to, so that it knows what was drilled even if everybody else is dead.
"""

import errno
import json
import os
import sys
from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import Any

from drillctl.cli import main
from drillctl.jobs.journal import writer
from drillctl.plant import IdealPlant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import SAFE_IMAGE
from drillctl.ticker import launch as machinery

Plan = dict[str, Any]


class FaultyCard(SimulatedCard):
    """A simulated card. From flush ``from_flush`` on, for ``flushes`` of them, what the plan says:

    pulled    the port raises OSError at every call, its outputs staying as they are
    stuck     the input bit ``bit`` reads ``level``
    bouncing  the input bit ``bit`` reads the other way at every second latch
    """

    def __init__(self, plant: IdealPlant, plan: Plan, witness: int):
        super().__init__(plant)
        self._plan, self._witness = plan, witness
        self._flushes = self._touches = 0
        self._told = False

    def latch(self) -> int:
        image = super().latch()
        if not self._fails():
            return image
        if self._plan["fails"] == "stuck":
            bit = 1 << self._plan["bit"]
            return image | bit if self._plan["level"] else image & ~bit
        return image ^ (self._flushes & 1) << self._plan["bit"]

    def flush(self, image: int) -> None:
        self._flushes += 1
        self._fails()
        super().flush(image)
        if self.plant.touches != self._touches:
            self._touches = self.plant.touches
            self._tell("touch")

    def safe(self, image: int = SAFE_IMAGE) -> None:
        if self._flushes:  # in the process that ticked: the others' plants stand where they stood at the fork
            self._tell("safe")
        super().safe(image)

    def _fails(self) -> bool:
        """Whether it is time to fail; tells of the first time. Raises OSError where the port is pulled."""
        first, count = self._plan.get("from_flush", 0), self._plan.get("flushes", 0)
        failing = first <= self._flushes < first + count
        if failing and not self._told:
            self._told = True
            self._tell("fails")
        if failing and self._plan["fails"] == "pulled":
            raise OSError(errno.EIO, "the port was pulled")
        return failing

    def _tell(self, what: str) -> None:
        places = " ".join(f"{self.plant.position_steps(axis):.1f}" for axis in range(len(self.plant.rotors)))
        os.write(self._witness, f"{what} {places}\n".encode())


def full_disk(lines: int, room_bytes: int, witness: int) -> Callable[[int, bytes], int]:
    """An ``os.write`` that takes so many lines, a piece of the next, and then no more."""
    left = [lines]

    def write(handle: int, data: bytes) -> int:
        left[0] -= 1
        if left[0] >= 0:
            return os.write(handle, data)
        os.write(witness, b"fails 0 0 0\n")
        if left[0] == -1 and room_bytes:
            return os.write(handle, data[:room_bytes])
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    return write


def run(witness_file: str, plan: Plan, arguments: list[str]) -> int:
    """One run of the program, to its exit code."""
    witness = os.open(witness_file, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    setattr(machinery, "SimulatedCard", partial(FaultyCard, plan=plan, witness=witness))  # noqa: B010  of another type
    if plan.get("fails") == "disk":
        real = {name: getattr(os, name) for name in dir(os)}
        full = full_disk(plan["lines"], plan["room_bytes"], witness)
        setattr(writer, "os", SimpleNamespace(**real | {"write": full}))  # noqa: B010  nor is this a module
    return main(arguments)


if __name__ == "__main__":
    sys.exit(run(sys.argv[1], json.loads(sys.argv[2]), sys.argv[3:]))
