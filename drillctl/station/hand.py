"""The operator's hold and its end, from the key to the machine. Used by operating.

Rule: what was asked last counts, though the machine is a tick or two behind it, or has not begun.
"""

from drillctl.kmd import Request


class Hand:
    """A desk.Operator: a hold that is pressed before the first command has begun is asked for until it is so.

    wish  what the operator asked last: to hold, or not; None where nothing was, or it is so
    """

    def __init__(self) -> None:
        self.wish: bool | None = None

    @property
    def held(self) -> bool:
        """See desk.Operator."""
        return bool(self.wish)

    def foreseen(self, condition: str) -> str:
        """The condition that the machine has, or is about to have: keys pressed in one breath mean the latter."""
        if self.wish and condition == "ready":
            return "holding"
        return "ready" if self.wish is False and condition in ("holding", "held") else condition

    def requests(self) -> tuple[Request, ...]:
        """None: the rest is posted when its key is pressed."""
        return ()
