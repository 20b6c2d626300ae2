"""The fastest ramp of an axis that loses nothing: its states, intervals and brake distances, searched by trials.

Rule: *fastest* is the least time over the distances of MOVES. From a gentle ramp on, turn by turn, the best single
change that still loses nothing is made: a state less, a start in a later state, or an interval a tick shorter. Where
none is left the ramp is tried on every distance; a distance that loses joins the search, which begins again.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from drillctl.lab.errors import LabError
from drillctl.lab.ramp_trials import PROOF_LOADS, Bench, Proof
from drillctl.lab.retargeting import first_missed, targets_tried
from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_file import parse_ramp
from drillctl.machine.source import Source

RATIO = 1.25  # of the speeds of neighbouring states in a gentle ramp
SLOWEST = 5  # times the cruising interval: where a gentle ramp begins
DWELLS = (1, 3)  # steps that a gentle ramp stays at a speed
CRUISES = range(1, 17)  # intervals of the top state that are tried
MOST_PROOFS = 8

Profile = tuple[int, ...]  # the intervals of states 0 to n
Report = Callable[[str], object]


@dataclass(frozen=True, slots=True)
class Tuned:
    """A tuned ramp and what was tried with it; ``before``: the same of the ramp that the axis had."""

    ramp: RampTable
    proof: Proof
    mean_ticks: float
    before: Proof
    mean_ticks_before: float


def tune(bench: Bench, name: str, report: Report = lambda line: None) -> Tuned:
    """The fastest ramp, with this name; ``report`` is given a line a turn. Raises LabError where there is none."""
    gentle = _gentle(bench)
    also: list[int] = []
    for _ in range(MOST_PROOFS):
        profile = _quickest(bench, gentle, also, report)
        ramp = ramp_of(name, profile)
        proof = bench.proof(ramp)
        if proof.lost_at_steps is None:
            _check_exact(ramp, bench)
            own = bench.axis.ramp
            return Tuned(ramp, proof, bench.mean_ticks(ramp), bench.proof(own), bench.mean_ticks(own))
        report(f"{_spoken(profile)} loses steps on moves of {proof.lost_at_steps}")
        also.append(proof.lost_at_steps)
    raise LabError(
        Message(
            "after {most_proofs} searches there is still a distance that loses steps; ask for less margin",
            most_proofs=MOST_PROOFS,
        )
    )


def ramp_of(name: str, profile: Profile) -> RampTable:
    """The ramp with these intervals in both directions: a state up or down a step, braking as late as possible."""
    top = len(profile) - 1
    distances = (*range(top + 1), *range(top, 0, -1))
    interval = (*profile, *reversed(profile[1:]))
    return RampTable(name, top, interval, distances, tuple(state + 1 if state else 0 for state in distances))


def _gentle(bench: Bench) -> Profile:
    """The fastest cruise that can be reached gently, and the shortest such ramp to it."""
    for cruise in CRUISES:
        profiles = [_gentle_to(cruise, dwell) for dwell in DWELLS]
        losing = bench.losing([ramp_of("gentle", profile) for profile in profiles])
        carried = [profile for profile, loses in zip(profiles, losing, strict=True) if not loses]
        if carried:
            return carried[0]
    raise LabError(
        Message(
            "at {tick_hz} Hz and with a margin of {margin:g} axis {name} loses steps however gently it starts, up "
            "to an interval of {cruises}: ask for less margin or a lower rate",
            tick_hz=bench.tick_hz,
            margin=bench.margin,
            name=bench.axis.name,
            cruises=CRUISES[-1],
        )
    )


def _gentle_to(cruise: int, dwell: int) -> Profile:
    speeds, slow = [cruise], float(cruise)
    while round(slow) < SLOWEST * cruise:
        slow *= RATIO
        speeds.append(round(slow))
    distinct = sorted(set(speeds), reverse=True)
    return tuple(interval for interval in distinct for _ in range(dwell))


def _quickest(bench: Bench, profile: Profile, also: list[int], report: Report) -> Profile:
    """From a profile that loses nothing to one of which every single change loses or is slower."""
    if bench.losing([ramp_of("gentle", profile)], also)[0]:
        raise LabError(
            Message(
                "moves of {names} steps lose even on a gentle ramp; ask for less margin",
                names=", ".join(map(str, also)),
            )
        )
    while True:
        ticks = bench.mean_ticks(ramp_of("now", profile))
        report(f"{_spoken(profile)}: {ticks:.1f} ticks a move")
        faster = sorted(set(_faster(bench, profile, ticks)))
        losing = bench.losing([ramp_of("next", each) for _, each in faster], also) if faster else []
        kept = [each for (_, each), loses in zip(faster, losing, strict=True) if not loses]
        if not kept:
            return profile
        profile = kept[0]


def _faster(bench: Bench, profile: Profile, ticks: float) -> Iterator[tuple[float, Profile]]:
    """All single changes that save time, with the mean ticks of a move after them."""
    for state, interval in enumerate(profile):
        shorter = (*profile[:state], interval - 1, *profile[state + 1 :])
        fewer = (*profile[:state], *profile[state + 1 :])
        for changed in (shorter, fewer, profile[state:]):
            if _falls(changed) and (after := bench.mean_ticks(ramp_of("next", changed))) < ticks:
                yield after, changed


def _falls(profile: Profile) -> bool:
    """Whether a profile is a ramp: of one state at least, none slower than the one below."""
    return len(profile) > 1 and profile[-1] >= 1 and all(a >= b for a, b in pairwise(profile))


def _check_exact(ramp: RampTable, bench: Bench) -> None:
    """The rule of machine/ramp.py, and new targets in the midst of moves. Braking by a state a step can't fail it."""
    assert ramp.first_inexact() is None, f"{ramp.interval} does not land exactly"
    assert first_missed(ramp, bench.axis) is None, f"{ramp.interval} misses a new target"


def _spoken(profile: Profile) -> str:
    return " ".join(map(str, profile))


def ramp_text(tuned: Tuned, bench: Bench, machine: Machine) -> str:
    """The text of the ramp's file, the evidence in its comments."""
    text = "\n".join((*_evidence(tuned, bench, machine), *_rows(tuned.ramp))) + "\n"
    assert parse_ramp(Source(Path(tuned.ramp.name), text)) == tuned.ramp
    return text


def evidence_lines(tuned: Tuned, bench: Bench, machine: Machine) -> list[str]:
    """Lines that say what was found, tried and proved, for the operator and for the file."""
    axis, ramp = bench.axis, tuned.ramp
    assert axis.dynamics is not None
    return [
        f"Tuned for axis {axis.name} of {machine.name} at {bench.tick_hz} Hz, on the dynamic plant",
        f"({axis.dynamics.name}), not on a machine.",
        f"Torque margin: nothing is lost with inertia and friction 1 to {bench.margin:g} times as great.",
        f"A move takes {tuned.mean_ticks:.1f} ticks on average, with {axis.ramp.name} {tuned.mean_ticks_before:.1f}.",
        "No single change (a state less, a later start, an interval a tick shorter) loses nothing and is faster.",
        f"Tried: {_proof_text(tuned.proof)}.",
        f"The same with {axis.ramp.name}: {_proof_text(tuned.before)}.",
        "Exact: every distance, both ways, under every floor; and each of",
        f"{targets_tried(ramp)} new targets in the midst of a move.",
    ]


def _evidence(tuned: Tuned, bench: Bench, machine: Machine) -> Iterator[str]:
    for line in evidence_lines(tuned, bench, machine):
        yield f"# {line}"
    yield f'name = "{tuned.ramp.name}"'


def _proof_text(proof: Proof) -> str:
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
