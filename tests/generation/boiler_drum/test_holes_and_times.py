"""What the panel says of a part program before it is run: where it drills, and how long each command takes."""

import random

import numpy as np
import pytest

from drillctl.generation.boiler_drum.holes import Hole, holes, wall_mm
from drillctl.generation.boiler_drum.part import job_of
from drillctl.generation.boiler_drum.sentence import sentence_of
from drillctl.generation.boiler_drum.text import Part
from drillctl.generation.boiler_drum.times import command_ticks
from drillctl.machine import Library, shipped_tables
from drillctl.ticker.forecast import forecast

MACHINE = Library((shipped_tables(),)).machine("boiler-drum")


def part(text: str) -> Part:
    sentences = tuple(sentence_of(word) for word in text.split())
    return Part("a part", sentences, tuple(range(1, len(sentences) + 1)))


def random_program(seed: int) -> str:
    """Ways there and back at any gear; the tool's are short, as its strokes are run tick by tick."""
    chance = random.Random(seed)
    words = []
    for _ in range(6):
        there, back, ways = chance.choice([("6", "4", (1, 7, 60, 300, 2000)), ("8", "2", (1, 2, 4))])
        way = chance.choice(ways)
        words += [f"{one}{chance.choice('0123456789ABCDEF')}{way:04}" for one in (there, back)]
    return " ".join(words)


@pytest.mark.parametrize("seed", range(2))
def test_the_ticks_of_every_command_are_those_of_a_run_to_the_tick(seed: int) -> None:
    job = job_of(part(random_program(seed)), MACHINE)
    assert command_ticks(job.program, MACHINE).tolist() == forecast(job.program, MACHINE).ticks.tolist()


def test_a_holes_place_depth_and_sentence() -> None:
    wall = wall_mm(MACHINE)
    assert wall == 10.0
    found = [*holes(part("6F0500 8F0080 810340 2F0420 6F0010 8F0090 2F0090 8F0150"), MACHINE)]
    assert found == [
        Hole(50.0, 32.0, 3),  # in two strokes, 8 and 34 mm from where the tool was set
        Hole(51.0, 5.0, 8),  # the stroke of 9 mm before it does not reach the wall; this one stays in it
    ]


def test_a_program_without_a_hole_has_none() -> None:
    assert [*holes(part("6F0500 4F0500"), MACHINE)] == []


def test_a_hole_that_is_pecked_is_one_hole_at_its_deepest_stroke() -> None:
    found = [*holes(part("8F0200 2F0050 8F0100 2F0250"), MACHINE)]
    assert np.allclose(found, [(0.0, 15.0, 3)])
