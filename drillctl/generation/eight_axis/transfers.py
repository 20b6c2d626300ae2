"""Which records of a program move a tool between chucks and magazine, so that the magazine's record can be kept.

Rule: read from the records alone: those of a step that sets chucks have the tool's number, negative, as their tag, and
so have those that look whether it went.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from drillctl.generation.eight_axis.change import CHUCK
from drillctl.generation.eight_axis.magazine import LEAVE, TAKE, Transfer, place_of
from drillctl.generation.sequences import Records
from drillctl.kmd import Op
from drillctl.machine import Machine


class Moved(NamedTuple):
    """A transfer with its first record, before which it is to be noted as begun, and the index behind the record that
    confirms it.
    """

    begin: int
    end: int
    transfer: Transfer


def transfers(program: Records, machine: Machine) -> Iterator[Moved]:
    """Yields the transfers of a program, in order."""
    tagged = np.flatnonzero(program["tag"] < 0)
    opcodes, tags = program["opcode"][tagged].tolist(), (-program["tag"][tagged]).tolist()
    at = 0
    while at < len(tagged):
        stop = at
        while stop < len(tagged) and tags[stop] == tags[at] and opcodes[stop] == Op.WYJSCIE:
            stop += 1
        end = stop
        while end < len(tagged) and tags[end] == tags[at] and opcodes[end] != Op.WYJSCIE:
            end += 1
        chucks = program["args"][tagged[at:stop]]
        kind = LEAVE if chucks[0, 1] else TAKE
        moved = Transfer(kind, tags[at], place_of(machine, tags[at]), _spindles(chucks[:, 0].tolist(), machine))
        yield Moved(int(tagged[at]), int(tagged[end - 1]) + 1, moved)
        at = end


def _spindles(bits: list[int], machine: Machine) -> tuple[int, ...]:
    outputs = dict(machine.outputs)
    numbers = range(1, len(machine.drill_axes) + 1)
    return tuple(n for n in numbers if outputs.get(CHUCK.format(n), outputs.get("chuck")) in bits)
