"""The status record: small, of fixed size, published after each tick, up to some 1,000 times a second. Screens, journal
and summary are made from it.

Rule: execution/between_ticks.py writes it, and the ticker adds what only it knows (lateness, lost steps); everybody
above only reads. Integers: no file, no millimetre, no word. Whether a job is over is asked here and nowhere else.
"""

from enum import IntEnum

import numpy as np

from drillctl.kmd.commands import MOST_AXES


class Condition(IntEnum):
    """What the controller is doing."""

    READY = 0  # takes commands from the queue
    HOLDING = 1  # braking or resting on hold; the command stays current
    STOPPING = 2  # braking to end the job
    RETURNING = 3  # after a fault: head up, then home
    LATCHED = 4  # a fault or an emergency stop waits to be acknowledged
    ZERO_ONLY = 5  # after some faults: takes the return to zero, and no other command


STATUS = np.dtype(
    [
        ("tick", "<i8"),  # ticks run
        ("tick_hz", "<u4"),  # the rate in force; 0 before the first record
        ("late", "<u4"),  # ticks that began more than a period late
        ("late_worst_ns", "<i8"),
        ("pace_percent", "<u2"),  # machine time over wall time, by the simulated clock of a screen; else 0
        ("underruns", "<u4"),  # underruns: wakes without a command in mid-job, which are no ticks
        ("epoch", "<u4"),
        ("sequence", "<u4"),  # of the current command, 0 = none
        ("done", "<u4"),  # sequence of the last command completed
        ("hole_begun", "<i4"),  # tag of the last hole whose drilling began
        ("holes_done", "<u4"),
        ("tool", "<i4"),
        ("opcode", "u1"),
        ("condition", "u1"),
        ("fault", "u1"),
        ("fault_kept", "u1"),  # 1: the position was known and still is
        ("fault_axes", "<u2"),  # as a mask, the axes that the fault is about, as far as that is known
        ("position_known", "u1"),
        ("step", "u1"),  # the row of the tool change that is carried out, or was last, from 1; 0 for none
        ("cut_off", "u1"),  # 1: what was switched on by hand and would burn a winding was switched off
        ("hot_ticks", "<u4"),  # ticks until that happens; 0: nothing of that kind is on
        ("job", "u1"),  # 1 from a program's first command to KMD_KONIEC
        ("moving", "u1"),  # axes that count
        ("queued", "<u2"),
        ("position", "<i8", (MOST_AXES,)),
        ("target", "<i8", (MOST_AXES,)),
        ("base", "<i8", (MOST_AXES,)),  # of the working base: where absolute commands count from
        ("steps", "<i8", (MOST_AXES,)),  # made so far, both directions added
        ("lost", "<i4", (MOST_AXES,)),  # steps that the plant is behind; 0 where there is no plant to ask
        ("behind", "<i4", (MOST_AXES,)),  # thousandths of a step that the plant's carriage is behind, moving or not
        ("state", "<i2", (MOST_AXES,)),
        ("column", "u1", (MOST_AXES,)),  # from 1
        ("sensors", "<u8"),  # by input bit, 1 = reached; of the first two cards
        ("image", "<u8"),  # outputs as flushed; of the first two cards
    ]
)


_AFTER_FAULT = (Condition.LATCHED, Condition.ZERO_ONLY)


def takes_commands(condition: int) -> bool:
    """Whether commands are taken from the queue in a condition, be it only one of them."""
    return condition in (Condition.READY, Condition.ZERO_ONLY)


def is_idle(condition: int, job: int, moving: int) -> bool:
    """Whether the machine rests outside a job and takes commands; arguments as in the status record."""
    return condition == Condition.READY and not job and not moving


def has_ended(condition: int, job: int, moving: int) -> bool:
    """Whether a job has ended (at KMD_KONIEC, by a stop, or latched by a fault) and everything rests; arguments as in
    the status record. Also true before the first command of a job: see ``is_over``.
    """
    return is_idle(condition, job, moving) or (condition in _AFTER_FAULT and not moving)


def is_complete(status: np.void, last_sequence: int) -> bool:
    """Whether the command ``last_sequence``, a program's last, is done."""
    return bool(status["done"] == last_sequence)


def is_over(status: np.void, last_sequence: int, first_epoch: int) -> bool:
    """Whether a program has ended and everything rests: complete, stopped (which begins another epoch than
    ``first_epoch``, that of its commands), or latched by a fault.
    """
    if not has_ended(status["condition"], status["job"], status["moving"]):
        return False
    stopped = status["condition"] == Condition.LATCHED or status["epoch"] != first_epoch
    return bool(stopped or is_complete(status, last_sequence))
