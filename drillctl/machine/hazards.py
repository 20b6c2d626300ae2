"""Tables that are valid but dangerous: they are loaded with a warning, since trying that in simulation is what the
laboratory is for.

Rule: never raises; names columns, counted from 1 as the paper does; rows for motion backwards are checked as well.
"""

from collections.abc import Iterator
from itertools import compress

from drillctl.language import Counted, Message
from drillctl.machine.motor import Motor
from drillctl.machine.phase import PhaseTable


def phase_hazards(table: PhaseTable, motor: Motor) -> list[Message]:
    """Returns a sentence for each hazard of a phase table on a motor; none for a sound table or a pulse drive."""
    if motor.pulse:
        return []
    forward = _patterns(table, [wire.forward for wire in table.wires])
    backward = _patterns(table, [wire.backward for wire in table.wires])
    own = _dangers(table, motor, backward) if backward != forward else ()
    backwards = (Message("backwards, {danger}", danger=danger) for danger in own)
    return [*_dangers(table, motor, forward), *_wrong_length(table, motor), *backwards]


def _patterns(table: PhaseTable, rows: list[tuple[bool, ...]]) -> list[frozenset[str]]:
    """Returns the wires that are on, column by column."""
    names = table.wire_names()
    return [frozenset(compress(names, column)) for column in zip(*rows, strict=True)]


def _dangers(table: PhaseTable, motor: Motor, patterns: list[frozenset[str]]) -> list[Message]:
    """Returns the hazards of the columns in one direction of motion; a jump is as long in either direction."""
    return [*_both_halves(motor, patterns), *_forcing_alone(table, patterns), *_bad_jumps(motor, patterns)]


def opposite_halves(motor: Motor) -> list[tuple[str, str]]:
    """Returns, for each winding that has two halves, the wires of both: they pull against each other."""
    angles = {angle % 360: name for name, angle in motor.windings}
    return [(name, angles[angle + 180]) for angle, name in angles.items() if angle + 180 in angles]


def _both_halves(motor: Motor, patterns: list[frozenset[str]]) -> Iterator[Message]:
    for number, on in enumerate(patterns, start=1):
        for pair in opposite_halves(motor):
            if on.issuperset(pair):
                halves = " and ".join(sorted(pair))
                yield Message(
                    "column {number}: {wires} are both on: the halves of one winding cancel",
                    number=number,
                    wires=halves,
                )


def _forcing_alone(table: PhaseTable, patterns: list[frozenset[str]]) -> Iterator[Message]:
    """Yields the columns in which forcing is on without its phase. A forcing wire such as ``24a`` belongs to the
    windings whose names end alike: ``1a``, ``2a``.
    """
    forcing = {wire.name for wire in table.wires if wire.forcing}
    for number, on in enumerate(patterns, start=1):
        if (on & forcing) and not (on - forcing):
            yield Message("column {number}: forcing is on while no phase is", number=number)


def _bad_jumps(motor: Motor, patterns: list[frozenset[str]]) -> Iterator[Message]:
    angles = [motor.equilibrium_degrees(on) for on in patterns]
    for index, angle in enumerate(angles):
        number = index + 1
        if angle is None:
            yield Message("column {number}: nothing pulls the rotor", number=number)
            continue
        following = angles[(index + 1) % len(angles)]
        if following is not None and abs((following - angle + 180) % 360 - 180) == 180:
            yield Message(
                "column {number}: half a cycle to the next column; the rotor may go either way", number=number
            )


def _wrong_length(table: PhaseTable, motor: Motor) -> Iterator[Message]:
    if table.columns % motor.columns_per_cycle:
        yield (
            Counted(
                "{count} column where the motor's cycle has {cycle}: distances will not be what the scale says",
                "{count} columns where the motor's cycle has {cycle}: distances will not be what the scale says",
                table.columns,
                cycle=motor.columns_per_cycle,
            )
        )
