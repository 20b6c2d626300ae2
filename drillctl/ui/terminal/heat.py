"""A heat map in characters: a cell for each pair of values, the darker the greater its share. A function of a record.

Rule: nothing and all are told apart from every share between: no loss is a dot, loss everywhere a full block.
"""

import numpy as np

from drillctl.language import visible
from drillctl.viewmodel.reports import Floats, HeatMap

SHADES, PLAIN_SHADES = "·░▒▓█", ".-+*#"
LONGEST_NAME = 24
WIDEST_CELL = 3


def heat_lines(heat: HeatMap, columns: int, plain: bool) -> list[str]:
    """The map with its names and a key, in lines of so many characters at most; where there are more columns than
    room, neighbours share a cell and the worst of them is shown.
    """
    names = [visible(name)[:LONGEST_NAME] for name in heat.rows]
    margin = max(len(visible(heat.y_label)[:LONGEST_NAME]), *map(len, names)) + 2
    room = max(columns - margin, 1)
    share = _narrowed(heat.share, room)
    width = min(WIDEST_CELL, room // share.shape[1])
    shades = PLAIN_SHADES if plain else SHADES
    key = f"{shades[0]} none  " + "  ".join(
        f"{shade} {words}" for shade, words in zip(shades[1:], ("to 1/3", "to 2/3", "more", "all"), strict=True)
    )
    body = [
        f"{name:>{margin - 1}} " + "".join(shades[_shade(value)] * width for value in row)
        for name, row in zip(names[::-1], share[::-1].tolist(), strict=True)
    ]
    left, right = heat.columns[0], heat.columns[-1]
    foot = " " * margin + visible(left) + visible(right).rjust(share.shape[1] * width - len(left))
    head = f"{visible(heat.y_label)[:LONGEST_NAME]:>{margin - 1}}"
    return [f"{visible(heat.label)}: {key}", head, *body, foot, " " * margin + visible(heat.x_label)]


def _shade(share: float) -> int:
    """0 for none, 4 for all, and three steps between."""
    if share <= 0 or share >= 1:
        return 4 if share >= 1 else 0
    return 1 + min(2, int(share * 3))


def _narrowed(share: Floats, room: int) -> Floats:
    """At most ``room`` columns, each the greatest of its neighbours."""
    if share.shape[1] <= room:
        return share
    return np.array([part.max(axis=1) for part in np.array_split(share, room, axis=1)]).T
