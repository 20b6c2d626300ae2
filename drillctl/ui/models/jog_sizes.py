"""How far a press of a jog key goes: a size in steps or one in millimetres. Used by the screens at the machine."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from drillctl.language.words import N_, _
from drillctl.viewmodel.console import AxisView

STEPS, MM = N_("steps"), N_("mm")
# In steps: a column, a rest, a cycle of pcb-drill's table, a tenth and an inch.
JOG_SIZES: Mapping[str, Sequence[float]] = {STEPS: (1, 3, 12, 120, 1200), MM: (0.1, 1, 10)}
FIRST_SIZES: Mapping[str, float] = {STEPS: 12, MM: 1}


@dataclass
class JogSizes:
    """The unit in use, and the size chosen in each."""

    unit: str = STEPS
    chosen: dict[str, float] = field(default_factory=lambda: dict(FIRST_SIZES))

    def change(self, by: int) -> None:
        """A greater or a smaller one; the ends stay."""
        sizes = JOG_SIZES[self.unit]
        index = sizes.index(self.chosen[self.unit]) + by
        self.chosen[self.unit] = sizes[min(max(index, 0), len(sizes) - 1)]

    def other_unit(self) -> None:
        """Each unit keeps its size."""
        self.unit = MM if self.unit == STEPS else STEPS

    def steps(self, axis: AxisView) -> int:
        """Of the size on an axis, at least one."""
        size = self.chosen[self.unit]
        return max(1, round(size * axis.steps_per_mm if self.unit == MM else size))

    def __str__(self) -> str:
        return _("jog step {size} {unit}").format(size=self.chosen[self.unit], unit=_(self.unit))
