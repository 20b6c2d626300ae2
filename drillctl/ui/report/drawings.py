"""Speed and lag of each axis of a report over time, as SVG.

Rule: colours are classes of page.css, so that light and dark have their own; nothing is told by colour alone.
"""

from html import escape

import numpy as np
from numpy.typing import NDArray

from drillctl.language.words import _
from drillctl.ui.report.svg import MARGIN, WIDTH, label, svg
from drillctl.viewmodel.run_report import ReportAxis, RunReport

Floats = NDArray[np.float64]
CURVE_HEIGHT = 120.0
MARKS = 4  # figures beside an axis of a drawing


def curve_figures(report: RunReport) -> list[str]:
    """Returns a section for each axis that moved: its speed and, on the dynamic plant, its lag over time."""
    return [_axis_figure(report, axis) for axis in report.axes if axis.travelled_mm > 0]


def _axis_figure(report: RunReport, axis: ReportAxis) -> str:
    curves = [(axis.speed_mm_s, "commanded"), (axis.rotor_mm_s, "rotor")]
    drawn = [_chart(report, [each for each in curves if len(each[0])], _("speed, mm/s"))]
    if len(axis.lag_steps):
        drawn.append(_chart(report, [(axis.lag_steps, "rotor")], _("lag, full steps")))
    told = _("grey: commanded; blue: the rotor") if len(axis.rotor_mm_s) else _("grey: commanded")
    head = _("Axis {name} over time").format(name=axis.name)
    return f"<section><h2>{escape(head)}</h2>{''.join(drawn)}<p>{escape(told)}</p></section>"


def _chart(report: RunReport, curves: list[tuple[Floats, str]], title: str) -> str:
    low = min(float(values.min()) for values, _kind in curves)
    high = max(float(values.max()) for values, _kind in curves)
    low, high = min(low, 0.0), max(high, low + 1e-9, 0.0)
    paths = "".join(
        f'<path class="{kind}" d="{_path(values, low, high)}"/>' for values, kind in curves
    )
    scale = label(0, MARGIN / 2 + 4, f"{high:.3g}") + label(0, CURVE_HEIGHT + MARGIN / 2, f"{low:.3g}")
    ticks = "".join(
        label(MARGIN + (WIDTH - 2 * MARGIN) * part / MARKS, CURVE_HEIGHT + MARGIN / 2 + 16,
               f"{report.seconds * part / MARKS:.3g} s")
        for part in range(MARKS + 1)
    )  # fmt: skip
    zero_y = MARGIN / 2 + CURVE_HEIGHT * high / (high - low)
    zero = f'<path class="outline" d="M{MARGIN} {zero_y:.1f}H{WIDTH - MARGIN}"/>'
    return svg(zero + paths + scale + ticks + label(MARGIN, 12, title), WIDTH, CURVE_HEIGHT + MARGIN, title)


def _path(values: Floats, low: float, high: float) -> str:
    x = MARGIN + (WIDTH - 2 * MARGIN) * (np.arange(len(values)) + 0.5) / len(values)
    y = MARGIN / 2 + CURVE_HEIGHT * (high - values) / ((high - low) or 1.0)
    return "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in zip(x.tolist(), y.tolist(), strict=True))
