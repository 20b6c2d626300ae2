"""A part program as a program of KMD records: this place is zero, then gear and way, sentence by sentence.

Rule: a sentence is one relative move of one axis, whose ``tag`` is the sentence's number from 1. A program that would
leave the travel is refused, sentence by sentence, before there is a queue.
"""

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from drillctl.generation.boiler_drum.gears import GEARS_MM_MIN, LETTERS, MM_PER_M, columns_hz, interval_ticks
from drillctl.generation.boiler_drum.sentence import CARRIAGES, DIRECTIONS
from drillctl.generation.boiler_drum.text import Part
from drillctl.generation.errors import JobError
from drillctl.generation.sequences import Records, numbered, record
from drillctl.kmd import Op
from drillctl.language import Message
from drillctl.machine import Machine

GEAR_TOLERANCE = 0.01  # of a gear's speed; the shipped machine keeps all of them within 0.3 %
COLUMNS_PER_INCH_OF_A_TENTH = 254  # a scale of so many columns an inch has one column to 0.1 mm


class Move(NamedTuple):
    """A sentence on a machine: index of the axis, steps (signed), ticks between steps, place reached (steps)."""

    axis: int
    steps: int
    floor_ticks: int
    place: int


def moves(part: Part, machine: Machine) -> Iterator[Move]:
    """Yields what each sentence does on a machine. Raises JobError for a machine whose steps don't fit the unit."""
    tenths = steps_per_tenth(machine)
    places = dict.fromkeys(tenths, 0)
    for sentence in part.sentences:
        axis = machine.axis_names.index(sentence.axis)
        steps = sentence.signed_tenths * tenths[sentence.axis]
        places[sentence.axis] += steps
        floor_ticks = interval_ticks(sentence.gear, machine.axes[axis], machine.tick_hz)
        yield Move(axis, steps, floor_ticks, places[sentence.axis])


def part_program(part: Part, machine: Machine) -> Records:
    """Returns the program, dtype RECORD. Raises JobError with a line for each sentence that leaves the travel."""
    made = list(moves(part, machine))
    outside = [index for index, move in enumerate(made) if _leaves(move, machine)]
    if outside:
        raise JobError(*(part.at(index, _outside(made[index], machine)) for index in outside))
    records, floor_ticks = [record(Op.INICJALIZACJA)], 0
    for number, move in enumerate(made, start=1):
        if move.floor_ticks != floor_ticks:
            floor_ticks = move.floor_ticks
            records.append(record(Op.PREDKOSC, [floor_ticks]))
        records.append(_move(move, number))
    return numbered([*records, record(Op.KONIEC)])


def tool_in_wall(part: Part, machine: Machine) -> list[Message]:
    """Returns a warning for the first sentence that moves the large carriage while the tool is in the wall."""
    surfaces = machine.board_surface
    places = [0] * len(machine.axes)
    for index, move in enumerate(moves(part, machine)):
        inside = [axis for axis, surface in enumerate(surfaces) if surface is not None and places[axis] > surface]
        if inside and move.axis not in inside:
            depth = (places[inside[0]] - (surfaces[inside[0]] or 0)) / machine.axes[inside[0]].steps_per_mm
            why = Message("the large carriage moves with the tool {depth:.1f} mm in the wall", depth=depth)
            return [part.at(index, why)]
        places[move.axis] = move.place
    return []


def gear_not_kept(part: Part, machine: Machine) -> list[Message]:
    """Returns a warning for the first sentence whose gear the ticks of the machine are too coarse for."""
    for index, (sentence, move) in enumerate(zip(part.sentences, moves(part, machine), strict=True)):
        ratio = float(Fraction(machine.tick_hz, move.floor_ticks) / columns_hz(sentence.gear, machine.axes[move.axis]))
        if abs(ratio - 1) > GEAR_TOLERANCE:
            speed = GEARS_MM_MIN[sentence.gear] / MM_PER_M
            reason = Message(
                "gear {gear} is {speed:g} m/min; at {tick_hz} ticks a second it runs at {found:.3g} m/min",
                gear=LETTERS[sentence.gear], speed=speed, tick_hz=machine.tick_hz, found=speed * ratio,
            )  # fmt: skip
            return [part.at(index, reason)]
    return []


def steps_per_tenth(machine: Machine) -> dict[str, int]:
    """Returns the steps of 0.1 mm by axis name. Raises JobError for a machine that has no such axes, or no whole
    number of steps to 0.1 mm.
    """
    found = {}
    for name in dict.fromkeys(way.axis for way in DIRECTIONS.values()):
        index = machine.axis_index(name)
        if index is None:
            raise JobError(Message("sentences need an axis {axis}", axis=name).at(machine.name))
        axis = machine.axes[index]
        found[name], rest = divmod(axis.columns_per_inch, COLUMNS_PER_INCH_OF_A_TENTH * axis.columns_per_step)
        if rest or not found[name]:
            reason = Message("0.1 mm, the unit of sentences, is no whole number of steps of axis {axis}", axis=name)
            hint = Message("{reason}; they are for --machine boiler-drum", reason=reason)
            raise JobError(hint.at(machine.name))
    return found


def _leaves(move: Move, machine: Machine) -> bool:
    lowest, highest = machine.reach(move.axis)
    return not lowest <= move.place <= highest


def _outside(move: Move, machine: Machine) -> Message:
    axis, (lowest, highest) = machine.axes[move.axis], machine.reach(move.axis)
    return Message(
        "the {carriage} would be at {place:.1f} mm; it goes from {lowest:.1f} to {highest:.1f} mm",
        carriage=CARRIAGES[axis.name],
        place=move.place / axis.steps_per_mm,
        lowest=lowest / axis.steps_per_mm,
        highest=highest / axis.steps_per_mm,
    )


def _move(move: Move, number: int) -> Records:
    made = record(Op.RUCH_D, axes=1 << move.axis)
    made["args"][0, move.axis], made["floor_ticks"], made["tag"] = move.steps, move.floor_ticks, number
    return made
