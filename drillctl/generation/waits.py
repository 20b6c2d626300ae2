"""What a person waits for while a job is made: the parts of the work, and how far each is.

Rule: the result is the same whether a terminal, a screen or nothing shows it. An exception from a call ends the work,
which has changed nothing by then.
"""

from collections.abc import Callable

from drillctl.language import Message

Advance = Callable[[int, int], None]  # is called with how much of a part is done, and with the whole
Waits = Callable[[Message], Advance]  # is called with what a part does, as that part begins
FORECASTING = Message("working out how long the job takes")
ORDERING = Message("putting the holes in order")
PLANNED = Message("drawing the board")


def reading(name: str) -> Message:
    """What is done while a file of this name is read."""
    return Message("reading {name}", name=name)


def unwatched(what: Message) -> Advance:
    """The Waits of work whose progress is not shown."""
    return ignored


def ignored(done: int, total: int) -> None:
    """The Advance of work whose progress is not shown: does nothing."""
