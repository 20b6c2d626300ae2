"""The drawings of a report that need no script: the board, and speed and lag over time, as SVG.

Rule: colours are classes of page.css, so that light and dark have their own; nothing is told by colour alone.
"""

from html import escape

import numpy as np
from numpy.typing import NDArray

from drillctl.language.words import _
from drillctl.viewmodel.run_report import ReportAxis, RunReport

Floats = NDArray[np.float64]
WIDTH, CURVE_HEIGHT, MARGIN = 720.0, 120.0, 46.0
LONGEST_ERROR = 0.06  # of the board: the longest error is drawn so long
LEAST_MM = 1.0
POINT_PX = 2.4
MARKS = 4  # figures beside an axis of a drawing
ENLARGED = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)


def board_figure(report: RunReport) -> str:
    """Returns the board: a point where each hole was made, a line from where it was sent, enlarged; nothing without
    holes.
    """
    holes = report.holes
    if not len(holes.made_mm):
        return ""
    low, high = holes.sent_mm.min(axis=0), holes.sent_mm.max(axis=0)
    extent = np.maximum(high - low, LEAST_MM)
    scale = min((WIDTH - 2 * MARGIN) / extent[0], WIDTH / extent[1])
    height = extent[1] * scale + 2 * MARGIN
    times = _enlargement(float(holes.error_mm.max()), float(extent.max()))
    sent = _on_page(holes.sent_mm, low, scale, height)
    ends = _on_page(holes.sent_mm + (holes.made_mm - holes.sent_mm) * times, low, scale, height)
    lines = "".join(f"M{x0:.1f} {y0:.1f}L{x1:.1f} {y1:.1f}" for (x0, y0), (x1, y1) in zip(sent, ends, strict=True))
    points = "".join(_hole(number, place, report) for number, place in enumerate(sent, 1))
    rule_mm = _round_length(float(extent[0]) / 4)
    rule = f'<path class="rule" d="M{MARGIN} {height - 18:.1f}h{rule_mm * scale:.1f}"/>' + _label(
        MARGIN, height - 4, f"{rule_mm:g} mm"
    )
    note = _("a point: where the bit was sent; a line: how far off the hole is, {times} times as long").format(
        times=times
    )
    drawing = f'<path class="error" d="{lines}"/>{points}{rule}'
    return f"<section><h2>{_('Board')}</h2>{_svg(drawing, WIDTH, height, _('Board'))}<p>{escape(note)}</p></section>"


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
    scale = _label(0, MARGIN / 2 + 4, f"{high:.3g}") + _label(0, CURVE_HEIGHT + MARGIN / 2, f"{low:.3g}")
    ticks = "".join(
        _label(MARGIN + (WIDTH - 2 * MARGIN) * part / MARKS, CURVE_HEIGHT + MARGIN / 2 + 16,
               f"{report.seconds * part / MARKS:.3g} s")
        for part in range(MARKS + 1)
    )  # fmt: skip
    return _svg(paths + scale + ticks + _label(MARGIN, 12, title), WIDTH, CURVE_HEIGHT + MARGIN, title)


def _path(values: Floats, low: float, high: float) -> str:
    x = MARGIN + (WIDTH - 2 * MARGIN) * (np.arange(len(values)) + 0.5) / len(values)
    y = MARGIN / 2 + CURVE_HEIGHT * (high - values) / ((high - low) or 1.0)
    return "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in zip(x.tolist(), y.tolist(), strict=True))


def _hole(number: int, place: Floats, report: RunReport) -> str:
    x_mm, y_mm = report.holes.sent_mm[number - 1]
    title = f"{number}: {x_mm:.3f}, {y_mm:.3f} mm; {report.holes.error_mm[number - 1] * 1000:.0f} um"
    x, y = place
    return f'<circle class="hole" cx="{x:.1f}" cy="{y:.1f}" r="{POINT_PX}"><title>{title}</title></circle>'


def _on_page(places_mm: Floats, low: Floats, scale: float, height: float) -> Floats:
    moved = (places_mm - low) * scale
    return np.stack([moved[:, 0] + MARGIN, height - MARGIN - moved[:, 1]], axis=1)


def _enlargement(most_mm: float, extent_mm: float) -> int:
    fitting = [times for times in ENLARGED if most_mm * times <= extent_mm * LONGEST_ERROR]
    return max(fitting, default=1)


def _round_length(length_mm: float) -> float:
    power = 10.0 ** np.floor(np.log10(max(length_mm, 0.1)))
    return float(max(each * power for each in (1, 2, 5) if each * power <= max(length_mm, power)))


def _label(x: float, y: float, words: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}">{escape(words)}</text>'


def _svg(inner: str, width: float, height: float, title: str) -> str:
    head = f'<svg role="img" aria-label="{escape(title)}" viewBox="0 0 {width:.0f} {height:.0f}">'
    return f"{head}{inner}</svg>"
