"""A run for a browser: its outcome as a table and its board as SVG, in one piece of HTML.

Rule: a function of records; the same run gives the same text. No script, no network; colours that the colour-blind can
tell apart, and never colour alone.
"""

from collections.abc import Sequence
from html import escape
from itertools import cycle

import numpy as np
from numpy.typing import NDArray

from drillctl.language import visible
from drillctl.ui.widgets.series_colours import LOOKS
from drillctl.viewmodel.records import Outcome

WIDTH_PX, MARGIN_PX = 640, 24
LEAST_RADIUS_PX = 1.5
NO_DIAMETER_MM = 0.8  # drawn so wide where the file has none
OFF_MM = 0.05  # a hole that is farther off is marked
TOOL_COLOURS = LOOKS["light"].series
OFF_COLOUR = "#d55e00"


def run_html(name: str, outcome: Outcome, holes: NDArray[np.void]) -> str:
    """Returns HTML for a notebook: what was run and how it ended, then the board where holes were made."""
    rows = "".join(f"<tr><th>{head}</th><td>{escape(visible(text))}</td></tr>" for head, text in _facts(name, outcome))
    return f"<table>{rows}</table>{board_svg(holes) if len(holes) else ''}"


def _facts(name: str, outcome: Outcome) -> Sequence[tuple[str, str]]:
    lost = outcome.lost_steps or {}
    losing = ", ".join(f"{axis} {steps}" for axis, steps in lost.items() if steps) or "none"
    fault = "none" if outcome.fault is None else f"{outcome.fault.name}: {outcome.fault.cause}"
    return (
        ("job", f"{name} on {outcome.machine}"),
        ("holes", f"{outcome.holes_done} of {outcome.holes_total}" if outcome.holes_total else f"{outcome.holes_done}"),
        ("machine time", f"{outcome.machine_seconds:.2f} s, {outcome.ticks} ticks at {outcome.tick_hz} Hz"),
        ("lost steps", losing),
        ("fault", fault),
    )


def board_svg(holes: NDArray[np.void]) -> str:
    """Returns the holes as SVG, to scale, Y upwards: true diameters, a colour a tool, a mark on each that is more than
    OFF_MM off. ``holes`` (n,) has the fields of api/result.py: HOLES; n > 0.
    """
    places = np.stack([holes["made_x_mm"], holes["made_y_mm"]], axis=1)
    low, high = places.min(axis=0), places.max(axis=0)
    extent_mm = np.maximum(high - low, 1.0)
    scale = (WIDTH_PX - 2 * MARGIN_PX) / extent_mm[0]
    if extent_mm[1] * scale > WIDTH_PX:
        scale = WIDTH_PX / extent_mm[1]
    height = extent_mm[1] * scale + 2 * MARGIN_PX
    colours = dict(zip(sorted({int(tool) for tool in holes["tool"]}), cycle(TOOL_COLOURS), strict=False))
    drawn = [_hole(hole, place, scale, colours[int(hole["tool"])]) for hole, place in
             zip(holes, _on_page(places, low, height, scale), strict=True)]  # fmt: skip
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH_PX} {height:.0f}" width="{WIDTH_PX}">'
    return f"{head}{''.join(drawn)}</svg>"


def _on_page(places: NDArray[np.float64], low: NDArray[np.float64], height: float, scale: float) -> NDArray[np.float64]:
    moved = (places - low) * scale
    return np.stack([moved[:, 0] + MARGIN_PX, height - MARGIN_PX - moved[:, 1]], axis=1)


def _hole(hole: np.void, place: NDArray[np.float64], scale: float, colour: str) -> str:
    x, y = place
    diameter_mm = float(hole["diameter_mm"])
    radius = max(LEAST_RADIUS_PX, (NO_DIAMETER_MM if np.isnan(diameter_mm) else diameter_mm) * scale / 2)
    title = f"<title>{_title(hole)}</title>"
    circle = f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius:.2f}" fill="{colour}">{title}</circle>'
    if not hole["error_mm"] > OFF_MM:
        return circle
    return f'{circle}<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius + 3:.2f}" fill="none" stroke="{OFF_COLOUR}"/>'


def _title(hole: np.void) -> str:
    error = "" if np.isnan(hole["error_mm"]) else f", {hole['error_mm']:.3f} mm off"
    return f"{hole['number']}: T{hole['tool']} at {hole['made_x_mm']:.3f}, {hole['made_y_mm']:.3f} mm{error}"
