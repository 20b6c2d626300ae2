"""Pictures of numbers, for a person: made by the lab, drawn by ui in a terminal or by matplotlib into a file.

Rule: a picture is data. A curve breaks where a value is not a number.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


class Style(Enum):
    """How the points of a curve are joined."""

    LINE = "line"
    STAIRS = "stairs"  # each value holds up to the next point
    POINTS = "points"


@dataclass(frozen=True, eq=False, slots=True)
class Curve:
    """Points (n,), (n,) with a name for the legend."""

    label: str
    x: Floats
    y: Floats
    style: Style = Style.LINE

    @classmethod
    def of(cls, label: str, x: ArrayLike, y: ArrayLike, style: Style = Style.LINE) -> "Curve":
        """From any numbers. Raises ValueError where there are not as many of one as of the other."""
        curve = cls(label, np.asarray(x, np.float64), np.asarray(y, np.float64), style)
        if curve.x.shape != curve.y.shape or curve.x.ndim != 1:
            raise ValueError(f"{label}: {curve.x.shape} places, {curve.y.shape} values")
        return curve


@dataclass(frozen=True, eq=False, slots=True)
class Chart:
    """Curves over one pair of axes; ``to_scale``: a millimetre is as long upwards as sideways."""

    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    to_scale: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class Picture:
    """Charts one below the other, and what they show in sentences."""

    title: str
    charts: tuple[Chart, ...]
    notes: tuple[str, ...] = ()
