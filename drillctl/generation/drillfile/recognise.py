"""Which number format a file is in. Rule: what is declared is believed; where only the unit is, its default digits
hold (INCH 00.0000, METRIC 000.000); only what is left open is guessed.

A guess comes with its confidence, its runner-up, a sentence that says why, and a warning. `reader` calls
`recognise` with the machine after the whole program has run.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from drillctl.language import Message

from .errors import Complaint, Remark
from .facts import Facts
from .layout import LARGEST_MM, Layout
from .machine import Machine
from .model import DEFAULT_DIGITS, MM_PER_UNIT, FormatChoice
from .sample import Sample
from .score import COMMON_DIGITS, Digits, board, common, drills, same_places, usual

ZEROS = ("none", "leading", "trailing")
SURE = 0.97  # below this confidence the guess is announced as one
FEW_PLACES = 6  # below this number of holes a guess is always announced
EAGLE_DIGITS = (2, 5)  # written under a bare M72; its drills then have five decimals as well
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
    reason: Message
    remarks: tuple[Remark, ...] = ()
    by_hand: bool = False


@dataclass(frozen=True)
class Question:
    """What is open about a file's format: what it declares, the digits that hold (declared, or by the unit's rule;
    None: to be guessed), whether they hold by the rule, and whether the numbers contradict the declared zeros."""

    facts: Facts
    sample: Sample
    digits: tuple[int, int] | None
    by_rule: bool
    contradicted: bool


def parse_option(text: str) -> FormatChoice:
    """The format a person gives: 'inch,2:4,leading' or 'mm,decimal'. Complaint 'bad-format'."""
    found = FORMAT_OPTION.fullmatch(text.strip().lower())
    if not found:
        raise Complaint("bad-format", text)
    units, integer, decimal, zeros = found.groups()
    return FormatChoice(units, (int(integer), int(decimal)) if integer else None, zeros)


def recognise(machine: Machine, option: FormatChoice | None) -> Recognition:
    """The format of a program that has run; option is the one a person settled on."""
    if option:
        return Recognition(option, 1.0, None, Message("set by hand: {format}", format=option.message), by_hand=True)
    sample = Sample.of(machine)
    question = _question(machine.facts, sample)
    scored = _scored(question)
    best = scored[0]
    runner_up = scored[1] if len(scored) > 1 else None
    layout = sample.layout(best)
    confidence = _confidence([choice.score for choice in scored])
    remarks = [*_remarks(question, best, layout)]
    if runner_up and (confidence < SURE or layout.places < FEW_PLACES):
        remarks.append(Remark("format-guessed", None, f"{best}; or {runner_up}"))
    reason = _reason(question, best, runner_up, layout)
    found = Recognition(best, confidence, runner_up, reason, tuple(remarks))
    return _doubted(found, question) if layout.piled_up and not runner_up else found


def dialect(machine: Machine, choice: FormatChoice, *, tape_code: bool) -> str:
    """What a person calls such a file."""
    if tape_code:
        return "EIA RS-244"
    return DIALECTS[choice.zeros] if machine.headers else "ASCII drill (OrCAD)"


def _doubted(declared: Recognition, question: Question) -> Recognition:
    """A declared format under which most holes overlap, looked at again as if only the units had been declared."""
    scored = _scored(Question(Facts(units=question.facts.units), question.sample, None, False, False))
    own = next((choice.score for choice in scored if _same(choice, declared.choice)), -np.inf)
    if scored[0].score < own + ALTERNATIVE_MARGIN or _same(scored[0], declared.choice):
        return declared
    reason = Message(
        "{reason}; but its holes overlap, and {format} is more plausible",
        reason=declared.reason,
        format=scored[0].message,
    )
    return replace(declared, confidence=0.5, runner_up=scored[0], reason=reason)


def _question(facts: Facts, sample: Sample) -> Question:
    units = facts.units.value if facts.units else None
    declared = facts.digits_for(units)
    likely = declared.value if declared else DEFAULT_DIGITS.get(units or "")
    contradicted = _zeros_contradicted(facts, sample.digits, likely)
    if declared or not units or not sample.digits.count:
        return Question(facts, sample, declared.value if declared else None, False, contradicted)
    rule = Question(facts, sample, DEFAULT_DIGITS[units], True, contradicted)
    return replace(rule, digits=None, by_rule=False) if _rule_is_broken(rule, units) else rule


def _rule_is_broken(rule: Question, units: str) -> bool:
    """Whether the numbers can't have their unit's default digits."""
    digits, sample, facts = DEFAULT_DIGITS[units], rule.sample, rule.facts
    if sample.digits.other_width(digits, facts.zeros.value if facts.zeros else None):
        return True
    best = _scored(rule)[0]
    layout = sample.layout(best)
    eagle = same_places(replace(best, digits=EAGLE_DIGITS), sample.places) > 0
    return layout.piled_up or (eagle and layout.extent_mm > LARGEST_MM)


def _scored(question: Question) -> list[FormatChoice]:
    """Every candidate with its score, best first; of those that give the same board, the best."""
    best: dict[tuple[str, bytes], FormatChoice] = {}
    layouts: dict[tuple[str, bytes], Layout] = {}
    for choice in _candidates(question):
        key = choice.units, np.round(question.sample.xy_mm(choice), 6).tobytes()
        if key not in layouts:
            layouts[key] = question.sample.layout(choice)
        score = round(board(layouts[key]) + usual(choice, layouts[key]) + _score(choice, question), 3)
        if key not in best or score > best[key].score:
            best[key] = replace(choice, score=score)
    return sorted(best.values(), key=lambda choice: -choice.score)


def _candidates(question: Question) -> Iterator[FormatChoice]:
    """All formats that agree with what is declared."""
    facts, sample = question.facts, question.sample
    for units in [facts.units.value] if facts.units else list(MM_PER_UNIT):
        if not sample.digits.count or (sample.decimals and not question.digits):
            yield FormatChoice(units)
        if sample.digits.count or (question.digits and not sample.decimals):
            places = [question.digits] if question.digits else _common_places(units, bool(facts.units))
            zeros = [facts.zeros.value] if facts.zeros and not question.contradicted else list(ZEROS)
            other = _other_digits(facts, units)
            yield from (FormatChoice(units, *pair, other) for pair in product(places, zeros))


def _common_places(units: str, declared: bool) -> list[tuple[int, int]]:
    """The digits to try; a declared METRIC has three integer digits or four, two are inch."""
    places = list(COMMON_DIGITS[units])
    return [each for each in places if each[0] > 2] if declared and units == "mm" else places


def _other_digits(facts: Facts, units: str) -> tuple[int, int]:
    """Digits of numbers that a file with changing units writes in the other unit."""
    other = next(each for each in MM_PER_UNIT if each != units)
    declared = facts.digits_for(other)
    return declared.value if declared else DEFAULT_DIGITS[other]


def _score(choice: FormatChoice, question: Question) -> float:
    """What speaks for a format beside the board that it gives."""
    facts, sample = question.facts, question.sample
    score = common(choice) + same_places(choice, sample.places)
    if choice.digits and sample.digits.count:
        score += sample.digits.dropped(choice.zeros, choice.digits) + sample.digits.fits(choice.digits)
    if not facts.units:
        score += drills(sample.diameters_mm(choice))
    if question.contradicted and facts.zeros and choice.zeros == facts.zeros.value:
        score += DECLARED_BONUS
    return score


def _zeros_contradicted(facts: Facts, digits: Digits, places: tuple[int, int] | None) -> bool:
    """Whether the zeros that are declared dropped are there, while the other kind is missing."""
    if not facts.zeros or facts.zeros.value == "none" or not digits.count or digits.equal:
        return False
    declared = facts.zeros.value
    other = "leading" if declared == "trailing" else "trailing"
    width = places or (0, 0)
    return digits.dropped(declared, width) <= CONTRADICTED and digits.dropped(other, width) >= CONTRADICTED


def _same(one: FormatChoice, other: FormatChoice) -> bool:
    return one.units == other.units and bool((one.weights() == other.weights()).all())


def _confidence(scores: list[float]) -> float:
    """Share of the best among all, when a score is the logarithm of a probability."""
    return round(float(1 / np.exp(np.array(scores) - scores[0]).sum()), 3)


def _remarks(question: Question, best: FormatChoice, layout: Layout) -> Iterator[Remark]:
    """What a person must know about the choice."""
    facts, sample = question.facts, question.sample
    if facts.zeros and question.contradicted:
        yield Remark("zeros-contradict-data", facts.zeros.line, facts.zeros.source)
    if facts.units is None:
        yield Remark("missing-units", None, best.units)
    elif best.digits and not facts.digits_for(best.units):
        yield from _of_default(question, best)
    if facts.digits and best.digits:
        foreign = sample.units - {best.units}
        yield from (_carried(facts, units) for units in foreign if not facts.digits_for(units))
    if layout.odd or (layout.unusual and question.by_rule):
        yield Remark("odd-board", None, str(layout))


def _of_default(question: Question, best: FormatChoice) -> Iterator[Remark]:
    """Digits declared for the other unit only, or default digits that the numbers do not have."""
    if question.facts.digits:
        yield _carried(question.facts, best.units)
    if not question.by_rule:
        default = replace(best, digits=DEFAULT_DIGITS[best.units])
        yield Remark("default-digits-left", None, f"{best.format}, not {default.format}")


def _carried(facts: Facts, units: str) -> Remark:
    _, fact = facts.digits[-1]
    default = FormatChoice(units, DEFAULT_DIGITS[units])
    return Remark("digits-of-other-unit", fact.line, f"{fact.source}; {units} is read as {default.format}")


def _reason(question: Question, best: FormatChoice, runner_up: FormatChoice | None, layout: Layout) -> Message:
    """One sentence a person understands."""
    said = (
        Message("declared by {sources}", sources=question.facts.sources())
        if question.facts.sources()
        else Message("nothing declared")
    )
    if question.by_rule:
        said = Message("{said}; {units} without digits is {digits}", said=said, units=best.units, digits=best.format)
    if not runner_up:
        return said if best.digits else Message("{said}; the numbers carry decimal points", said=said)
    overlap = (
        Message("{share:.0%} of holes overlapping", share=layout.overlap)
        if layout.overlap
        else Message("no overlapping holes")
    )
    seen = Message(
        "{overlap}, an extent of {extent:.1f} mm and {grid:.0%} on a drawing grid",
        overlap=overlap,
        extent=layout.extent_mm,
        grid=layout.grid,
    )
    return Message(
        "{said}; {format} gives {seen}; runner-up {second}",
        said=said,
        format=best.message,
        seen=seen,
        second=runner_up.message,
    )
