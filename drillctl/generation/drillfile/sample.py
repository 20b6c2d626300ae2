"""The part of a file that formats are judged by: its digits, and some of its holes. Rule: nothing is chosen here.

recognise.py takes the sample once and lays it out under each format.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .layout import Layout
from .machine import Machine
from .model import MM_PER_UNIT, Floats, FormatChoice
from .rows import RowArray
from .score import SAMPLE_HOLES, Digits


@dataclass(frozen=True)
class Sample:
    """What candidates are judged by: digits, and some distinct holes with raw diameters.

    at (n, 2, 3) number triples and diameter (n,), each with its mm per unit, 0 where undeclared; places:
    decimals of the tools' diameters; decimals: how many numbers carry a point.
    """

    digits: Digits
    decimals: int
    at: Floats
    mm: Floats
    diameter: Floats
    diameter_mm: Floats
    places: int

    @classmethod
    def of(cls, machine: Machine) -> Sample:
        """At most SAMPLE_HOLES distinct holes, the first ones of every tool."""
        rows = _distinct(machine.rows.array())
        entries = machine.tools.entries
        tool = rows["tool"]
        return cls(
            digits=Digits.of(machine.evidence.whole, machine.evidence.length),
            decimals=machine.evidence.decimals,
            at=rows["at"][:, 0],
            mm=rows["mm"],
            diameter=np.array([entry.diameter or 0.0 for entry in entries] + [0.0])[tool],
            diameter_mm=np.array([entry.mm for entry in entries] + [0.0])[tool],
            places=max((entry.places for entry in entries), default=0),
        )

    @property
    def units(self) -> set[str]:
        """The declared units that its holes were written in."""
        return {units for units, mm in MM_PER_UNIT.items() if (self.mm == mm).any()}

    def xy_mm(self, choice: FormatChoice) -> Floats:
        """The holes (n, 2) in a format."""
        return choice.lengths_mm(self.at, self.mm)

    def layout(self, choice: FormatChoice) -> Layout:
        """The holes measured in a format."""
        return Layout.of(self.xy_mm(choice), self.diameters_mm(choice))

    def diameters_mm(self, choice: FormatChoice) -> Floats:
        """The drills (n,) in a format's units."""
        mm = np.where(self.diameter_mm > 0, self.diameter_mm, MM_PER_UNIT[choice.units])
        diameters: Floats = self.diameter * mm
        return diameters


def _distinct(rows: RowArray) -> RowArray:
    tools = sorted(set(rows["tool"].tolist()))  # np.unique would import numpy.ma, a tenth of a short verb's time
    share = max(SAMPLE_HOLES // max(1, len(tools)), 20)
    none = np.empty(0, dtype=np.int64)
    first = np.concatenate([none, *(np.flatnonzero(rows["tool"] == tool)[:share] for tool in tools)])
    some = rows[np.sort(first)][:SAMPLE_HOLES]
    # The same place written twice is no evidence; the same place reached by different digits is.
    _, kept = np.unique(some["at"][:, 0].reshape(-1, 6), axis=0, return_index=True)
    distinct: RowArray = some[np.sort(kept)]
    return distinct
