"""Finding out how a board lies from holes measured on it: the map and how far it can be trusted.

Rule: no more is read from the measurements than they can carry. Two holes, or holes on one line, give a
shift and a turn; three that span both directions give scale and shear too. What is left over is shown
hole by hole, and whatever looks implausible is said in `warnings`, never mended in silence.
The map goes into `placing.Placing`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from drillctl.files.inputs import read_bytes
from drillctl.generation.measured import MAX_BYTES, AlignmentError, Millimetres, parse
from drillctl.generation.placing import Affine
from drillctl.language import Counted, Message, message_of

COINCIDENT_MM = 0.1  # the machine's positioning error: closer than this, holes are the same place
SHORT_SPAN_MM = 10.0  # 0.1 mm of error over this length is half a degree of turn
LINE_RATIO = 0.02  # spread across / spread along; below it the width is measurement error, not a direction
MAX_SCALE_ERROR = 0.02
MAX_SHEAR = 0.02
MAX_RESIDUAL_MM = 0.5  # a hole off by more was most likely taken for another one

HOLES_NEEDED = {"rigid": 2, "affine": 3}  # rigid: shift and turn; affine: scale and shear as well


@dataclass(frozen=True)
class Parts:
    """A map taken apart for showing: mirror in x first (if mirrored), then shear, scale, turn, shift."""

    turn_deg: float
    scale_x: float
    scale_y: float
    shear: float
    mirrored: bool


@dataclass(frozen=True)
class Alignment:
    """What the measured holes say. `kind` is a key of HOLES_NEEDED; `residual_mm` (n,) is each hole's
    distance from where the map puts it; `length_ratio` is measured over file size along the holes' main
    direction; `span_mm` is the size of the box around them in the file, corner to corner; `rejected` are the
    warnings that no measurement of this board can call forth."""

    affine: Affine
    kind: str
    residual_mm: Millimetres
    length_ratio: float
    span_mm: float
    warnings: tuple[Message, ...]
    rejected: tuple[Message, ...] = ()

    @property
    def rms_mm(self) -> float:
        """Root mean square of the residuals."""
        return float(np.sqrt(np.mean(self.residual_mm**2)))

    @property
    def spare_holes(self) -> int:
        """Holes beyond those the map needs; with 0 an affine's residuals are 0 whatever was measured."""
        return len(self.residual_mm) - HOLES_NEEDED[self.kind]

    @property
    def length_error_mm(self) -> float:
        """Measured length minus the file's, over the span of the holes."""
        return self.span_mm * (self.length_ratio - 1)


def load(path: Path, *, mirrored: bool = False) -> Alignment:
    """Read an alignment file and fit it. Raises AlignmentError, with FILE:LINE:COLUMN where it can."""
    try:
        data = read_bytes(path, MAX_BYTES, Message("a list of holes"))
    except OSError as error:
        raise AlignmentError(Message("cannot be read: {why}", why=message_of(error)).at(path)) from error
    measured = parse(data, name=str(path))
    try:
        return fit(measured.file_xy_mm, measured.machine_xy_mm, mirrored=mirrored)
    except AlignmentError as error:
        raise AlignmentError(error.message.at(path)) from error


def fit(file_xy_mm: ArrayLike, machine_xy_mm: ArrayLike, *, mirrored: bool = False) -> Alignment:
    """Least-squares map from file to machine millimetres, both (n, 2) with n >= 2.

    `mirrored` says that the board lies face down: a shift and turn cannot find that out, and a
    scale and shear that disagree with it are warned about. Raises AlignmentError for holes that
    settle nothing: fewer than two places, or measured places that contradict the file's.
    """
    file_mm, machine_mm = _pairs(file_xy_mm, machine_xy_mm)
    along_mm, across_mm = _spread_mm(file_mm)
    span_mm = _span_mm(file_mm)
    measured_mm = _span_mm(machine_mm)
    _refuse_same_place(Message("file"), span_mm)
    _refuse_same_place(Message("machine"), measured_mm)
    on_a_line = across_mm < LINE_RATIO * along_mm
    affine = _fit_rigid(file_mm, machine_mm, mirrored) if on_a_line else _fit_affine(file_mm, machine_mm)
    alignment = Alignment(
        affine=affine,
        kind="rigid" if on_a_line else "affine",
        residual_mm=np.hypot(*(affine.apply(file_mm) - machine_mm).T),
        length_ratio=_spread_mm(machine_mm)[0] / along_mm,
        span_mm=span_mm,
        warnings=(),
    )
    rejected = tuple(_contradictions(alignment, mirrored))
    return replace(alignment, warnings=(*_hints(alignment), *rejected), rejected=rejected)


def decompose(affine: Affine) -> Parts:
    """Take a map's 2x2 part to pieces: linear = R(turn) [[scale_x, shear*scale_y], [0, scale_y]] M,
    where M changes the sign of x if the map is mirrored. `shear` is a ratio: x gained per y."""
    mirrored = bool(np.linalg.det(affine.linear) < 0)
    (a, b), (c, d) = affine.linear @ np.diag([-1.0 if mirrored else 1.0, 1.0])
    scale_x = math.hypot(a, c)
    scale_y = (a * d - b * c) / scale_x
    shear = (a * b + c * d) / scale_x / scale_y
    return Parts(math.degrees(math.atan2(c, a)), scale_x, scale_y, shear, mirrored)


def _pairs(file_xy_mm: ArrayLike, machine_xy_mm: ArrayLike) -> tuple[Millimetres, Millimetres]:
    file_mm = np.asarray(file_xy_mm, np.float64).reshape(-1, 2)
    machine_mm = np.asarray(machine_xy_mm, np.float64).reshape(-1, 2)
    if file_mm.shape != machine_mm.shape:
        raise AlignmentError(
            Counted(
                "{count} hole of the file but {measured} measured",
                "{count} holes of the file but {measured} measured",
                len(file_mm),
                measured=len(machine_mm),
            )
        )
    if len(file_mm) < 2:
        raise AlignmentError(
            Counted(
                "{count} measured hole; a turn needs two, scale and shear need three",
                "{count} measured holes; a turn needs two, scale and shear need three",
                len(file_mm),
            )
        )
    return file_mm, machine_mm


def _refuse_same_place(whose: Message, span_mm: float) -> None:
    if span_mm < COINCIDENT_MM:
        raise AlignmentError(
            Message(
                "all {whose} coordinates are the same place within {mm} mm, so they show no turn; measure holes far "
                "apart",
                whose=whose,
                mm=COINCIDENT_MM,
            )
        )


def _span_mm(xy_mm: Millimetres) -> float:
    """Size of the box around the points, corner to corner."""
    return float(np.hypot(*np.ptp(xy_mm, axis=0)))


def _spread_mm(xy_mm: Millimetres) -> tuple[float, float]:
    """Spread along the points' main direction and across it: singular values of the centred points."""
    along_mm, across_mm = np.linalg.svd(xy_mm - xy_mm.mean(axis=0), compute_uv=False)
    return float(along_mm), float(across_mm)


def _fit_rigid(file_mm: Millimetres, machine_mm: Millimetres, mirrored: bool) -> Affine:
    """Shift and turn by least squares: in the plane the best turn is the angle of two plain sums
    (orthogonal Procrustes problem, Schoenemann 1966, for two dimensions)."""
    mirror = np.diag([-1.0 if mirrored else 1.0, 1.0])
    source = (file_mm - file_mm.mean(axis=0)) @ mirror
    target = machine_mm - machine_mm.mean(axis=0)
    aligned = (source * target).sum()
    crossed = (source[:, 0] * target[:, 1] - source[:, 1] * target[:, 0]).sum()
    turn_rad = math.atan2(crossed, aligned)
    cosine, sine = math.cos(turn_rad), math.sin(turn_rad)
    linear = np.array([[cosine, -sine], [sine, cosine]]) @ mirror
    return Affine.of(linear, machine_mm.mean(axis=0) - linear @ file_mm.mean(axis=0))


def _fit_affine(file_mm: Millimetres, machine_mm: Millimetres) -> Affine:
    source = file_mm - file_mm.mean(axis=0)
    target = machine_mm - machine_mm.mean(axis=0)
    linear = np.linalg.lstsq(source, target, rcond=None)[0].T
    most, least = np.linalg.svd(linear, compute_uv=False)
    if least <= LINE_RATIO * most:
        raise AlignmentError(
            Message("the measured places lie on one line, the holes do not: were they mixed up?")
        )
    return Affine.of(linear, machine_mm.mean(axis=0) - linear @ file_mm.mean(axis=0))


def _hints(alignment: Alignment) -> Iterator[Message]:
    """How the measurement could be better, a sentence each."""
    if alignment.kind == "rigid" and alignment.spare_holes > 0:
        yield Message("the holes lie on one line, so only shift and turn were fitted; for scale measure one beside it")
    if alignment.span_mm < SHORT_SPAN_MM:
        yield Message(
            "the holes lie within {mm:.1f} mm: the turn is uncertain; take holes far apart", mm=alignment.span_mm
        )


def _contradictions(alignment: Alignment, mirrored: bool) -> Iterator[Message]:
    """Whatever makes the measurement implausible, a sentence each."""
    parts = decompose(alignment.affine)
    scales = {Message("along the holes"): alignment.length_ratio}
    if alignment.kind == "affine":
        scales = {Message("in x"): parts.scale_x, Message("in y"): parts.scale_y}
    for direction, scale in scales.items():
        if abs(scale - 1) > MAX_SCALE_ERROR:
            yield Message(
                "the scale {direction} is {scale:.4f}, not near 1: wrong holes, or wrong units?",
                direction=direction,
                scale=scale,
            )
    if abs(parts.shear) > MAX_SHEAR:
        yield Message(
            "the shear is {shear:.4f}: the board would be no rectangle; was a wrong hole measured?", shear=parts.shear
        )
    if parts.mirrored != mirrored:
        seen, asked = (
            (Message("face down"), Message("face up")) if parts.mirrored else (Message("face up"), Message("face down"))
        )
        yield Message("the measured holes show the board {seen}, but {wanted} was asked for", seen=seen, wanted=asked)
    worst = int(alignment.residual_mm.argmax())
    if alignment.residual_mm[worst] > MAX_RESIDUAL_MM:
        yield Message(
            "measured hole {number} is {mm:.3f} mm off; was it another hole?",
            number=worst + 1,
            mm=alignment.residual_mm[worst],
        )
