"""Which number format a file is in. Rule: what is declared is believed; only what is left open is guessed,
and every guess comes with its confidence, its runner-up and a sentence that says why.

`reader` calls `recognise` with the machine after the whole program has run.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from .errors import Refusal, Remark
from .facts import Facts
from .machine import Machine
from .model import MM_PER_UNIT, Floats, FormatChoice
from .rows import RowArray
from .score import COMMON_DIGITS, SAMPLE_HOLES, Digits, Layout, common, drills, same_places

ZEROS = ("none", "leading", "trailing")
SURE = 0.97  # below this confidence the guess is announced as one
DECLARED_BONUS = 4.0  # for declared zeros that the numbers contradict
CONTRADICTED = -3.0
ALTERNATIVE_MARGIN = 3.0  # score by which an alternative to a declared format must win to be named
FORMAT_OPTION = re.compile(r"(inch|mm),(?:decimal|(\d):(\d),(leading|trailing|none))")


# Names the paper and the CAD programs use for what the numbers look like.
DIALECTS = {
    None: "Excellon decimal",
    "trailing": "Excellon LZ",
    "leading": "Excellon TZ",
    "none": "Excellon zero-padded",
}


@dataclass(frozen=True)
class Recognition:
    """The chosen format, how sure (0 to 1), the next best, why, what a person should know, and whether a person
    settled it by hand."""

    choice: FormatChoice
    confidence: float
    runner_up: FormatChoice | None
    reason: str
    remarks: tuple[Remark, ...] = ()
    by_hand: bool = False


@dataclass(frozen=True)
class Sample:
    """What candidates are judged by: digits, and some distinct holes with raw diameters.

    at (n, 2, 3) number triples and diameter (n,), each with its mm per unit, 0 where undeclared; places:
    decimals of the tools' diameters.
    """

    digits: Digits
    decimals: int
    at: Floats
    mm: Floats
    diameter: Floats
    diameter_mm: Floats
    places: int

    def layout(self, choice: FormatChoice) -> Layout:
        """The sample's holes measured in a format."""
        xy_mm = (self.at @ choice.weights()) * self._mm(self.mm, choice)[:, None]
        return Layout.of(xy_mm, self.diameters_mm(choice))

    def diameters_mm(self, choice: FormatChoice) -> Floats:
        """The sample's drills in a format's units."""
        return self.diameter * self._mm(self.diameter_mm, choice)

    @staticmethod
    def _mm(declared: Floats, choice: FormatChoice) -> Floats:
        return np.where(declared > 0, declared, MM_PER_UNIT[choice.units])


def parse_option(text: str) -> FormatChoice:
    """The format a person gives: 'inch,2:4,leading' or 'mm,decimal'. Refusal 'bad-format'."""
    found = FORMAT_OPTION.fullmatch(text.strip().lower())
    if not found:
        raise Refusal("bad-format", text)
    units, integer, decimal, zeros = found.groups()
    return FormatChoice(units, (int(integer), int(decimal)) if integer else None, zeros)


def recognise(machine: Machine, option: FormatChoice | None) -> Recognition:
    """The format of a program that has run; option is the one a person settled on."""
    if option:
        return Recognition(option, 1.0, None, f"set by hand: {option}", by_hand=True)
    sample = take_sample(machine)
    contradiction = _zeros_contradicted(machine.facts, sample.digits)
    scored = _scored(machine.facts, sample, contradiction is not None)
    best = scored[0]
    runner_up = scored[1] if len(scored) > 1 else None
    confidence = _confidence([choice.score for choice in scored])
    remarks = [contradiction] if contradiction else []
    if machine.facts.units is None:
        remarks.append(Remark("missing-units", None, best.units))
    if confidence < SURE:
        remarks.append(Remark("format-guessed", None, f"{best}; or {runner_up}"))
    reason = _reason(machine.facts, sample, best, runner_up)
    return Recognition(best, confidence, runner_up, reason, tuple(remarks))


def dialect(machine: Machine, choice: FormatChoice, *, tape_code: bool) -> str:
    """What a person calls such a file."""
    if tape_code:
        return "EIA RS-244"
    return DIALECTS[choice.zeros] if machine.headers else "ASCII drill (OrCAD)"


def doubted(machine: Machine, declared: Recognition) -> Recognition:
    """A format whose holes overlap, looked at again as if only the units had been declared."""
    scored = _scored(Facts(units=machine.facts.units), take_sample(machine), False)
    own = next((choice.score for choice in scored if _same(choice, declared.choice)), -np.inf)
    if scored[0].score < own + ALTERNATIVE_MARGIN or _same(scored[0], declared.choice):
        return declared
    reason = f"{declared.reason}; but its holes overlap, and {scored[0]} is more plausible"
    return replace(declared, confidence=0.5, runner_up=scored[0], reason=reason)


def take_sample(machine: Machine) -> Sample:
    """At most SAMPLE_HOLES distinct holes, the first ones of every tool."""
    rows = _distinct(machine.rows.array())
    entries = machine.tools.entries
    tool = rows["tool"]
    return Sample(
        digits=Digits.of(machine.evidence.whole, machine.evidence.length),
        decimals=machine.evidence.decimals,
        at=rows["at"][:, 0],
        mm=rows["mm"],
        diameter=np.array([entry.diameter or 0.0 for entry in entries] + [0.0])[tool],
        diameter_mm=np.array([entry.mm for entry in entries] + [0.0])[tool],
        places=max((entry.places for entry in entries), default=0),
    )


def _distinct(rows: RowArray) -> RowArray:
    tools = np.unique(rows["tool"])
    share = max(SAMPLE_HOLES // max(1, len(tools)), 20)
    none = np.empty(0, dtype=np.int64)
    first = np.concatenate([none, *(np.flatnonzero(rows["tool"] == tool)[:share] for tool in tools)])
    some = rows[np.sort(first)][:SAMPLE_HOLES]
    # The same place written twice is no evidence; the same place reached by different digits is.
    _, kept = np.unique(some["at"][:, 0].reshape(-1, 6), axis=0, return_index=True)
    distinct: RowArray = some[np.sort(kept)]
    return distinct


def _scored(facts: Facts, sample: Sample, contradicted: bool) -> list[FormatChoice]:
    """Every candidate with its score, best first; of those that give the same board, the best."""
    best: dict[tuple[str, bytes], FormatChoice] = {}
    for choice in _candidates(facts, sample, contradicted):
        score = _score(choice, facts, sample, contradicted)
        key = choice.units, _effect(choice, sample)
        if key not in best or score > best[key].score:
            best[key] = replace(choice, score=round(score, 3))
    return sorted(best.values(), key=lambda choice: -choice.score)


def _candidates(facts: Facts, sample: Sample, contradicted: bool) -> Iterator[FormatChoice]:
    """All formats that agree with what is declared."""
    for units in [facts.units.value] if facts.units else list(MM_PER_UNIT):
        if not sample.digits.count or (sample.decimals and not facts.digits):
            yield FormatChoice(units)
        if sample.digits.count or (facts.digits and not sample.decimals):
            places = [facts.digits.value] if facts.digits else list(COMMON_DIGITS[units])
            zeros = [facts.zeros.value] if facts.zeros and not contradicted else list(ZEROS)
            yield from (FormatChoice(units, *pair) for pair in product(places, zeros))


def _effect(choice: FormatChoice, sample: Sample) -> bytes:
    """What the format makes of the sample; two names for one effect are one candidate."""
    return np.round(sample.at @ choice.weights(), 6).tobytes()


def _score(choice: FormatChoice, facts: Facts, sample: Sample, contradicted: bool) -> float:
    score = common(choice) + same_places(choice, sample.places) + sample.layout(choice).plausible()
    if choice.digits and sample.digits.count:
        score += sample.digits.dropped(choice.zeros) + sample.digits.fits(choice.digits)
    if not facts.units:
        score += drills(sample.diameters_mm(choice))
    if contradicted and facts.zeros and choice.zeros == facts.zeros.value:
        score += DECLARED_BONUS
    return score


def _zeros_contradicted(facts: Facts, digits: Digits) -> Remark | None:
    """Zeros declared dropped that are all there, while the other kind is missing."""
    if not facts.zeros or facts.zeros.value == "none" or not digits.count or digits.full_width:
        return None
    declared = facts.zeros.value
    other = "leading" if declared == "trailing" else "trailing"
    if digits.dropped(declared) > CONTRADICTED or digits.dropped(other) < CONTRADICTED or digits.equal:
        return None
    return Remark("zeros-contradict-data", facts.zeros.line, facts.zeros.source)


def _same(one: FormatChoice, other: FormatChoice) -> bool:
    return one.units == other.units and bool((one.weights() == other.weights()).all())


def _confidence(scores: list[float]) -> float:
    """Share of the best among all, when a score is the logarithm of a probability."""
    return round(float(1 / np.exp(np.array(scores) - scores[0]).sum()), 3)


def _reason(facts: Facts, sample: Sample, best: FormatChoice, runner_up: FormatChoice | None) -> str:
    """One sentence a person understands."""
    said = f"declared by {facts.sources()}" if facts.sources() else "nothing declared"
    if not runner_up:
        return said if best.digits else f"{said}; the numbers carry decimal points"
    layout = sample.layout(best)
    overlap = f"{layout.overlap:.0%} of holes overlapping" if layout.overlap else "no overlapping holes"
    seen = f"{overlap}, an extent of {layout.extent_mm:.1f} mm and {layout.grid:.0%} on a drawing grid"
    return f"{said}; {best} gives {seen}; runner-up {runner_up}"
