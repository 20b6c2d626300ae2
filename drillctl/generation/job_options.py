"""The options of a job: one record, made by the verbs and by the console, from which the same job can be made again.

Rule: nothing but what JSON can hold; a journal keeps it as it is, and whoever resumes reads it back. Options are named
as on the command line. What generation works with (placing, drills) is made from it by ``wishes``.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np

from drillctl.generation import alignment
from drillctl.generation.alignment import Alignment
from drillctl.generation.choices import AfterEnd, Mirror, Order, Origin
from drillctl.generation.drills import read_drills
from drillctl.generation.errors import JobError
from drillctl.generation.measured import MAX_MM
from drillctl.generation.placing import Affine, Panel, Placing
from drillctl.generation.wishes import Wishes
from drillctl.generation.worklist import positioning_axes
from drillctl.language import Message, message_of
from drillctl.machine import Machine
from drillctl.machine.shape import Steps, TickHz

FilePath = Annotated[str, msgspec.Meta(min_length=1, pattern=r"\A[^\x00]*\Z")]  # no argument of a program has a NUL
BAD_VALUES = (msgspec.ValidationError, UnicodeEncodeError)  # the latter: half of a surrogate pair, as JSON can hold
Millimetres = Annotated[float, msgspec.Meta(ge=-MAX_MM, le=MAX_MM)]
MeasuredRow = tuple[Millimetres, Millimetres, Millimetres, Millimetres]  # file_x, file_y, machine_x, machine_y


class JobOptions(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a job is made by, beside its drill file. Paths are absolute. The types are what the command line takes.

    align  an alignment file, or the measured holes themselves
    panel  columns, rows, pitch in X and Y (mm)
    base   the working base, X and Y in steps from machine zero
    store  the file of a store of workpieces, instead of the machine's own RAM
    """

    machine: FilePath
    tables: FilePath | None = None
    tick_hz: TickHz | None = None
    origin: Origin | None = None
    mirror: Mirror | None = None
    rotate: float = 0.0
    offset: tuple[float, float] = (0.0, 0.0)
    align: FilePath | tuple[MeasuredRow, ...] | None = None
    panel: tuple[int, int, float, float] | None = None
    order: Order = "file"
    skip_tools: tuple[int, ...] = ()
    drills: FilePath | None = None
    peck: float | None = None
    spot: float | None = None
    format: str | None = None
    after_end: AfterEnd = "refuse"
    base: tuple[Steps, Steps] = (0, 0)
    store: FilePath | None = None

    @classmethod
    def of_journal(cls, told: Mapping[str, Any], journal: Path) -> "JobOptions":
        """From the first line of a journal. Raises JobError for what the command line would not take."""
        try:
            return cls.checked(told)
        except BAD_VALUES as error:
            reason = Message(
                "its options were written by another version of this program, or altered: {why}", why=message_of(error)
            )
            raise JobError(reason.at(journal, 1)) from error

    @classmethod
    def checked(cls, told: Mapping[str, Any]) -> "JobOptions":
        """From its fields by name. Raises msgspec.ValidationError for what the command line would not take."""
        return msgspec.convert(told, cls)

    def as_journalled(self) -> dict[str, Any]:
        """The fields by name, as a journal keeps them and ``of_journal`` reads them."""
        return msgspec.to_builtins(self)

    def reading(self) -> tuple[str | None, str]:
        """How the drill file is read: its format, and what becomes of holes behind M30."""
        return self.format, self.after_end

    def alignment(self) -> Alignment | None:
        """What the measured holes say; a mirror asked for beside them means that the board lies face down.

        Raises AlignmentError.
        """
        if self.align is None:
            return None
        face_down = self.mirror is not None
        if isinstance(self.align, str):
            return alignment.load(Path(self.align), mirrored=face_down)
        rows = np.array(self.align, np.float64).reshape(-1, 4)
        return alignment.fit(rows[:, :2], rows[:, 2:], mirrored=face_down)

    def wishes(self, machine: Machine) -> Wishes:
        """What generation works with: the placing, the drills read from their file. Raises JobError, PlacingError or
        AlignmentError.
        """
        drills = read_drills(Path(self.drills)) if self.drills else None
        skipped = frozenset(self.skip_tools)
        store = Path(self.store) if self.store else None
        return Wishes(self._placing(machine), self.order, skipped, drills, self.peck, self.spot, self.base, store)

    def _placing(self, machine: Machine) -> Placing:
        aligned = self.alignment()
        return Placing(
            origin=self.origin,
            mirror=None if aligned else self.mirror,
            rotate_deg=self.rotate,
            offset_mm=self.offset,
            panel=None if self.panel is None else Panel(*self.panel),
            alignment=aligned.affine.then(self._to_base(machine)) if aligned else None,
        )

    def _to_base(self, machine: Machine) -> Affine:
        """Holes are measured from machine zero, and drilled from the working base."""
        axes = positioning_axes(machine)
        scale = [machine.axes[axis].steps_per_mm for axis in axes]
        return Affine.of(np.eye(2), -np.array(self.base) / np.array(scale))
