"""A tuned ramp as a table file, its evidence in the comments. Called by the tune verb."""

from collections.abc import Iterator
from pathlib import Path

from drillctl.lab.ramp_trials import PROOF_LOADS, Bench, Proof
from drillctl.lab.retargeting import targets_tried
from drillctl.lab.tune import Tuned
from drillctl.machine import Machine
from drillctl.machine.ramp import RampTable, parse_ramp
from drillctl.machine.source import Source


def ramp_text(tuned: Tuned, bench: Bench, machine: Machine) -> str:
    """What the file says; read again it is the ramp."""
    text = "\n".join((*_evidence(tuned, bench, machine), *_rows(tuned.ramp))) + "\n"
    assert parse_ramp(Source(Path(tuned.ramp.name), text)) == tuned.ramp
    return text


def evidence_lines(tuned: Tuned, bench: Bench, machine: Machine) -> list[str]:
    """What was found, tried and proved, for the operator and for the file."""
    axis, ramp = bench.axis, tuned.ramp
    assert axis.dynamics is not None
    return [
        f"Tuned for axis {axis.name} of {machine.name} at {bench.tick_hz} Hz, on the dynamic plant",
        f"({axis.dynamics.name}), not on a machine.",
        f"Torque margin: nothing is lost with inertia and friction 1 to {bench.margin:g} times as great.",
        f"A move takes {tuned.mean_ticks:.1f} ticks on average, with {axis.ramp.name} {tuned.mean_ticks_before:.1f}.",
        "No single change (a state less, a later start, an interval a tick shorter) loses nothing and is faster.",
        f"Tried: {_told(tuned.proof)}.",
        f"The same with {axis.ramp.name}: {_told(tuned.before)}.",
        "Exact: every distance, both ways, under every floor; and each of",
        f"{targets_tried(ramp)} new targets in the midst of a move.",
    ]


def _evidence(tuned: Tuned, bench: Bench, machine: Machine) -> Iterator[str]:
    for line in evidence_lines(tuned, bench, machine):
        yield f"# {line}"
    yield f'name = "{tuned.ramp.name}"'


def _told(proof: Proof) -> str:
    tried = f"{proof.trials} moves, on {PROOF_LOADS} loads, from every column"
    if proof.lost_at_steps is not None:
        return f"{tried}, of which those of {proof.lost_at_steps} steps are the shortest that lose"
    return f"{tried}, none lost, at most {proof.worst_full_steps:.2f} full steps off at rest"


def _rows(ramp: RampTable) -> Iterator[str]:
    for state in range(-ramp.top, ramp.top + 1):
        sign = -1 if state < 0 else 1
        yield ""
        yield "[[state]]"
        yield f"state = {state}"
        yield f"accelerate = {sign * ramp.accelerate[state]}"
        yield f"brake = {sign * ramp.brake[state]}"
        yield f"interval = {ramp.interval[state]}"
