"""The tools of the board in the order of drilling: how many of their holes are drilled, and how long each takes."""

import numpy as np

from drillctl.language.number_text import clock
from drillctl.language.words import _
from drillctl.ui.widgets.text_graphics import bar
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import BoardView, MachineView

LEAST_BAR = 6


def tool_lines(view: MachineView, board: BoardView | None, done: int, columns: int, plain: bool = False) -> list[Line]:
    """A heading and a line a tool; ``>`` marks the one in the spindle. ``done``: of the board's holes."""
    if board is None:
        return []
    drilled = np.bincount(board.tool[:done], minlength=len(board.tools)).tolist()
    ticks = {tool.number: tool.ticks for tool in board.estimate.tools}
    heading = f"  {_('Tool'):8}{_('mm'):>7}{_('holes'):>11}{_('time'):>9}  "
    lines: list[Line] = [[("title", heading)]]
    for tool, count in zip(board.tools, drilled, strict=True):
        mark = ">" if tool.number == view.tool else " "
        size = f"{tool.diameter_mm:.3f}" if tool.diameter_mm else "-"
        seconds = ticks.get(tool.number, 0) / max(board.estimate.tick_hz, 1)
        text = f"{mark} T{tool.number:<7}{size:>7}{f'{count}/{tool.holes}':>11}{clock(seconds):>9}  "
        filled = bar(count / tool.holes if tool.holes else 1.0, max(columns - len(text), LEAST_BAR), plain)
        role = "title" if mark == ">" else "good" if count == tool.holes else "body"
        lines.append([(role, text), ("good", filled)])
    return lines
