"""The door between generation and execution: commands go down the queue, requests past it, one status record comes up.

    commands.py  the KMD commands, defined once: record, opcodes, arguments, what each does
    text.py      the ``.kmd`` text form, read and written, from that definition
    queue.py     the bounded queue, and the mailbox of requests that overtake it
    gate.py      stops the ticks and lets single ones through
    channel.py   all of these and the status in one mapped file, shared by two processes
    status.py    the fixed-size record that comes up
    faults.py    fault codes: reaction, position kept or lost (their texts: viewmodel/fault_texts.py)

Rule: integers only; neither side sees the other's objects.
"""

from drillctl.kmd.commands import COMMANDS, RECORD, Command, Names, Op
from drillctl.kmd.faults import FAULTS, Fault, FaultSpec, Reaction
from drillctl.kmd.gate import Gate, TickGate
from drillctl.kmd.queue import CAPACITY, CommandQueue, Mailbox, Queue, Request, RequestBit, Requests
from drillctl.kmd.status import STATUS, Condition, has_ended, is_complete, is_idle, is_over, takes_commands
from drillctl.kmd.text import KmdError, parse_program, program_texts, to_text

__all__ = [
    "CAPACITY", "COMMANDS", "FAULTS", "RECORD", "STATUS", "Command", "CommandQueue", "Condition", "Fault", "FaultSpec",
    "Gate", "KmdError", "Mailbox", "Names", "Op", "Queue", "Reaction", "Request", "RequestBit", "Requests", "TickGate",
    "has_ended", "is_complete", "is_idle", "is_over", "parse_program", "program_texts", "takes_commands", "to_text",
]  # fmt: skip
