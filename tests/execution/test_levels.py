"""Outputs that have a level for each kind of stop: all 27 rows on one machine, after every kind of stop."""

from dataclasses import replace
from itertools import product

import pytest

from drillctl.kmd import Condition, Fault, Request
from drillctl.machine import Machine
from drillctl.machine.levels import OutputLevels, Word
from drillctl.ports import CARD_BITS
from tests.support.bench import Bench, shipped

ROWS = [(f"o{n}", CARD_BITS + n, ("keep", *levels)) for n, levels in enumerate(product(("keep", 0, 1), repeat=3))]
STOP, FAULT, ESTOP = 1, 2, 3  # places in a row, as a machine's file has them
ON = [name for name, bit, _ in ROWS if bit % 2]
WORD = Word("spindle_wanted", 2 * CARD_BITS, 16)
SPINDLE = (("spindle", 31),)


def machine(emergency_stop: str = "drop") -> Machine:
    plain = shipped("pcb-drill")
    levels = [OutputLevels(name, 1 << bit, at) for name, bit, at in ROWS]
    outputs = (*SPINDLE, *((name, bit) for name, bit, _ in ROWS))
    return replace(plain, emergency_stop=emergency_stop, outputs=outputs, levels=tuple(levels))


def switched(b: Bench) -> dict[str, int]:
    return {name: b.m.image >> bit & 1 for name, bit, _ in ROWS}


def wanted(event: int) -> dict[str, int]:
    return {name: int(name in ON) if at[event] == "keep" else at[event] for name, _, at in ROWS}


def moving(emergency_stop: str) -> Bench:
    """In a move, with every second output and the spindle on."""
    b = Bench(machine(emergency_stop))
    b.queue("; ".join(f"KMD_WYJSCIE {name} 1" for name in (*ON, "spindle")) + "; KMD_GOTOdXdY 900 700")
    b.until(lambda: b.m.moving == 2 and b.m.axes[0].state > 1)
    assert switched(b) == {name: int(name in ON) for name, _, _ in ROWS}
    return b


def spindle(b: Bench) -> int:
    return b.m.image >> dict(b.machine.outputs)["spindle"] & 1


@pytest.mark.parametrize("kind", ["drop", "hold", "brake"])
def test_after_an_emergency_stop_each_output_has_its_level(kind: str) -> None:
    b = moving(kind)
    b.ask(Request.ESTOP).tick()
    if kind != "brake":
        assert switched(b) == wanted(ESTOP), "in the tick of the stop"
    b.until(lambda: b.m.condition == Condition.LATCHED)
    assert switched(b) == wanted(ESTOP) and not spindle(b)


def test_after_a_stop_each_output_has_its_level_once_all_rests() -> None:
    b = moving("drop")
    b.ask(Request.STOP).tick()
    assert switched(b) != wanted(STOP)
    b.until(lambda: not b.m.moving)
    assert switched(b) == wanted(STOP) and not spindle(b)


def test_after_a_fault_each_output_has_its_level() -> None:
    b = moving("drop")
    b.card.stuck_high = b.m.axes[0].limits[1]
    b.until(lambda: b.m.condition == Condition.LATCHED)
    assert b.m.fault == Fault.LIMIT and switched(b) == wanted(FAULT) and not spindle(b)


def test_a_hold_leaves_all_outputs_as_they_are() -> None:
    b = moving("drop")
    b.ask(Request.HOLD).tick(400)
    assert b.m.condition == Condition.HOLDING and not b.m.moving
    assert switched(b) == {name: int(name in ON) for name, _, _ in ROWS} and spindle(b)


def test_the_gravest_of_several_stops_counts_until_it_is_acknowledged() -> None:
    b = moving("brake")
    b.ask(Request.ESTOP).tick()
    b.ask(Request.STOP)
    b.until(lambda: b.m.condition == Condition.LATCHED)
    assert switched(b) == wanted(ESTOP)
    b.ask(Request.ACK).tick()
    b.queue("; ".join(f"KMD_WYJSCIE {name} {int(name in ON)}" for name, _, _ in ROWS), end=False).tick(40)
    b.ask(Request.STOP).tick(2)
    assert switched(b) == wanted(STOP)


def test_what_makes_the_outputs_safe_has_no_wire_of_an_axis_and_each_output_at_its_level() -> None:
    b = moving("drop")
    safe = b.m.safe_image
    assert {name: safe >> bit & 1 for name, bit, _ in ROWS} == wanted(ESTOP)
    assert not safe & sum(1 << bit for axis in b.machine.axes for bit in axis.wire_bits) and b.m.image & ~safe


def test_outputs_begin_at_their_level_at_power_on() -> None:
    rows = [OutputLevels("on", 1 << 40, (1, 0, 0, 0)), OutputLevels("off", 1 << 41, (0, 0, 0, 0))]
    b = Bench(replace(shipped("pcb-drill"), levels=tuple(rows))).queue("KMD_CZEKAJ 3").tick()
    assert b.images == [1 << 40]


@pytest.mark.parametrize("kept", [False, True])
def test_a_speed_is_put_out_as_a_number_and_goes_to_0_at_a_stop_unless_it_is_kept(kept: bool) -> None:
    rows = (OutputLevels(WORD.name, WORD.mask, (0, *("keep" if kept else 0,) * 3)),)
    plain = replace(shipped("pcb-drill"), outputs=SPINDLE, output_words=(WORD,), levels=rows)
    b = Bench(plain).queue("KMD_WRZECIONO 43210; KMD_CZEKAJ 9").tick(3)
    assert WORD.value(b.m.image) == 43210 and spindle(b)
    b.ask(Request.ESTOP).tick()
    assert WORD.value(b.m.image) == (43210 if kept else 0) and not spindle(b)


def test_a_speed_that_the_word_can_not_hold_changes_nothing() -> None:
    b = Bench(shipped("eight-axis")).queue("KMD_WRZECIONO 65536").tick(2)
    assert b.m.fault == Fault.BAD_COMMAND and not b.m.image
