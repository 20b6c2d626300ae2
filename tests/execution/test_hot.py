"""What a person switches on and would burn a winding goes off after a second, counted in ticks (docs/SPEC.md, 1.22)."""

import pytest

from drillctl.kmd import Request
from tests.support.bench import Bench, shipped

HZ = 50  # a second is short then


def bench(name: str = "pcb-drill") -> Bench:
    b = Bench(shipped(name).at_rate(HZ)).queue("KMD_RUCHd x=2 y=1")
    b.finish()
    return b.tick(2)


def by_hand(b: Bench, *bits: tuple[int, int]) -> Bench:
    for bit, on in bits:
        assert b.ticker.requests.set_output(bit.bit_length() - 1, on)
    return b.tick(len(bits))


def on(b: Bench, bits: int) -> bool:
    return b.images[-1] & bits == bits


@pytest.mark.parametrize("wire", ["24a", "24b"])
def test_forcing_is_on_for_a_second_and_no_tick_longer(wire: str) -> None:
    b = bench()
    held, forced = b.images[-1], b.bits("x", wire)
    by_hand(b, (forced, 1))
    told = [int(b.ticker.report()["hot_ticks"])]
    for _ in range(HZ - 1):
        b.tick()
        told.append(int(b.ticker.report()["hot_ticks"]))
        assert on(b, forced) and not b.m.cut_off
    assert told == [*range(HZ - 1, -1, -1)]
    b.tick()
    assert b.images[-1] == held and b.ticker.report()["cut_off"] and not b.ticker.report()["hot_ticks"]


def test_of_two_halves_the_one_that_was_added_goes_off() -> None:
    b = bench()
    held = b.images[-1]
    halves = b.bits("x", "1a", "1b"), b.bits("x", "2a", "2b")
    added = next(pair & ~held for pair in halves if held & pair)
    by_hand(b, (added, 1))
    b.tick(HZ - 1)
    assert on(b, added | held)
    b.tick()
    assert b.images[-1] == held


@pytest.mark.parametrize("name", ["pcb-drill", "pcb-drill-ramp-lab", "mega-28byj48"])
def test_whatever_wires_are_switched_on_nothing_that_burns_is_left(name: str) -> None:
    b = bench(name)
    wires = [1 << bit for axis in b.machine.axes for bit in axis.wire_bits]
    for first in range(0, len(wires), 16):
        by_hand(b, *((bit, 1) for bit in wires[first : first + 16]))
    b.tick(HZ + len(wires))
    for axis in b.m.axes:
        assert not axis.hold_bits & axis.forcing
        assert not any(axis.hold_bits & pair == pair for pair in axis.halves)


def test_switched_off_and_on_again_it_has_its_second_anew() -> None:
    b = bench()
    forced = b.bits("y", "24a")
    by_hand(b, (forced, 1)).tick(HZ - 5)
    by_hand(b, (forced, 0))
    assert not b.m.hot_until
    by_hand(b, (forced, 1)).tick(HZ - 1)
    assert on(b, forced)
    assert not on(b.tick(), forced)


def test_a_single_winding_at_5_volts_is_not_limited() -> None:
    b = bench()
    bit = next(b.bits("z", wire) for wire in ("1a", "1b") if not b.images[-1] & b.bits("z", "1a", "1b"))
    by_hand(b, (bit, 1)).tick(3 * HZ)
    assert on(b, bit) and not b.m.hot_until


@pytest.mark.parametrize("meanwhile", ["a job", "an emergency stop that holds", "another rate"])
def test_it_goes_off_whatever_happens_meanwhile(meanwhile: str) -> None:
    b = bench("pcb-drill")
    forced = b.bits("y", "24a")
    by_hand(b, (forced, 1))
    if meanwhile == "a job":
        b.queue("KMD_RUCHd x=400")
    elif meanwhile == "another rate":
        b.ticker.requests.set_rate(2 * HZ)
        b.tick(HZ)
        assert on(b, forced), "a second has twice as many ticks now"
    else:
        b.ask(Request.STOP)
    b.tick(2 * HZ)
    assert not on(b, forced)


def test_a_column_of_the_table_is_never_touched() -> None:
    """The axis moves on while its second runs: what it puts out is as if nothing had been switched."""
    b, plain = bench(), bench()
    by_hand(b, (b.bits("x", "24a"), 1))
    plain.tick()
    b.images.clear()
    plain.images.clear()
    for each in (b, plain):
        each.queue("KMD_RUCHd x=300").finish()
    assert b.images[10:] == plain.images[10:]
