"""What generation works with, made of a job's options: where the board lies, how it is drilled, the drills at hand.

Rule: plain values, checked here against themselves; against file and machine they are checked by worklist.py and
strokes.py. Made by ``JobSetup.work_settings`` alone.
"""

from dataclasses import dataclass, field
from pathlib import Path

from drillctl.generation.drills import DrillTable
from drillctl.generation.errors import JobError
from drillctl.generation.placing import Placing
from drillctl.language import Message
from drillctl.viewmodel.job_options import PinsOf

LEAST_PECK_MM = 0.05


@dataclass(frozen=True)
class WorkSettings:
    """Order is 'file', 'nearest' or 'optimised'; peck and spot are depths below the board's surface, None = none.

    base_steps  the working base that the job is drilled from: X and Y from machine zero
    mill        slots are milled from end to end; else they are chains of holes
    pins        the holes for pins that are added to the file; None: none
    face_down   the board lies turned over: its pins are drilled already
    store       the file of the RAM in which workpieces are looked up; None: the machine's own
    spindles    the spindles that drill, by number from 1; none named: all

    order_seconds, order_steps  for how long 'optimised' may look for a shorter way; None: to the end of its search

    Raises JobError for a depth that would never come to an end.
    """

    placing: Placing = field(default_factory=Placing)
    order: str = "file"
    skip_tools: frozenset[int] = frozenset()
    drills: DrillTable | None = None
    peck_mm: float | None = None
    spot_mm: float | None = None
    base_steps: tuple[int, int] = (0, 0)
    mill: bool = False
    pins: PinsOf | None = None
    face_down: bool = False
    store: Path | None = None
    spindles: tuple[int, ...] = ()
    order_seconds: float | None = None
    order_steps: int | None = None

    def __post_init__(self) -> None:
        for name, depth_mm in ((Message("peck depth"), self.peck_mm), (Message("spot depth"), self.spot_mm)):
            if depth_mm is not None and not LEAST_PECK_MM <= depth_mm <= 1000:
                raise JobError(
                    Message("{depth} mm is not a depth of {least} mm or more", depth=depth_mm, least=LEAST_PECK_MM).at(
                        name
                    )
                )
