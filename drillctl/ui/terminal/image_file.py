"""Pictures of numbers as PNG or SVG, drawn by matplotlib, which is an extra: ``pip install '.[plot]'`` in a clone.

Rule: a function of a record; the same record gives the same bytes: no date, no random names. charts.py draws the same
in characters. What a test counts has a name (``gid``), which is the id of its group in an SVG file.
"""

import io
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from drillctl.language import Message, Refusal, visible
from drillctl.ui.widgets.series_colours import LOOKS, Look, Theme
from drillctl.viewmodel.reports import BoardPlan, Chart, Curve, HeatMap, Picture, Style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FORMATS = ("png", "svg")
WIDTH_IN, CHART_IN, PLAN_IN, NOTE_IN = 9.0, 3.2, 6.0, 0.22
DOTS_PER_IN = 120
ROW_IN, MOST_NAMES = 0.25, 16  # of a heat map
LEGEND_CHARACTERS = 118  # so many names of curves stand beside each other
SETTINGS: Any = {"svg.hashsalt": "drillctl", "svg.fonttype": "none", "font.size": 9.0, "axes.grid": True,
                 "axes.axisbelow": True, "axes.xmargin": 0.01}  # fmt: skip
STYLES: dict[Style, dict[str, Any]] = {
    Style.LINE: {"linewidth": 1.2},
    Style.STAIRS: {"linewidth": 1.2, "drawstyle": "steps-post"},
    Style.POINTS: {"linestyle": "none", "marker": "o", "markersize": 3.0},
}
DASHES = ("-", "--", "-.", ":")  # so that curves are told apart without colours too


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


def picture_bytes(picture: Picture, kind: str, theme: Theme = "light") -> bytes:
    """The content of an image file of this kind, which ``check_format`` returned."""
    import matplotlib
    from matplotlib.figure import Figure

    look = LOOKS[theme]
    heights = [_height_in(chart) for chart in picture.charts]
    foot_in = NOTE_IN * (len(picture.notes) + 1)
    with matplotlib.rc_context({**SETTINGS, **_painted(look)}):
        figure = Figure((WIDTH_IN, sum(heights) + foot_in), layout="constrained")
        figure.suptitle(_words(picture.title))
        figure.supxlabel("\n".join(map(_words, picture.notes)), fontsize="small")
        places = figure.subplots(len(heights), squeeze=False, height_ratios=heights)[:, 0]
        for chart, axes in zip(picture.charts, places, strict=True):
            _drawn(chart, axes, look)
        content = io.BytesIO()
        unstamped = {"Date": None} if kind == "svg" else {"Software": None}
        figure.savefig(content, format=kind, dpi=DOTS_PER_IN, metadata=unstamped)
    return content.getvalue()


def _painted(look: Look) -> Any:
    """Matplotlib's settings for paper and ink."""
    inked = ("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color")
    papered = ("figure.facecolor", "axes.facecolor", "savefig.facecolor")
    return {**dict.fromkeys(inked, look.ink), **dict.fromkeys(papered, look.paper), "grid.color": look.line,
            "grid.alpha": 0.4, "grid.linewidth": 0.6}  # fmt: skip


def _height_in(chart: Chart | HeatMap | BoardPlan) -> float:
    if isinstance(chart, HeatMap):
        return max(CHART_IN, ROW_IN * len(chart.rows))
    return PLAN_IN if isinstance(chart, BoardPlan) or chart.to_scale else CHART_IN


def _drawn(chart: Chart | HeatMap | BoardPlan, axes: "Axes", look: Look) -> None:
    if isinstance(chart, HeatMap):
        _draw_heat(chart, axes)
    elif isinstance(chart, BoardPlan):
        _draw_plan(chart, axes, look)
    else:
        _draw(chart, axes, look)


def _draw_heat(heat: HeatMap, axes: "Axes") -> None:
    """Light is none, dark is all; as many names as there is room for. The shades differ in lightness too."""
    drawn = axes.imshow(100 * heat.share, aspect="auto", origin="lower", cmap="cividis_r", vmin=0, vmax=100)
    axes.grid(visible=False)
    for names, place in ((heat.columns, axes.xaxis), (heat.rows, axes.yaxis)):
        shown = range(0, len(names), 1 + len(names) // MOST_NAMES)
        place.set_ticks([*shown], [_words(names[number]) for number in shown])
    axes.set_xlabel(_words(heat.x_label))
    axes.set_ylabel(_words(heat.y_label))
    axes.figure.colorbar(drawn, ax=axes, label=_words(f"{heat.label}, %"))


def _draw_plan(plan: BoardPlan, axes: "Axes", look: Look) -> None:
    """Each hole as large as its drill, each error as a line from the middle of its hole; the outline of all holes."""
    from matplotlib.collections import LineCollection, PatchCollection
    from matplotlib.patches import Circle, Rectangle

    low, high = plan.outline_mm
    width, height = (high - low).tolist()
    outline: Any = {"linestyle": "--", "color": look.line}
    axes.add_patch(Rectangle((float(low[0]), float(low[1])), width, height, fill=False, gid="outline", **outline))
    for number, tool in enumerate(plan.tools):
        circles = [Circle((x, y), plan.drawn_mm[row] / 2) for row, (x, y) in
                   zip(tool.holes.tolist(), plan.sent_mm[tool.holes].tolist(), strict=True)]  # fmt: skip
        colour = look.of(number)
        drawn = PatchCollection(circles, facecolor=(colour, 0.35), edgecolor=colour, gid=f"tool-{tool.number}")
        axes.add_collection(drawn)
        axes.plot([], [], "o", color=colour, label=_words(tool_words(tool.number, tool.diameter_mm, len(tool.holes))))
    if plan.error_mm.any():
        lines = [[begin, end] for begin, end in zip(plan.sent_mm.tolist(), plan.ends_mm.tolist(), strict=True)]
        axes.add_collection(LineCollection(lines, colors=look.ink, linewidths=1.2, gid="errors"))
        axes.plot([], [], "-", color=look.ink, label=f"error, {plan.times} times as long")
    axes.plot([], [], **outline, label=f"extent of the holes, {width:.1f} x {height:.1f} mm")
    axes.autoscale_view()
    axes.set_aspect("equal", adjustable="datalim")
    _named(axes, "x, mm", "y, mm")


def tool_words(number: int, diameter_mm: float | None, holes: int) -> str:
    """A tool as a legend names it."""
    size = "size not known" if diameter_mm is None else f"{diameter_mm:g} mm"
    return f"T{number}, {size}: {holes} {'hole' if holes == 1 else 'holes'}"


def _draw(chart: Chart, axes: "Axes", look: Look) -> None:
    for number, curve in enumerate(chart.curves):
        _plot(curve, axes, look, number)
    if chart.to_scale:
        axes.set_aspect("equal", adjustable="datalim")
    if all(curve.style is Style.POINTS and (curve.y >= 0).all() for curve in chart.curves):
        axes.set_ylim(bottom=0)  # points alone, as errors by hole, are compared with nothing
    _named(axes, chart.x_label, chart.y_label)


def _named(axes: "Axes", x_label: str, y_label: str) -> None:
    """Names the axes, and where there are several curves these too: above, where they hide nothing."""
    axes.set_xlabel(_words(x_label))
    axes.set_ylabel(_words(y_label))
    handles, names = axes.get_legend_handles_labels()
    if len(names) > 1:
        columns = max(1, LEGEND_CHARACTERS // (max(map(len, names)) + 8))
        axes.legend(handles, names, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, frameon=False,
                    fontsize="small", borderaxespad=0.2)  # fmt: skip


def _words(text: str) -> str:
    """As they are: no control characters, which SVG must not have; dollars are no formula of matplotlib's."""
    return visible(text).replace("$", r"\$")


def _plot(curve: Curve, axes: "Axes", look: Look, number: int) -> None:
    style = STYLES[curve.style]
    dashed = {} if curve.style is Style.POINTS else {"linestyle": DASHES[number // len(look.series) % len(DASHES)]}
    axes.plot(curve.x, curve.y, label=_words(curve.label), color=look.of(number), **{**style, **dashed})
