"""What carriages act on beside their sensors: the table ``EFFECTS`` names each thing and says how a machine gets it."""

from collections.abc import Callable, Mapping
from functools import partial
from math import inf
from typing import Protocol

from drillctl.machine import Machine
from drillctl.machine.head_lines import CONTACT, head_input
from drillctl.plant.carriage import Line
from drillctl.plant.chucks import Chuck, Chucks


class Effect(Protocol):
    """A thing that one axis acts on.

    axis    the axis whose carriage acts on it
    state   all that it remembers of the past
    line    the input that is on while ``state`` is
    """

    axis: int
    state: bool
    line: Line

    def moved_to(self, steps: float) -> bool:
        """Takes the carriage's place, in steps; returns whether the bit met the work in this move, coming down."""

    def changes_at(self) -> tuple[float, float]:
        """Returns the places between which (neither included) nothing about it changes."""


class Board:
    """The board under a head; ``state`` is whether the bit is in it. Without a bit in its ``chuck`` it never is; a
    broken one is shorter, and makes no hole.
    """

    def __init__(self, axis: int, surface: int, chuck: Chuck | None = None, line: Line | None = None):
        self.axis, self.surface = axis, surface
        self.state = False
        self.line = line or Line()
        self._chuck = chuck

    def moved_to(self, steps: float) -> bool:
        """Returns whether the bit has come down to the board and begins a hole."""
        chuck = self._chuck
        if chuck is None:
            before, self.state = self.state, steps >= self.surface
            return self.state and not before
        before, self.state = self.state, chuck.held and steps >= self.surface + chuck.short_steps
        begun = self.state and not before and chuck.whole
        if begun:
            chuck.begin_hole()
        return begun

    def changes_at(self) -> tuple[float, float]:
        """Returns the places between which the bit neither meets nor leaves the board."""
        if self._chuck is not None and not self._chuck.held:
            return -inf, inf
        meets = self.surface + (self._chuck.short_steps if self._chuck else 0.0)
        return (meets, inf) if self.state else (-inf, meets)


def _board(machine: Machine, chucks: Chucks, number: int) -> Board | None:
    """Returns the board under a head, by its number from 1."""
    if number > len(machine.drill_axes):
        return None
    head = machine.drill_axes[number - 1]
    surface = machine.board_surface[head]
    if surface is None:
        return None
    return Board(head, surface, chucks.of(head), Line.of(head_input(machine, CONTACT, head)))


MOST_HEADS = 8
EFFECTS: Mapping[str, Callable[[Machine, Chucks], Effect | None]] = {
    "board": partial(_board, number=1),
    **{f"board {number}": partial(_board, number=number) for number in range(2, MOST_HEADS + 1)},
}


def effects_of(machine: Machine, chucks: Chucks) -> dict[str, Effect]:
    """Returns the effects that a machine has, by name, each in its state before anything moved."""
    made = {name: make(machine, chucks) for name, make in EFFECTS.items()}
    return {name: effect for name, effect in made.items() if effect is not None}
