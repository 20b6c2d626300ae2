"""Pictures of numbers as PNG or SVG, drawn by matplotlib, which is an extra: ``pip install '.[plot]'`` in a clone.

Rule: a function of a record; the same record gives the same bytes: no date, no random names. charts.py draws the same
in characters.
"""

import io
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from drillctl.language import Message, Refusal, visible
from drillctl.viewmodel.reports import Chart, Curve, HeatMap, Picture, Style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FORMATS = ("png", "svg")
WIDTH_IN, CHART_IN, PLAN_IN, NOTE_IN = 9.0, 3.2, 6.0, 0.22
DOTS_PER_IN = 120
ROW_IN, MOST_NAMES = 0.25, 16  # of a heat map
SETTINGS: Any = {"svg.hashsalt": "drillctl", "font.size": 9.0, "axes.grid": True, "grid.alpha": 0.3}
STYLES: dict[Style, dict[str, Any]] = {
    Style.LINE: {"linewidth": 1.0},
    Style.STAIRS: {"linewidth": 1.0, "drawstyle": "steps-post"},
    Style.POINTS: {"linestyle": "none", "marker": "o", "markersize": 3.0},
}


class PictureRefused(Refusal):
    """A picture that can't be drawn here; ``str()`` says what to do."""

    kind = "picture"


def check_format(suffix: str) -> str:
    """``png`` or ``svg`` of a file's suffix. Raises PictureRefused, too where matplotlib is missing."""
    kind = suffix.removeprefix(".").lower()
    if kind not in FORMATS:
        raise PictureRefused(
            Message("a picture is a .png or a .svg, not {suffix!r}", suffix=suffix or "a file without suffix")
        )
    if find_spec("matplotlib") is None:
        reason = Message(
            "{kind} needs matplotlib: pip install 'matplotlib>=3.9'; without --out it is drawn here", kind=kind.upper()
        )
        raise PictureRefused(reason)
    return kind


def picture_bytes(picture: Picture, kind: str) -> bytes:
    """The content of an image file of this kind, which ``check_format`` returned."""
    import matplotlib
    from matplotlib.figure import Figure

    heights = [_height_in(chart) for chart in picture.charts]
    foot_in = NOTE_IN * (len(picture.notes) + 1)
    with matplotlib.rc_context(SETTINGS):
        figure = Figure((WIDTH_IN, sum(heights) + foot_in), layout="constrained")
        figure.suptitle(_words(picture.title))
        figure.supxlabel("\n".join(map(_words, picture.notes)), fontsize="small")
        places = figure.subplots(len(heights), squeeze=False, height_ratios=heights)[:, 0]
        for chart, axes in zip(picture.charts, places, strict=True):
            if isinstance(chart, HeatMap):
                _draw_heat(chart, axes)
            else:
                _draw(chart, axes)
        content = io.BytesIO()
        unstamped = {"Date": None} if kind == "svg" else {"Software": None}
        figure.savefig(content, format=kind, dpi=DOTS_PER_IN, metadata=unstamped)
    return content.getvalue()


def _height_in(chart: Chart | HeatMap) -> float:
    if isinstance(chart, HeatMap):
        return max(CHART_IN, ROW_IN * len(chart.rows))
    return PLAN_IN if chart.to_scale else CHART_IN


def _draw_heat(heat: HeatMap, axes: "Axes") -> None:
    """Light is none, dark is all; as many names as there is room for."""
    drawn = axes.imshow(100 * heat.share, aspect="auto", origin="lower", cmap="viridis_r", vmin=0, vmax=100)
    axes.grid(visible=False)
    for names, place in ((heat.columns, axes.xaxis), (heat.rows, axes.yaxis)):
        shown = range(0, len(names), 1 + len(names) // MOST_NAMES)
        place.set_ticks([*shown], [_words(names[number]) for number in shown])
    axes.set_xlabel(_words(heat.x_label))
    axes.set_ylabel(_words(heat.y_label))
    axes.figure.colorbar(drawn, ax=axes, label=_words(f"{heat.label}, %"))


def _draw(chart: Chart, axes: "Axes") -> None:
    for curve in chart.curves:
        _plot(curve, axes)
    axes.set_xlabel(_words(chart.x_label))
    axes.set_ylabel(_words(chart.y_label))
    if chart.to_scale:
        axes.set_aspect("equal", adjustable="datalim")
    axes.legend(loc="best", fontsize="small")


def _words(text: str) -> str:
    """As they are: no control characters, which SVG must not have; dollars are no formula of matplotlib's."""
    return visible(text).replace("$", r"\$")


def _plot(curve: Curve, axes: "Axes") -> None:
    axes.plot(curve.x, curve.y, label=_words(curve.label), **STYLES[curve.style])
