"""What a sequence of KMD commands means: which of them drill a hole, where a tool is changed, what a dry run omits.

Rule: a hole is what a stroke down with a tag begins and the next stroke up ends; commands with the same tag before the
stroke belong to it (pecks, spots). Whoever reads a program for its holes asks here.
"""

from enum import IntFlag

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd import RECORD, Op
from drillctl.kmd.commands import Flag

Records = NDArray[np.void]


class Change(IntFlag):
    """How a tool is changed: the second argument of KMD_NARZEDZIE, which execution does not read."""

    NONE = 0
    AUTOMATIC = 1  # by the machine
    RENEWED = 4  # an operator puts a new bit in for a tool of the machine
    WITHIN = 2  # among the holes of one tool of the file: another bit of the same diameter


LOWERING = (Op.WIERTLO_DOL, Op.RUCH, Op.DOTYK)  # a board's program moves its heads by these
LIFTING = (Op.WIERTLO_GORA, Op.GORA_X_Y)  # and raises them by these, which end a hole


def record(op: Op, args: list[int] | None = None, axes: int = 0, flags: Flag = Flag.NONE) -> Records:
    """One command, shape (1,), dtype RECORD."""
    made = np.zeros(1, dtype=RECORD)
    made["opcode"], made["axes"], made["flags"] = op, axes, flags
    made["args"][0, : len(args or [])] = args or []
    return made


def numbered(parts: list[Records]) -> Records:
    """The commands one after the other, with sequence numbers from 1."""
    program = np.concatenate(parts)
    program["sequence"] = np.arange(1, len(program) + 1)
    return program


def holes(program: Records) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """For each stroke that drills a numbered hole, in order: the index of its first command, and the index behind the
    stroke up that ends it.
    """
    tag, opcode = program["tag"], program["opcode"]
    downs = np.flatnonzero((opcode == Op.WIERTLO_DOL) & (tag > 0))
    ups = np.append(np.flatnonzero(np.isin(opcode, LIFTING)), len(program) - 1)
    firsts = np.flatnonzero(np.append(True, tag[1:] != tag[:-1]))
    begins = firsts[np.searchsorted(firsts, downs, side="right") - 1]
    return begins, ups[np.searchsorted(ups, downs)] + 1


def tool_changes(program: Records) -> NDArray[np.intp]:
    """The indices of the commands that change a tool, one for each tool of the file."""
    within = program["args"][:, 1] & Change.WITHIN > 0
    return np.flatnonzero((program["opcode"] == Op.NARZEDZIE) & ~within)


def asked_changes(program: Records) -> NDArray[np.intp]:
    """The indices of the commands before which an operator changes a tool by hand."""
    automatic = program["args"][:, 1] & Change.AUTOMATIC > 0
    return np.flatnonzero((program["opcode"] == Op.NARZEDZIE) & ~automatic)


def drill_up(program: Records) -> Records:
    """The same way with the drill up: strokes down are left out, heads go up all the way, and no tool is changed."""
    left_out = np.isin(program["opcode"], (*LOWERING, Op.NARZEDZIE, Op.SUW, Op.KROK)) | _in_steps(program)
    kept = program[~left_out].copy()
    return numbered([kept[:1], record(Op.WIERTLO_GORA), kept[1:]])


def _in_steps(program: Records) -> NDArray[np.bool_]:
    """Which commands belong to a step of a tool change, (n,)."""
    begins = program["opcode"] == Op.KROK
    latest = np.maximum.accumulate(np.where(begins, np.arange(len(program)), -1))
    in_step: NDArray[np.bool_] = (latest >= 0) & (program["args"][latest, 0] > 0)
    return in_step


def holes_passed(program: Records, done: int) -> int:
    """How many numbered holes the head has been over once so many commands are done, drilled or not."""
    tags = program["tag"][:done]
    return len(set(tags[tags > 0].tolist()))
