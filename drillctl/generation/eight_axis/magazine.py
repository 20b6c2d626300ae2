"""What is known of the tools of a machine: which one each chuck holds, what stands in the magazine, hits made.

Rule: nothing is guessed. A place holds one bit for each spindle; each is there, is not, or is *unknown* (None), as
after a transfer that was begun and not confirmed. A record changes by its events alone, and every event is one line of
the file (jobs/magazine_file.py).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from drillctl.machine import Machine

EMPTY = 0  # in a chuck
LEAVE, TAKE = "leave", "take"
Bit = tuple[int, int]  # number of the place, number of the spindle


@dataclass(frozen=True)
class Transfer:
    """A tool on its way between chucks and its place: ``kind`` is LEAVE or TAKE."""

    kind: str
    tool: int
    place: int
    spindles: tuple[int, ...]


@dataclass(frozen=True)
class Magazine:
    """The record.

    chucks   by spindle: the tool in it, EMPTY, or None where that is unknown
    bits     by place and spindle: whether a bit stands there, None where that is unknown
    hits     by tool: holes made since the parameter ``hits_left`` was entered, or since it was renewed
    renewed  tools whose bits were replaced by new ones
    """

    chucks: Mapping[int, int | None]
    bits: Mapping[Bit, bool | None]
    hits: Mapping[int, int] = field(default_factory=dict)
    renewed: frozenset[int] = frozenset()

    def with_bits(self, place: int, spindles: Iterable[int], there: bool | None) -> "Magazine":
        """The record once this is known of a place."""
        return replace(self, bits={**self.bits, **{(place, spindle): there for spindle in spindles}})

    def with_chucks(self, spindles: Iterable[int], tool: int | None) -> "Magazine":
        """The record once this is known of chucks."""
        return replace(self, chucks={**self.chucks, **dict.fromkeys(spindles, tool)})

    def begun(self, transfer: Transfer) -> "Magazine":
        """The record while a transfer is under way: chucks and place are unknown."""
        return self.with_bits(transfer.place, transfer.spindles, None).with_chucks(transfer.spindles, None)

    def ended(self, transfer: Transfer) -> "Magazine":
        """The record after the sensors have confirmed a transfer."""
        left = transfer.kind == LEAVE
        known = self.with_bits(transfer.place, transfer.spindles, left)
        return known.with_chucks(transfer.spindles, EMPTY if left else transfer.tool)

    def moved(self, machine: Machine, old: int, new: int, spindles: Iterable[int]) -> "Magazine":
        """The record after these spindles have left the tool ``old`` and taken ``new``, EMPTY for none."""
        made, chosen = self, tuple(spindles)
        for kind, tool in ((LEAVE, old), (TAKE, new)):
            if tool != EMPTY:
                made = made.ended(Transfer(kind, tool, place_of(machine, tool), chosen))
        return made

    def hit(self, tool: int, holes: int) -> "Magazine":
        """The record after a tool has made so many holes more."""
        return replace(self, hits={**self.hits, tool: self.hits.get(tool, 0) + holes})

    def renew(self, tool: int) -> "Magazine":
        """The record after an operator has put new bits in for a tool."""
        return replace(self, hits={**self.hits, tool: 0}, renewed=self.renewed | {tool})

    def broken(self, tool: int) -> "Magazine":
        """The record after a bit of a tool has broken: it has no life left until it is renewed."""
        return replace(self, hits={**self.hits, tool: BROKEN})

    def hits_left(self, machine: Machine, tool: int) -> int:
        """Returns how many holes a tool is still good for."""
        assert machine.parameters is not None
        row = machine.parameters.tool(tool)
        assert row is not None
        life = row.number("life_hits" if tool in self.renewed else "hits_left") or 0
        return max(0, int(life) - self.hits.get(tool, 0))

    def unknown(self) -> tuple[list[int], list[Bit]]:
        """Returns the spindles whose chucks, and the places of the magazine, that nobody knows."""
        chucks = [spindle for spindle, tool in sorted(self.chucks.items()) if tool is None]
        return chucks, [bit for bit, there in sorted(self.bits.items()) if there is None]


BROKEN = 10**9


def full_magazine(machine: Machine) -> Magazine:
    """Returns the record of a machine whose chucks are empty and whose tools stand in their places."""
    assert machine.parameters is not None
    spindles = range(1, len(machine.drill_axes) + 1)
    places = {int(row.number("place") or 0) for row in machine.parameters.places}
    used = {place_of(machine, int(row.number("number") or 0)) for row in machine.parameters.tools}
    bits = {(place, spindle): place in used for place in sorted(places) for spindle in spindles}
    return Magazine(dict.fromkeys(spindles, EMPTY), bits)


def place_of(machine: Machine, tool: int) -> int:
    """Returns the place of the magazine where a tool is kept; 0 for none."""
    assert machine.parameters is not None
    row = machine.parameters.tool(tool)
    return int((row.number("magazine_place") if row else None) or 0)
