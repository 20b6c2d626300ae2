"""The options of a job, as a person sets them on the command line or on a screen: how its file is read, where the
board lies, how it is drilled.

Rule: one shape for the verbs, the screens, the list of recent jobs and the journal; in files the options have the
names of the command line. ``generation/job_setup.py`` adds the machine and the working base that a job is made for.
"""

import re
from typing import Annotated, NamedTuple, cast

import msgspec

from drillctl.language import Message
from drillctl.viewmodel.choices import MOST_ORDER_SECONDS, PIN_PLACES, AfterEnd, Mirror, Order, Origin, PinPlaces

MAX_MM = 10_000.0  # ten metres: beyond any machine, so a number like that is a slip
FilePath = Annotated[str, msgspec.Meta(min_length=1, pattern=r"\A[^\x00]*\Z")]  # no argument of a program has a NUL
PathOrRows = Annotated[str, msgspec.Meta(min_length=1)]  # beside a list msgspec 0.22 frees a pattern wrongly
Millimetres = Annotated[float, msgspec.Meta(ge=-MAX_MM, le=MAX_MM)]
OrderSeconds = Annotated[float, msgspec.Meta(ge=0, le=MOST_ORDER_SECONDS)]
OrderSteps = Annotated[int, msgspec.Meta(ge=0, le=2**62)]
DEFAULT_PIN_MARGIN_MM = 5.0
PINS_TYPED = re.compile(rf"(\d{{1,5}}(?:\.\d{{1,6}})?)(?::({'|'.join(PIN_PLACES)}))?(?::(\d{{1,4}}(?:\.\d{{1,6}})?))?")
NAMES_IN_FILES = {"rotate_deg": "rotate", "offset_mm": "offset", "peck_mm": "peck", "spot_mm": "spot"}


class MeasuredHole(NamedTuple):
    """A hole of the board, in the file's coordinates, and where it was found, from machine zero."""

    file_x_mm: Millimetres
    file_y_mm: Millimetres
    machine_x_mm: Millimetres
    machine_y_mm: Millimetres


class PanelOf(NamedTuple):
    """The same board, so many times along X and Y, at these pitches."""

    columns: int
    rows: int
    pitch_x_mm: float
    pitch_y_mm: float


class PinsOf(NamedTuple):
    """Registration pins: their diameter, where they are, and how far outside the extent of all holes."""

    diameter_mm: Millimetres
    where: PinPlaces = "corners"
    margin_mm: Millimetres = DEFAULT_PIN_MARGIN_MM

    @classmethod
    def typed(cls, text: str) -> "PinsOf":
        """From a text such as ``3``, ``3:left-right`` or ``3:corners:8``. Raises ValueError with a message."""
        found = PINS_TYPED.fullmatch(text.strip())
        if found is None:
            raise ValueError(
                Message("{text!r} is not MM:WHERE:MM, with WHERE one of {places}", text=text[:40],
                        places=", ".join(PIN_PLACES))
            )  # fmt: skip
        diameter, where, margin = found.groups()
        margin_mm = DEFAULT_PIN_MARGIN_MM if margin is None else float(margin)
        return cls(float(diameter), cast(PinPlaces, where or PIN_PLACES[0]), margin_mm)

    def __str__(self) -> str:
        return f"{self.diameter_mm:g}:{self.where}:{self.margin_mm:g}"


class JobOptions(msgspec.Struct, frozen=True, forbid_unknown_fields=True, rename=NAMES_IN_FILES):
    """Paths are absolute. The types are what the command line takes; they are checked where a file or a screen gives
    the values (``JobSetup.checked``, ``RecentJobs.read``), and not when a record is made.

    origin             None: the lowest X and Y of the board come to lie at the working base
    align              an alignment file, or the measured holes themselves; these alone say where the board lies
    peck_mm, spot_mm   depths below the board's surface
    mill               slots are milled from end to end, where the machine can; else they are chains of holes
    pins               holes for the pins that a board of two sides is turned over on; None: none
    order_seconds      for how long an optimised order may be looked for; None: until it is found
    order_steps        for how many steps, in place of seconds: of a job whose search the seconds have cut short
    drills             the file of the drills at hand
    after_end          what becomes of holes behind the end of the program (M30)
    store              the file of a store of workpieces, instead of the machine's own RAM
    spindles           the spindles that drill, by number from 1; none named: all
    """

    format: str | None = None
    origin: Origin | None = None
    mirror: Mirror | None = None
    rotate_deg: float = 0.0
    offset_mm: tuple[float, float] = (0.0, 0.0)
    align: PathOrRows | tuple[MeasuredHole, ...] | None = None
    panel: PanelOf | None = None
    pins: PinsOf | None = None
    mill: bool = False
    order: Order = "file"
    order_seconds: OrderSeconds | None = None
    order_steps: OrderSteps | None = None
    skip_tools: tuple[int, ...] = ()
    drills: FilePath | None = None
    peck_mm: float | None = None
    spot_mm: float | None = None
    after_end: AfterEnd = "refuse"
    store: FilePath | None = None
    spindles: tuple[Annotated[int, msgspec.Meta(ge=1, le=10)], ...] = ()

    @property
    def measured(self) -> tuple[MeasuredHole, ...]:
        """The measured holes that place the board; none where a file lists them, or none were measured."""
        return self.align if isinstance(self.align, tuple) else ()
