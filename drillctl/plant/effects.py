"""What carriages act on beside their sensors: the table ``EFFECTS`` names each thing and says how a machine gets it."""

from collections.abc import Callable, Mapping
from functools import partial
from math import inf
from typing import Protocol

from drillctl.machine import Machine


class Effect(Protocol):
    """A thing that one axis acts on.

    axis    the axis whose carriage acts on it
    state   all that it remembers of the past
    """

    axis: int
    state: bool

    def moved_to(self, steps: float) -> bool:
        """Takes the carriage's place, in steps; returns whether the bit met the work in this move, coming down."""

    def changes_at(self) -> tuple[float, float]:
        """Returns the places between which (neither included) nothing about it changes."""


class Board:
    """The board under a head; ``state`` is whether the bit is in it."""

    def __init__(self, axis: int, surface: int):
        self.axis, self.surface = axis, surface
        self.state = False

    def moved_to(self, steps: float) -> bool:
        """Returns whether the bit has come down to the board."""
        before, self.state = self.state, steps >= self.surface
        return self.state and not before

    def changes_at(self) -> tuple[float, float]:
        """Returns the places between which the bit neither meets nor leaves the board."""
        return (self.surface, inf) if self.state else (-inf, self.surface)


def _board(machine: Machine, number: int) -> Board | None:
    """Returns the board under a head, by its number from 1."""
    if number > len(machine.drill_axes):
        return None
    head = machine.drill_axes[number - 1]
    surface = machine.board_surface[head]
    return None if surface is None else Board(head, surface)


MOST_HEADS = 8
EFFECTS: Mapping[str, Callable[[Machine], Effect | None]] = {
    "board": partial(_board, number=1),
    **{f"board {number}": partial(_board, number=number) for number in range(2, MOST_HEADS + 1)},
}


def effects_of(machine: Machine) -> dict[str, Effect]:
    """Returns the effects that a machine has, by name, each in its state before anything moved."""
    made = {name: make(machine) for name, make in EFFECTS.items()}
    return {name: effect for name, effect in made.items() if effect is not None}
