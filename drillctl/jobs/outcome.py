"""How a job ended: what the last status record of its run says of it, in the words of a result."""

from dataclasses import dataclass

import numpy as np

from drillctl.generation.job import Job, MadeHole
from drillctl.jobs.tool_keeping import last_of_bit
from drillctl.kmd import Fault
from drillctl.language import Message
from drillctl.ticker.link import Link
from drillctl.trace import Segments, Trace
from drillctl.viewmodel.fault_texts import axes_blamed, fault_report
from drillctl.viewmodel.records import Outcome


@dataclass(frozen=True)
class JobResult:
    """A job that is over.

    holes    made, as the plant saw the bit meet the board; none on a real port
    signal   the number of the signal that stopped the job, None if none did
    trouble  what else stopped it, in a sentence; None where nothing did, or a fault, which ``outcome`` has
    notices  sentences about how it was paced
    """

    outcome: Outcome
    holes: list[MadeHole]
    trace: Trace | Segments | None
    signal: int | None
    trouble: Message | None = None
    notices: tuple[Message, ...] = ()


def fault_code(link: Link, status: np.void) -> int:
    """Returns the code of the fault that the run ended with, 0 for none; a lost link's comes first."""
    return int(link.lost() or status["fault"])


def outcome_of(
    job: Job, link: Link, first: np.void, status: np.void, *, done_before: int, done: int, interrupted: bool
) -> Outcome:
    """Returns how a run ended. ``first`` and ``status``: the status records before and after it; ``done_before``: holes
    drilled by earlier runs of the job, ``done``: by this one; ``interrupted``: it ended before its last command, and by
    no fault.
    """
    names, code = job.machine.axis_names, fault_code(link, status)
    lost = bool(link.lost())
    by_axis = {name: dict(zip(names, status[name].tolist(), strict=False)) for name in ("steps", "position", "lost")}
    blamed = axes_blamed(int(status["fault_axes"]), names)
    return Outcome(
        machine=job.machine.name,
        holes_done=done_before + done,
        holes_total=done_before + job.holes_total,
        ticks=int(status["tick"] - first["tick"]),
        tick_hz=job.machine.tick_hz,
        steps=by_axis["steps"],
        position=by_axis["position"],
        position_known=bool(status["position_known"]) and not lost,
        lost_steps=by_axis["lost"] if link.measured else None,
        underruns=int(status["underruns"]),
        fault=fault_report(Fault(code), bool(status["fault_kept"]) and not lost, blamed) if code else None,
        suspect=_suspect(job, int(status["done"]) - int(first["done"])) if code == Fault.BIT_BROKEN else (),
        late_count=int(status["late"]),
        late_greatest_ms=int(status["late_worst_ns"]) / 1e6,
        interrupted=interrupted,
    )


def _suspect(job: Job, commands: int) -> tuple[int, ...]:
    """The hole that a bit may have broken in, by its number in the whole job: the last that the bit made."""
    last = last_of_bit(job.program, commands) if job.work else None
    return () if last is None else (job.hole_number(last),)
