"""Whether the machine takes something new, and whether further ticks would change anything.

Rule: a refusal says what is in the way; it is empty where nothing is. Used by console/machine_console.py.
"""

from drillctl.kmd import Condition
from drillctl.language import Message
from drillctl.ticker.link import Link
from drillctl.viewmodel.console import Problems

BUSY = Message("the machine is at work; hold or stop it first")
ZERO_ONLY = Message("only the return to zero is allowed now (KMD_POWROT)")


def occupied(link: Link, at_work: bool) -> Problems:
    """Why not even a return to zero can be begun now; ``at_work``: a job, a jog or an initialisation is on its way."""
    status = link.status()
    if link.lost():
        return (Message("the ticker's process has ended; acknowledge, and it is started again"),)
    if status["condition"] == Condition.LATCHED:
        return (Message("a fault waits to be acknowledged"),)
    return (BUSY,) if at_work or status["moving"] else ()


def busy(link: Link, at_work: bool) -> Problems:
    """Why nothing new can be begun now."""
    zero_only = link.status()["condition"] == Condition.ZERO_ONLY
    return occupied(link, at_work) or ((ZERO_ONLY,) if zero_only else ())


def ticks_change_something(link: Link, works_on: bool) -> bool:
    """False at rest, held, with the clock stopped, or before a tool change; ``works_on``: at work, and no tool is
    waited for.
    """
    status = link.status()
    if link.gate.paused:
        return bool(status["hot_ticks"])  # the forcing voltage goes off all the same
    if status["moving"] or status["hot_ticks"] or status["condition"] in (Condition.STOPPING, Condition.RETURNING):
        return True
    return works_on and status["condition"] != Condition.HOLDING
