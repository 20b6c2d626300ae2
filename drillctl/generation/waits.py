"""What a person waits for while a job is made: the parts of the work, and how far each is.

Rule: whoever shows it - a terminal, a screen, nobody - the result is the same.
"""

from collections.abc import Callable

Advance = Callable[[int, int], None]  # is called with how much of a part is done, and with the whole
Waits = Callable[[str], Advance]  # is called with what a part does, as that part begins
FORECASTING = "working out how long the job takes"
ORDERING = "putting the holes in order"


def reading(name: str) -> str:
    """What is done while a file of this name is read."""
    return f"reading {name}"


def unwatched(what: str) -> Advance:
    """Waits of a part of the work that nobody watches."""
    return ignored


def ignored(done: int, total: int) -> None:
    """Advance of a part that nobody watches."""
