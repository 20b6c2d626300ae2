"""Broken tables: every bit of every phase table flipped, every number of every ramp moved by one. None goes unseen.

A mutation is refused at load, or the decoder (with the shipped table) finds an illegal word, or the run differs. A few
numbers of a ramp cannot matter: an accelerating distance in the top state, or one below the braking distance. Those
are counted here by that rule alone, and the digest that stands in every trace tells even them.
"""

import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import pytest

from drillctl.machine import Library, Machine, TableError, shipped_tables
from drillctl.machine.ramp import RampTable
from tests.support.bench import Bench, coarse, shipped
from tests.support.decoder import DecodeError, Watch, Windings, decoders

USED_BY = {  # a machine and the axis on which a table moves
    "two-phase-forced": ("pcb-drill", "x"),
    "five-phase-ten-beat": ("boiler-drum", "x"),
    "three-phase-six-beat": ("boiler-drum", "y"),
    "pulse-direction": ("eight-axis", "x"),
    "seven-state": ("pcb-drill", "x"),
    "drive-servo": ("eight-axis", "x"),
}
NUMBER = re.compile(r"^(?P<key>accelerate|brake|interval) = (?P<value>-?\d+)$", re.M)


@dataclass(frozen=True)
class Mutation:
    """A table's text with one thing changed, and what that was."""

    text: str
    told: str


def flipped_bits(text: str) -> Iterator[Mutation]:
    for pattern in re.finditer(r'pattern = "([x.]+)"', text):
        for mark in range(pattern.start(1), pattern.end(1)):
            other = "." if text[mark] == "x" else "x"
            yield Mutation(text[:mark] + other + text[mark + 1 :], f"{pattern[1]} at {mark - pattern.start(1)}")


def moved_numbers(text: str) -> Iterator[Mutation]:
    for number in NUMBER.finditer(text):
        state = re.findall(r"^state = (-?\d+)$", text[: number.start()], re.M)[-1]
        for step in (-1, 1):
            value = int(number["value"]) + step
            changed = text[: number.start("value")] + str(value) + text[number.end("value") :]
            yield Mutation(changed, f"state {state}: {number['key']} {number['value']} to {value}")


@pytest.fixture
def tables(tmp_path: Path) -> Path:
    """A copy of the shipped tables that a test may break; the eight-axis machine has a ramp of rows."""
    copy = Path(shutil.copytree(shipped_tables(), tmp_path / "tables"))
    machine = copy / "machines" / "eight-axis.toml"
    machine.write_text(machine.read_text("utf-8").replace('"from-parameters"', '"drive-servo"'), "utf-8")
    return copy


def loaded(tables: Path, kind: str, table: str, mutation: Mutation) -> Machine | None:
    """The machine that uses a table, with the table broken; None where that is refused."""
    (tables / kind / f"{table}.toml").write_text(mutation.text, "utf-8")
    try:
        return coarse(Library((tables,)).machine(USED_BY[table][0]))
    except TableError:
        return None


def words_of(machine: Machine, axis: str, distances: range) -> list[int]:
    """What a machine puts out for moves there and back, so that each distance is made in both directions."""
    b = Bench(machine)
    for distance in distances:
        b.queue(f"KMD_RUCHd {axis}={distance}; KMD_RUCHd {axis}=-{distance}").finish()
    return b.images


def decoder_of(name: str, axis: str) -> Windings:
    """The decoder that knows the shipped table."""
    shipped_file = shipped_tables() / "machines" / f"{name}.toml"
    (decoder,) = (found for found in decoders(shipped_file, shipped_tables()) if found.axis == axis)
    assert isinstance(decoder, Windings)
    return decoder


def illegal(name: str, axis: str, words: list[int]) -> bool:
    """Whether the decoder with the shipped tables finds an illegal word."""
    try:
        decoder_of(name, axis).recount(words, Watch())
    except DecodeError:
        return True
    return False


@pytest.mark.parametrize("table", ["two-phase-forced", "five-phase-ten-beat", "three-phase-six-beat"])
def test_every_flipped_bit_of_a_windings_table_is_an_illegal_word(tables: Path, table: str) -> None:
    name, axis = USED_BY[table]
    long_enough = 3 * len(decoder_of(name, axis).forward) + 1  # a whole cycle at full speed: no column can hide
    whole_cycle = range(long_enough, long_enough + 1)
    assert not illegal(name, axis, words_of(shipped(name), axis, whole_cycle))
    unseen = []
    for mutation in flipped_bits((tables / "phase" / f"{table}.toml").read_text("utf-8")):
        machine = loaded(tables, "phase", table, mutation)
        if machine is not None and not illegal(name, axis, words_of(machine, axis, whole_cycle)):
            unseen.append(mutation.told)
    assert unseen == []


def test_every_flipped_bit_of_a_drives_table_changes_the_steps_it_counts(tables: Path) -> None:
    _, axis = USED_BY["pulse-direction"]
    unseen = []
    for mutation in flipped_bits((tables / "phase" / "pulse-direction.toml").read_text("utf-8")):
        machine = loaded(tables, "phase", "pulse-direction", mutation)
        if machine is not None:
            b = Bench(machine).queue(f"KMD_RUCHd {axis}=9")
            b.finish()
            if not any(b.ticker.lost_steps()):
                unseen.append(mutation.told)
    assert unseen == []


def decides(ramp: RampTable) -> tuple[tuple[int, ...], ...]:
    """What of a ramp can matter: interval and braking distance of each state, and from where on it rises."""
    states = range(-ramp.top, ramp.top + 1)
    rises = tuple(max(ramp.accelerate[s] + 1, ramp.brake[s]) if abs(s) < ramp.top else 0 for s in states)
    return (ramp.interval, ramp.brake, rises)


@pytest.mark.parametrize(
    ("table", "every"), [("seven-state", 1), ("drive-servo", 7), pytest.param("drive-servo", 1, marks=pytest.mark.long)]
)
def test_every_number_of_a_ramp_moved_by_one_is_refused_or_changes_the_run(
    tables: Path, table: str, every: int
) -> None:
    """Of a long ramp each seventh; all of them with -m long."""
    name, axis = USED_BY[table]
    whole = coarse(Library((tables,)).machine(name))
    sound = whole.axes[0].ramp
    distances = range(1, 2 * sound.top + 4)  # beyond them only cruising is added
    expected = words_of(whole, axis, distances)
    unseen = []
    for mutation in islice(moved_numbers((tables / "ramp" / f"{table}.toml").read_text("utf-8")), None, None, every):
        machine = loaded(tables, "ramp", table, mutation)
        if machine is None:
            continue
        assert machine.digest != whole.digest, mutation.told
        if decides(machine.axes[0].ramp) != decides(sound) and words_of(machine, axis, distances) == expected:
            unseen.append(mutation.told)
    assert unseen == []


def test_a_flipped_bit_and_a_moved_number_each_change_just_one_character() -> None:
    """The mutations themselves are what they say."""
    phase = (shipped_tables() / "phase" / "two-phase-forced.toml").read_text("utf-8")
    ramp = (shipped_tables() / "ramp" / "seven-state.toml").read_text("utf-8")
    assert len({mutation.text for mutation in flipped_bits(phase)} - {phase}) == 6 * 12
    assert len({mutation.text for mutation in moved_numbers(ramp)} - {ramp}) == 7 * 3 * 2
    for mutation in flipped_bits(phase):
        assert sum(a != b for a, b in zip(mutation.text, phase, strict=True)) == 1
