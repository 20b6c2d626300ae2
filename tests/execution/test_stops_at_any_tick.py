"""Hold, stop, fault, emergency stop and a silent converter at a seeded tick of a board on six spindles: the outputs are
at the levels that the machine's file names, and each hole is accounted for.
"""

import random
import tomllib
from dataclasses import replace
from functools import cache

import pytest

from drillctl.kmd import Condition, Fault, Request
from drillctl.machine import Machine, shipped_tables
from tests.support.bench import Bench, shipped

PLACES = ((30, 0), (30, 40), (90, 40), (90, 10), (10, 10))
SEEDS = 1000
OPENED = 3  # the axis of spindle 2, whose chuck is opened and has lost its bit
KINDS = ("hold", "silence", "stop", "fault", "estop")
FILE = tomllib.loads((shipped_tables() / "machines" / "eight-axis.toml").read_text())


@cache
def machine(emergency_stop: str) -> Machine:
    """The shipped machine with short strokes, so that a thousand boards are drilled in a minute."""
    plain = shipped("eight-axis")
    surfaces = tuple(surface and 20 for surface in plain.board_surface)
    return replace(plain, emergency_stop=emergency_stop, drill_down_steps=40, board_surface=surfaces)


def bench(emergency_stop: str) -> Bench:
    b = Bench(machine(emergency_stop))
    b.m.position_known = True
    lines = ["KMD_WYJSCIE chuck_2 1", "KMD_WYJSCIE presser_foot 1", "KMD_WRZECIONO 30000"]
    for x, y in PLACES:
        lines += [f"KMD_RUCH x={x} y={y}", "KMD_WIERTLO_DOL", "KMD_WIERTLO_GORA"]
    lines += ["KMD_WRZECIONO 0", "KMD_WYJSCIE chuck_5 1", "KMD_CZEKAJ 20"]
    program = b.program("; ".join(lines))
    program["tag"][program["opcode"] == 3] = range(1, len(PLACES) + 1)
    return b.put(program)


@cache
def length() -> int:
    return bench("drop").finish()


def levels(b: Bench, event: str) -> dict[str, int]:
    """What each output is to be after an event, by the file alone, from what it is now."""
    now = outputs(b)
    rows = {row["name"]: row.get(event, 0) for row in FILE["output"]}
    return {name: now[name] if level == "keep" else level for name, level in rows.items()}


def outputs(b: Bench) -> dict[str, int]:
    found = {}
    for row in FILE["output"]:
        first, bits = row.get("word", [row.get("bit"), 1])
        found[row["name"]] = b.m.image >> first & (1 << bits) - 1
    return found


def touched(b: Bench) -> dict[int, set[int]]:
    """By spindle that has a bit, the holes in which it has met its board. The plant counts all: none did so twice."""
    heads: dict[int, set[int]] = {axis: set() for axis in b.machine.drill_axes if axis != OPENED}
    for _, tag, _, axis in b.ticker.touched:
        heads[axis].add(tag)
    assert b.ticker.plant is not None
    assert {axis: len(tags) for axis, tags in heads.items()} == {axis: b.ticker.plant.met[axis] for axis in heads}
    return heads


def ended(b: Bench, kind: str, request: Request | None) -> None:
    """The job is over: each output has its level, and no hole but the one that is named was begun and not done."""
    expected = levels(b, kind)
    if request is not None:
        b.ask(request).tick()
    b.until(lambda: b.m.condition in (Condition.LATCHED, Condition.READY) and not b.m.moving and not b.m.job)
    assert outputs(b) == expected
    done = set(range(1, b.m.holes_done + 1))
    for tags in touched(b).values():
        assert done <= tags and tags - done <= {b.m.hole_begun}


def held(b: Bench, silent: bool, ticks: int) -> None:
    """The job is held for a while and goes on: nothing is switched meanwhile, and every hole is drilled once."""
    before = outputs(b)
    if silent:
        b.card.stuck_low |= b.input_bit("converter_fault")
    else:
        b.ask(Request.HOLD)
    b.tick(ticks)
    if b.m.condition == Condition.HOLDING:
        assert outputs(b) == before
    b.card.stuck_low = 0
    b.ask(Request.RESUME).until(lambda: not b.m.job and b.m.condition == Condition.READY)
    assert b.m.fault == Fault.NONE and b.m.holes_done == len(PLACES)
    assert all(tags == set(range(1, len(PLACES) + 1)) for tags in touched(b).values())


def at_a_tick(seed: int) -> None:
    chance = random.Random(seed)
    kind = KINDS[seed % len(KINDS)]
    b = bench(chance.choice(["drop", "hold", "brake"]))
    b.tick(chance.randrange(1, length() - 25))
    if kind in ("hold", "silence"):
        held(b, kind == "silence", chance.randrange(1, 200))
    elif kind == "fault":
        axis = chance.choice(b.m.axes[:2])
        expected = levels(b, "fault")
        b.card.stuck_high = axis.limits[1] | axis.limits[-1] or 0
        b.tick()
        assert b.m.fault == Fault.SENSOR_CONTRADICTION and outputs(b) == expected
        ended(b, "fault", None)
    else:
        ended(b, kind, Request.STOP if kind == "stop" else Request.ESTOP)


@pytest.mark.parametrize("seed", range(len(KINDS)))
def test_at_some_ticks(seed: int) -> None:
    at_a_tick(seed)


@pytest.mark.long
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("first", range(0, SEEDS, 100))
def test_at_a_thousand_ticks(first: int) -> None:
    for seed in range(first, first + 100):
        at_a_tick(seed)
