"""What is known of measured holes, and of jobs that were opened or interrupted. Plain records; lengths in mm.

Rule: made by the console, drawn by the screens; what a person asks of a board is in job_options.py.
"""

import msgspec
import numpy as np
from msgspec.structs import replace
from numpy.typing import ArrayLike, NDArray

from drillctl.language import Message
from drillctl.viewmodel.job_options import JobOptions


class AlignmentReport(msgspec.Struct, frozen=True, eq=False):
    """What measured holes say. ``matrix`` (2, 3) takes the file's mm to mm from machine zero.

    kind         'rigid': shift and turn; 'affine': scale and shear as well
    residual_mm  of each measured hole; ``rejected``: why this can't be the board, nothing where it can
    """

    kind: str
    matrix: NDArray[np.float64]
    residual_mm: tuple[float, ...]
    turn_deg: float
    scale: tuple[float, float]
    warnings: tuple[Message, ...]
    rejected: tuple[Message, ...]

    def place_mm(self, file_xy_mm: ArrayLike) -> tuple[float, float]:
        """Where a hole is to be looked for, from machine zero."""
        x_mm, y_mm = self.matrix @ np.append(np.asarray(file_xy_mm, np.float64), 1.0)
        return float(x_mm), float(y_mm)


class RecentJob(msgspec.Struct, frozen=True):
    """A drill file that was opened, and how."""

    file: str
    options: JobOptions


class Site(msgspec.Struct, frozen=True):
    """Where a job is run, and how: two runs of one site meet the same machine.

    port   NAME[:ADDRESS], an address that is a file absolute
    pace   'free' or 'real'
    plant  as a trace's header has it: 'ideal', 'dynamic' with its faults, 'none' on a real port; ``seed`` is its own
    converter  of the spindle, TABLE:DEVICE; empty for none
    """

    port: str
    pace: str
    plant: str
    seed: int = 0
    converter: str = ""

    @property
    def real(self) -> bool:
        """A real machine stands behind the port."""
        return self.plant == "none"

    def __str__(self) -> str:
        return self.message

    @property
    def message(self) -> Message:
        """The site as a message: port, pace, plant and converter."""
        if self.converter:
            return Message("{site}, converter {name}", site=replace(self, converter="").message, name=self.converter)
        known = {"port": self.port, "pace": self.pace, "plant": self.plant, "seed": self.seed}
        if self.real:
            return Message("port {port}, pace {pace}", **known)
        if not self.seed:
            return Message("port {port}, pace {pace}, plant {plant}", **known)
        return Message("port {port}, pace {pace}, plant {plant}, seed {seed}", **known)


class UnfinishedJob(msgspec.Struct, frozen=True):
    """A job that was cut off, as its journal has it.

    again     holes that were under way, to be drilled again
    doubtful  the hole that may have been, by a torn last line; None where there is no doubt
    ran, here where it ran last, and where it would go on
    suspect   holes that are drilled and may be bad, since a bit was found broken after them
    """

    journal: str
    file: str
    machine: str
    holes_done: int
    holes_total: int
    again: tuple[int, ...]
    torn: bool
    spotted: bool
    doubtful: int | None
    ran: Site
    here: Site
    suspect: tuple[int, ...] = ()
