"""What the router cuts between M15 and M16. Rule: a cut of straight lines can be milled as slots, one a line; one with
an arc, with compensation or in a pattern is counted alone.

machine.py fills the list as the router moves; `milled` makes slots of it, for whoever mills.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from .model import Cuts, DrillFile, Floats, FormatChoice
from .tools import NO_TOOL

# at: (end, axis, reading); mm: as of rows.py; before: holes and slots of the file before it.
LINE = np.dtype([("at", "f8", (2, 2, 3)), ("mm", "f8"), ("tool", "i8"), ("line", "i8"), ("before", "i8")])


@dataclass
class Cut:
    """One cut, line by line; ``straight``: whether it can be milled."""

    straight: bool = True
    lines: list[tuple[Floats, float, int, int, int]] = field(default_factory=list)  # as of LINE


class Router:
    """The cuts of a program so far, and how the router goes on."""

    def __init__(self) -> None:
        self.cuts: list[Cut] = []
        self.arc = self.compensated = False

    def begin(self) -> None:
        """The router goes down."""
        self.cuts.append(Cut())

    def go(self, start: Floats, end: Floats, mm: float, tool: int, line: int, before: int) -> None:
        """The router goes on in the board; ``before``: holes and slots of the file so far."""
        cut = self.cuts[-1]
        cut.straight &= not (self.arc or self.compensated or tool == NO_TOOL)
        cut.lines.append((np.stack([start, end]), mm, tool, line, before))

    def copied(self) -> None:
        """A pattern is drilled again: its cuts are not, so that none can be milled."""
        for cut in self.cuts:
            cut.straight = False

    def measured(self, choice: FormatChoice, slot: np.ndarray) -> Cuts:
        """The straight cuts in millimetres; ``slot`` (rows,): which rows of the file are slots and no holes."""
        straight = [cut for cut in self.cuts if cut.straight and cut.lines]
        lines = np.array([line for cut in straight for line in cut.lines], LINE)
        holes = np.concatenate([[0], np.cumsum(~slot)])
        mm = choice.lengths_mm(lines["at"], lines["mm"]).reshape(-1, 4)
        return Cuts(mm, lines["tool"], lines["line"], holes[lines["before"]], len(straight))


def milled(drill_file: DrillFile) -> DrillFile:
    """The file with its straight cuts as slots, each in its place; ``routs`` are then the cuts that are left."""
    cuts = drill_file.cuts
    if cuts is None or not len(cuts.mm):
        return drill_file
    at = np.concatenate([drill_file.slot_at, cuts.at])
    line = np.concatenate([drill_file.slot_line, cuts.line])
    order = np.lexsort((line, at))
    left = drill_file.routs - cuts.made
    over = {"no-holes"} if left else {"no-holes", "routs-not-drilled"}
    kept = tuple(each for each in drill_file.warnings if each.code not in over)
    return replace(
        drill_file,
        slot_mm=np.concatenate([drill_file.slot_mm, cuts.mm])[order],
        slot_tool=np.concatenate([drill_file.slot_tool, cuts.tool])[order],
        slot_line=line[order],
        slot_at=at[order],
        routs=left,
        warnings=kept,
        cuts=None,
    )
