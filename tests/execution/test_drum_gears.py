"""The drum's drill as it is shipped, at 100,000 ticks a second: every gear, direction, short and long strokes.

What a part program ought to do is read from its characters (tests/support/sentences.py), what it did from the coil
words by the sequences as the paper prints them: neither shares a line, or a table, with the program.
"""

from itertools import pairwise

import numpy as np
import pytest

from drillctl.generation.boiler_drum.gears import LETTERS, interval_ticks
from drillctl.generation.boiler_drum.program import part_program
from drillctl.generation.boiler_drum.text import parse_part
from drillctl.kmd import Condition, Fault, Request
from drillctl.machine import Library, shipped_tables
from drillctl.machine.landing import Strokes
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Trace, first_difference, render
from tests.support.bench import Bench, shipped
from tests.support.sentences import decoded
from tests.support.twins import ran, remembered, trace

DRUM = Library((shipped_tables(),)).machine("boiler-drum")
# By carriage: the paper's sequence of coils, and the bits of port B: a to e of the large one, a to c of the small one.
SEQUENCES = (
    (["AB", "ABC", "BC", "BCD", "CD", "CDE", "DE", "DEA", "EA", "EAB"], {"A": 0, "B": 1, "C": 2, "D": 3, "E": 4}),
    (["A", "AB", "B", "BC", "C", "CA"], {"A": 5, "B": 6, "C": 7}),
)
WAYS = ("64", "82")  # large carriage on and back, small carriage on and back
STEPS_PER_TENTH = 5
FOREVER = 10**9


def strokes(letter: str, lengths: int = 5) -> str:
    """Sentences there and back on both carriages: the shortest, the longest without and the shortest with a ramp."""
    gear, lines = LETTERS.index(letter), []
    for axis, ways in zip(DRUM.axes, WAYS, strict=True):
        ramped = Strokes(axis.ramp).ramped_from(1, interval_ticks(gear, axis, DRUM.tick_hz)) + 1
        edge = -(-ramped // STEPS_PER_TENTH)
        chosen = (1, 2, max(edge - 1, 3), edge + 3, edge + 60)[:lengths]
        lines += [f"{way}{letter}{tenths:04}" for tenths in chosen for way in ways]
    return "\n".join(lines) + "\n"


def program_of(text: str) -> np.ndarray:
    return part_program(parse_part(text, "p"), DRUM)


def run_fast(text: str) -> tuple[FastTicker, Trace]:
    ticker = FastTicker.ideal(DRUM, traced=True)
    ran(ticker, program_of(text), {}, FOREVER)
    return ticker, trace(ticker)


def word_changes(found: Trace) -> tuple[list[int], list[int]]:
    """The ticks in which the card's word changed, and the words."""
    ticks, words = found.changes_of("out.0")
    return ticks.tolist(), words.tolist()


@pytest.mark.parametrize("letter", LETTERS)
def test_every_gear_lands_exactly_both_ways_on_short_and_long_strokes(letter: str) -> None:
    text = strokes(letter)
    ticker, found = run_fast(text)
    m = ticker.controller
    assert m.fault == Fault.NONE
    assert [axis.position for axis in m.axes] == [*map(round, ticker.lost_steps())] == [0, 0]
    ticks, words = word_changes(found)
    for axis, sequence in enumerate(SEQUENCES):
        assert runs(steps_of(words, *sequence)) == [row[axis] for row in decoded(text) if row[axis]]
    metres_a_minute = decoded(text)[0][2]
    due = round(DRUM.tick_hz / (metres_a_minute * 1000 / 60 / 0.02))
    least = min(after - before for before, after in pairwise(ticks))
    assert least == due, "the gear's own interval is never reached, or passed"


def steps_of(words: list[int], sequence: list[str], bits: dict[str, int]) -> list[int]:
    """The steps of a carriage, +1 or -1 each: where its coils go on to the next of their sequence, or to the one
    before. A motor that was not on yet stands at the last of them.
    """
    beats = [frozenset(beat) for beat in sequence]
    lit = [frozenset(coil for coil, bit in bits.items() if word >> bit & 1) for word in words]
    places = [beats.index(coils) for coils in lit if coils]  # raises for coils that are never on together
    ways = [(after - before) % len(beats) for before, after in pairwise([len(beats) - 1, *places])]
    assert set(ways) <= {0, 1, len(beats) - 1}, "a beat was left out"
    return [1 if way == 1 else -1 for way in ways if way]


def runs(steps: list[int]) -> list[int]:
    """Steps of one sign after the other, summed: each a stroke, since every second one goes back."""
    found: list[int] = []
    for step in steps:
        if found and (found[-1] > 0) == (step > 0):
            found[-1] += step
        else:
            found.append(step)
    return found


def check_engines(text: str) -> None:
    """Both engines put out the same words in the same ticks, and remember the same."""
    fast, _ = run_fast(text)
    slow = ran(Ticker.simulated(DRUM, traced=True), program_of(text), {}, FOREVER)
    difference = first_difference(trace(slow), trace(fast))
    assert difference is None, render(difference)
    assert remembered(slow) == remembered(fast)


def test_on_the_shortest_strokes_the_fast_engine_is_the_tick() -> None:
    check_engines(strokes("F", lengths=2))


@pytest.mark.long
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("letter", LETTERS)
def test_at_every_gear_the_fast_engine_is_the_tick(letter: str) -> None:
    check_engines(strokes(letter))


@pytest.mark.long
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("request_", [Request.STOP, Request.ESTOP])
def test_from_every_tick_of_a_program_the_carriages_return_to_zero(request_: Request) -> None:
    """On the bench's coarse ticks, so that every tick of the program can be the one of the stop."""
    machine = shipped("boiler-drum")
    text = "KMD_RUCHd x=90; KMD_RUCHd y=70; KMD_RUCHd y=-70; KMD_RUCHd x=-30; KMD_RUCHd y=40"
    whole = Bench(machine).ready().queue(text).finish()
    for tick in range(1, whole):
        b = Bench(machine).ready().queue(text).tick(tick).ask(request_)
        b.finish()
        b.ask(Request.ACK).tick().queue("KMD_POWROT").finish()
        assert (b.positions(), b.m.fault, b.m.condition) == ([0, 0], Fault.NONE, Condition.READY), tick
        assert not any(b.ticker.lost_steps()), tick
        assert [round(b.card.plant.position_steps(axis)) for axis in (0, 1)] == [0, 0], tick


@pytest.mark.parametrize("sentences_done", range(5))
def test_after_each_sentence_the_carriages_return_to_zero(sentences_done: int) -> None:
    """At the machine's own ticks: the tool first, both to the place where the part program began."""
    text = "6F0120\n8C0040\n820010\n2C0050\n4A0070\n"
    part = program_of("\n".join(text.split()[: sentences_done + 1]))[:-1]
    part = np.concatenate([part, Bench(DRUM).program("KMD_POWROT")])
    part["sequence"] = np.arange(1, len(part) + 1)
    found: Ticker = ran(FastTicker.ideal(DRUM), part, {}, FOREVER)
    m = found.controller
    assert (m.fault, [axis.position for axis in m.axes], m.done) == (Fault.NONE, [0, 0], len(part))
    assert not any(map(round, found.lost_steps()))
