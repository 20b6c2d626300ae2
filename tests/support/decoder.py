"""Recounts steps from output words alone, and says where a word is one that no sound machine puts out.

Rule: knows nothing of the program. It reads the tables' rows and the wiring with tomllib, and sees the words of a
card, tick by tick, as a logic analyser would. Several columns may look alike (the paper's table changes its windings
every third column), so an axis is followed as the set of all columns in which it may be; the set is exact again at
the next change. Used by tests/execution.
"""

import tomllib
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

SHOWN, MASKED, OFF = "shown", "masked", "off"
Place = tuple[int, str]  # columns travelled, and how the column is put out


class DecodeError(Exception):
    """A word that is wrong: ``str()`` names tick, axis, word and what it breaks."""

    def __init__(self, tick: int, axis: str, word: int, reason: str):
        super().__init__(f"tick {tick}, axis {axis}, word {word:#010x}: {reason}")


@dataclass(frozen=True)
class Recount:
    """By tick: the least and the greatest number of columns that an axis can have travelled, forward positive."""

    least: list[int]
    most: list[int]


@dataclass(frozen=True)
class Watch:
    """What is known besides the words: ticks in which everything rests, and how long a step may take at most."""

    cold_ticks: frozenset[int] = frozenset()
    longest_ticks: int = 1_000_000


@dataclass(frozen=True)
class Decoder(ABC):
    """One axis's words, followed. ``sense`` is -1 where the machine's file inverts the axis."""

    axis: str
    columns_per_step: int
    sense: int

    @abstractmethod
    def recount(self, words: Sequence[int], watch: Watch) -> Recount:
        """Follows the words from power-up on, one a tick. Raises DecodeError."""


@dataclass(frozen=True)
class Windings(Decoder):
    """A wound motor. ``forward`` and ``backward`` are the card's bits by column; ``mask`` all of them."""

    forward: list[int]
    backward: list[int]
    mask: int
    forcing: int

    def recount(self, words: Sequence[int], watch: Watch) -> Recount:
        places: set[Place] = {(0, OFF)}
        found = Recount([], [])
        forced_ticks, last = 0, 0
        for tick, word in enumerate(words):
            bits = word & self.mask
            places = self._following(places, bits)
            if not places:
                raise DecodeError(tick, self.axis, word, "no column at most one from the last looks so")
            forced_ticks = (forced_ticks + 1 if bits == last else 1) if bits & self.forcing else 0
            if forced_ticks > watch.longest_ticks or (forced_ticks and tick in watch.cold_ticks):
                raise DecodeError(tick, self.axis, word, "forcing on an axis at rest")
            last = bits
            columns = [column * self.sense for column, _ in places]
            found.least.append(min(columns))
            found.most.append(max(columns))
        return found

    def _following(self, places: set[Place], bits: int) -> set[Place]:
        found = {(column, OFF) for column, _ in places if bits == 0}
        for column, how in places:
            for way, rows in ((1, self.forward), (-1, self.backward)):
                if bits == rows[self._row(column + way)]:
                    found.add((column + way, SHOWN))
                if how == SHOWN and bits == rows[self._row(column)]:
                    found.add((column, SHOWN))
                if how != OFF and bits == rows[self._row(column)] & ~self.forcing:
                    found.add((column, MASKED))
        return found

    def _row(self, column: int) -> int:
        return (column - 1) % len(self.forward)


@dataclass(frozen=True)
class Pulses(Decoder):
    """A drive: a rising edge of the pulse is a step, by the direction that stood before it and stands through it."""

    pulse: int
    direction: int
    forward_high: bool

    def recount(self, words: Sequence[int], watch: Watch) -> Recount:
        found = Recount([], [])
        columns, last = 0, 0
        for tick, word in enumerate(words):
            high, was_high = bool(word & self.pulse), bool(last & self.pulse)
            turned = bool((word ^ last) & self.direction)
            if high and turned:
                raise DecodeError(tick, self.axis, word, "the direction changes at or in a pulse")
            if high and not was_high:
                forward = bool(word & self.direction) == self.forward_high
                columns += self.columns_per_step * self.sense * (1 if forward else -1)
            last = word
            found.least.append(columns)
            found.most.append(columns)
        return found


def decoders(machine_file: Path, tables: Path) -> list[Decoder]:
    """One decoder an axis, from a machine's file and the folder that holds ``phase/``."""
    machine = tomllib.loads(machine_file.read_text("utf-8"))
    return [_decoder(axis, machine["wiring"], tables) for axis in machine["axis"]]


def _decoder(axis: dict[str, Any], wiring: dict[str, int], tables: Path) -> Decoder:
    table = tomllib.loads((tables / "phase" / f"{axis['phase']}.toml").read_text("utf-8"))
    prefix = f"{axis['name']}."
    bits = {name.removeprefix(prefix): 1 << bit for name, bit in wiring.items() if name.startswith(prefix)}
    common = (axis["name"], axis["columns_per_step"], -1 if axis.get("invert") else 1)
    if "direction" in table:
        (pulse,) = table["wire"]
        direction = table["direction"]
        return Pulses(*common, bits[pulse["name"]], bits[direction["name"]], direction.get("forward", "x") == "x")
    normal_volts = min(row["volts"] for row in table["wire"])
    forcing = sum(bits[row["name"]] for row in table["wire"] if row["volts"] > normal_volts)
    forward = _columns(table["wire"], bits)
    backward = _columns(table["reverse"], bits) if "reverse" in table else forward
    return Windings(*common, forward, backward, sum(bits.values()), forcing)


def _columns(rows: list[dict[str, Any]], bits: dict[str, int]) -> list[int]:
    length = len(rows[0]["pattern"])
    return [sum(bits[row["name"]] for row in rows if row["pattern"][column] == "x") for column in range(length)]
