"""Whose fault: the operator's input. Raised before anything moves; one line a problem."""

from collections.abc import Sequence

from drillctl.language import one_line

MOST_SHOWN = 50


class JobError(Exception):
    """A job that can't be done. ``problems`` are lines such as ``FILE:LINE: reason``; ``str()`` joins them, line ends
    within one of them escaped.
    """

    def __init__(self, problems: Sequence[str]):
        self.problems = tuple(problems)
        shown = list(self.problems[:MOST_SHOWN])
        if len(self.problems) > MOST_SHOWN:
            shown.append(f"and {len(self.problems) - MOST_SHOWN} more")
        super().__init__("\n".join(map(one_line, shown)))
