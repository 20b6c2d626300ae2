"""Pictures of one screen, taken one after the other, as a single SVG that shows them in turn and begins anew.

Rule: what all pictures share is drawn once, so that a dozen take little more room than two. Where animations are not
played, the first picture is seen. Called by docs/pictures.py.
"""

import re
from collections.abc import Sequence
from itertools import groupby

ELEMENT = re.compile(r"<rect x[^>]*/>|<text .*?</text>", re.DOTALL)
FRAME_S = 0.25  # for which each picture is seen


def animated(pictures: Sequence[str]) -> str:
    """The pictures, SVG of the same size, as one; a single one as it is."""
    if len(pictures) == 1:
        return pictures[0]
    seen: dict[str, set[int]] = {}  # each rectangle and text, and the pictures that have it
    for number, picture in enumerate(pictures):
        for element in ELEMENT.findall(picture):
            seen.setdefault(element, set()).add(number)
    head = ELEMENT.split(pictures[0], maxsplit=1)[0].rsplit("<g>", maxsplit=1)[0]
    grounds = {element: where for element, where in seen.items() if element.startswith("<rect")}
    letters = {element: where for element, where in seen.items() if element.startswith("<text")}
    return head + "\n".join([*_drawn(grounds, len(pictures)), *_drawn(letters, len(pictures)), "</svg>\n"])


def _drawn(seen: dict[str, set[int]], count: int) -> list[str]:
    """A group for all elements that are seen in the same pictures; the one that is always seen comes first."""
    together: dict[frozenset[int], list[str]] = {}
    for element, where in seen.items():
        together.setdefault(frozenset(where), []).append(element)
    ordered = sorted(together.items(), key=lambda entry: -len(entry[0]))
    return [_group("".join(elements), where, count) for where, elements in ordered]


def _group(inside: str, where: frozenset[int], count: int) -> str:
    if len(where) == count:
        return f"<g>{inside}</g>"
    first = "visible" if 0 in where else "hidden"
    runs = [(shown, next(run)) for shown, run in groupby(range(count), lambda number: number in where)]
    values = ";".join("visible" if shown else "hidden" for shown, _begin in runs)
    times = ";".join(f"{begin / count:.4g}" for _shown, begin in runs)
    return (
        f'<g visibility="{first}"><animate attributeName="visibility" calcMode="discrete" dur="{count * FRAME_S:g}s" '
        f'repeatCount="indefinite" values="{values}" keyTimes="{times}"/>{inside}</g>'
    )
