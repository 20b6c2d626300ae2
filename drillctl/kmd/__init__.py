"""The door between generation and execution: commands down the queue, requests past it, one status record up.

    commands.py  the KMD set, defined once: record, opcodes, arguments, what each does
    text.py      the ``.kmd`` text form, both ways, from that definition
    queue.py     the bounded FIFO, and the mailbox of requests that overtake it
    gate.py      lets ticks through one by one
    channel.py   all of these and the status between two processes, in one mapped file
    status.py    the small fixed record that comes up
    faults.py    fault codes: reaction, position kept or lost (their words live above: panel)

Rule: integers only; neither side sees the other's objects. Imports nothing of ours.
"""

from drillctl.kmd.commands import COMMANDS, RECORD, Command, Names, Op
from drillctl.kmd.faults import FAULTS, Fault, FaultSpec, Reaction
from drillctl.kmd.gate import Gate, TickGate
from drillctl.kmd.queue import CAPACITY, CommandQueue, Mailbox, Queue, Request, RequestBit, Requests
from drillctl.kmd.status import STATUS, Condition
from drillctl.kmd.text import KmdError, parse_program, to_text

__all__ = [
    "CAPACITY", "COMMANDS", "FAULTS", "RECORD", "STATUS", "Command", "CommandQueue", "Condition", "Fault", "FaultSpec",
    "Gate", "KmdError", "Mailbox", "Names", "Op", "Queue", "Reaction", "Request", "RequestBit", "Requests", "TickGate",
    "parse_program", "to_text",
]  # fmt: skip
