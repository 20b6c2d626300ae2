"""What a job is made by, beside its drill file: the options that a person set, the machine, its working base.

Rule: nothing but what JSON can hold; a journal keeps it as it is, and whoever resumes makes the same job from it.
What the work list is built from (placing, drills) is made from it by ``work_settings``.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from drillctl.generation import alignment
from drillctl.generation.alignment import Alignment
from drillctl.generation.drills import read_drills
from drillctl.generation.errors import JobError
from drillctl.generation.placing import Affine, Panel, Placing
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import positioning_axes
from drillctl.language import Message, message_of
from drillctl.machine import Machine
from drillctl.machine.shape import Steps, TickHz
from drillctl.viewmodel.job_options import FilePath, JobOptions

BAD_VALUES = (msgspec.ValidationError, UnicodeEncodeError)  # the latter: half of a surrogate pair, as JSON can hold


class JobSetup(msgspec.Struct, frozen=True):
    """The options of a job, and what they are applied to. Paths are absolute.

    machine  its name in the library, or its file
    tables   the folder that is searched for its tables before the library's own
    tick_hz  None: the machine's own rate
    base     the working base, X and Y in steps from machine zero
    """

    machine: FilePath
    options: JobOptions = JobOptions()
    tables: FilePath | None = None
    tick_hz: TickHz | None = None
    base: tuple[Steps, Steps] = (0, 0)

    @classmethod
    def of_journal(cls, fields: Mapping[str, Any], journal: Path) -> "JobSetup":
        """From the first line of a journal. Raises JobError for what the command line would not take."""
        try:
            return cls.checked(fields)
        except BAD_VALUES as error:
            reason = Message(
                "its options were written by another version of this program, or altered: {why}", why=message_of(error)
            )
            raise JobError(reason.at(journal, 1)) from error

    @classmethod
    def checked(cls, fields: Mapping[str, Any]) -> "JobSetup":
        """From its fields and its options in one mapping, by the names of the command line. Raises
        msgspec.ValidationError for what the command line would not take.
        """
        own = {name: fields[name] for name in cls.__struct_fields__ if name in fields and name != "options"}
        options = {name: value for name, value in fields.items() if name not in own}
        return msgspec.convert({**own, "options": options}, cls)

    def as_journalled(self) -> dict[str, Any]:
        """Its fields and its options in one mapping, as a journal keeps them and ``of_journal`` reads them."""
        fields = msgspec.to_builtins(self)
        options = fields.pop("options")
        return {**fields, **options}

    def as_ordered(self, order_steps: int | None) -> "JobSetup":
        """The setup that makes a job again whose search for an order was cut short after so many steps; the same for
        None. A clock would cut it elsewhere the next time.
        """
        if order_steps is None:
            return self
        ordered = msgspec.structs.replace(self.options, order_seconds=None, order_steps=order_steps)
        return msgspec.structs.replace(self, options=ordered)

    def reading(self) -> tuple[str | None, str]:
        """How the drill file is read: its format, and what becomes of holes behind M30."""
        return self.options.format, self.options.after_end

    def alignment(self) -> Alignment | None:
        """The map found from the measured holes, None without any; a mirror asked for beside them means that the
        board lies face down. Raises AlignmentError.
        """
        align, face_down = self.options.align, self.options.mirror is not None
        if align is None:
            return None
        if isinstance(align, str):
            return alignment.load(Path(align), mirrored=face_down)
        rows = np.array(align, np.float64).reshape(-1, 4)
        return alignment.fit(rows[:, :2], rows[:, 2:], mirrored=face_down)

    def work_settings(self, machine: Machine) -> WorkSettings:
        """What the work list is built from: the placing, the drills read from their file. Raises JobError,
        PlacingError or AlignmentError.
        """
        options = self.options
        return WorkSettings(
            placing=self._placing(machine),
            order=options.order,
            skip_tools=frozenset(options.skip_tools),
            drills=read_drills(Path(options.drills)) if options.drills else None,
            peck_mm=options.peck_mm,
            spot_mm=options.spot_mm,
            base_steps=self.base,
            mill=options.mill,
            pins=options.pins,
            face_down=options.mirror is not None,
            store=Path(options.store) if options.store else None,
            spindles=options.spindles,
            order_seconds=options.order_seconds,
            order_steps=options.order_steps,
        )

    def _placing(self, machine: Machine) -> Placing:
        options, aligned = self.options, self.alignment()
        return Placing(
            origin=options.origin,
            mirror=None if aligned else options.mirror,
            rotate_deg=options.rotate_deg,
            offset_mm=options.offset_mm,
            pinned=options.pins is not None,
            panel=None if options.panel is None else Panel(*options.panel),
            alignment=aligned.affine.then(self._to_base(machine)) if aligned else None,
        )

    def _to_base(self, machine: Machine) -> Affine:
        """Holes are measured from machine zero, and drilled from the working base."""
        axes = positioning_axes(machine)
        scale = [machine.axes[axis].steps_per_mm for axis in axes]
        return Affine.of(np.eye(2), -np.array(self.base) / np.array(scale))
