"""The board of a report, as SVG: each hole as wide as its drill, each error as a line, the extent of all holes, and
what each colour stands for.

Rule: colours are classes of page.css, so that light and dark have their own; nothing is told by colour alone.
"""

from html import escape

import numpy as np
from numpy.typing import NDArray

from drillctl.language.words import _, ngettext
from drillctl.ui.report.svg import MARGIN, WIDTH, label, svg
from drillctl.ui.widgets.series_colours import LOOKS
from drillctl.viewmodel.reports import BoardPlan

Floats = NDArray[np.float64]
MOST_HEIGHT = 720.0
LEAST_RADIUS = 1.5
LEAST_MM = 1.0
MOST_MARKS = 8  # figures beside an axis
COLOURS = len(LOOKS["light"].series)
UM_PER_MM = 1000


def board_figure(plan: BoardPlan) -> str:
    """Returns the section with the board; nothing without holes."""
    if not len(plan.made_mm):
        return ""
    place = _Page(plan)
    ends = zip(place.of(plan.sent_mm).tolist(), place.of(plan.ends_mm).tolist(), strict=True)
    lines = "".join(f"M{x0:.1f} {y0:.1f}L{x1:.1f} {y1:.1f}" for (x0, y0), (x1, y1) in ends)
    holes = "".join(_circles(plan, place))
    drawing = f'{place.outline()}{holes}<path class="error" d="{lines}"/>{place.marks()}'
    note = _(
        "a circle: where the bit was sent, as wide as its drill; a line: how far off the hole is, {times} times as "
        "long; dashed: the extent of all holes, {width:.1f} x {height:.1f} mm"
    ).format(times=plan.times, width=place.extent[0], height=place.extent[1])
    title = _("Board")
    return (
        f"<section><h2>{title}</h2>{svg(drawing, WIDTH, place.height, title)}{_legend(plan)}"
        f"<p>{escape(note)}</p></section>"
    )


class _Page:
    """Where millimetres come to lie on the page: Y upwards, to scale."""

    def __init__(self, plan: BoardPlan):
        self.low, high = plan.outline_mm
        self.extent = high - self.low
        drawn = np.maximum(self.extent, LEAST_MM)
        self.scale = min((WIDTH - 2 * MARGIN) / float(drawn[0]), MOST_HEIGHT / float(drawn[1]))
        self.height = float(drawn[1]) * self.scale + 2 * MARGIN

    def of(self, places_mm: Floats) -> Floats:
        """(n, 2) in the drawing's units."""
        x, y = ((places_mm - self.low) * self.scale).T
        return np.stack([x + MARGIN, self.height - MARGIN - y], axis=1)

    def outline(self) -> str:
        """The rectangle around all holes."""
        width, height = (self.extent * self.scale).tolist()
        top = self.height - MARGIN - height
        return f'<path class="outline" d="M{MARGIN:.1f} {top:.1f}h{width:.1f}v{height:.1f}h{-width:.1f}z"/>'

    def marks(self) -> str:
        """Figures along both axes, and what they are of."""
        bottom = self.height - MARGIN / 2 + 4
        across = [label(x, bottom, f"{mm:g}", "middle") for mm, x in self._marked(0)]
        upwards = [label(MARGIN - 6, y + 4, f"{mm:g}", "end") for mm, y in self._marked(1)]
        names = label(WIDTH - MARGIN, self.height - 4, "x, mm", "end") + label(2, MARGIN - 8, "y, mm")
        return "".join([*across, *upwards, names])

    def _marked(self, axis: int) -> list[tuple[float, float]]:
        """Round millimetres of an axis, and where they lie."""
        low, high = float(self.low[axis]), float(self.low[axis] + self.extent[axis])
        step = _round_step(float(max(self.extent)) / MOST_MARKS)
        round_mm = np.arange(np.ceil(low / step), np.floor(high / step) + 1) * step + 0.0  # no -0
        places = np.repeat(self.low[None], len(round_mm), axis=0)
        places[:, axis] = round_mm
        return [*zip(round_mm.tolist(), self.of(places)[:, axis].tolist(), strict=True)]


def _circles(plan: BoardPlan, place: _Page) -> list[str]:
    """A circle for each hole, in drilling order."""
    colour = {row: number % COLOURS for number, tool in enumerate(plan.tools) for row in tool.holes.tolist()}
    radii = np.maximum(plan.drawn_mm * place.scale / 2, LEAST_RADIUS).tolist()
    error_um = (plan.error_mm * UM_PER_MM).tolist()
    drawn = []
    for row, (x, y) in enumerate(place.of(plan.sent_mm).tolist()):
        x_mm, y_mm = plan.sent_mm[row].tolist()
        title = f"{row + 1}: T{plan.tool[row]}, {x_mm:.3f}, {y_mm:.3f} mm; {error_um[row]:.0f} um"
        drawn.append(
            f'<circle class="hole t{colour[row]}" cx="{x:.1f}" cy="{y:.1f}" r="{radii[row]:.2f}">'
            f"<title>{title}</title></circle>"
        )
    return drawn


def _legend(plan: BoardPlan) -> str:
    """The tools: a spot of the colour, then number, diameter and holes in words."""
    parts = []
    for number, tool in enumerate(plan.tools):
        size = _("size not known") if tool.diameter_mm is None else f"{tool.diameter_mm:g} mm"
        holes = ngettext("{count} hole", "{count} holes", len(tool.holes)).format(count=len(tool.holes))
        words = f"T{tool.number}, {size}: {holes}"
        parts.append(f'<span><b class="t{number % COLOURS}">&#9679;</b> {escape(words)}</span>')
    return f'<p class="legend">{" ".join(parts)}</p>'


def _round_step(least: float) -> float:
    """The least of 1, 2, 5, 10, 20 ... that is not less than this."""
    power = 10.0 ** np.floor(np.log10(max(least, 1e-3)))
    return float(next(each * power for each in (1, 2, 5, 10) if each * power >= least))
