"""Jogging by a key: a press is a step, one further step waits, and a key held down is one move until it is let go.

A terminal tells of presses and never of a key let go. Presses that follow each other faster than a finger can come from
a key that is held down; when they stop coming, it was let go, and so it was if the line to the terminal broke.
Rule: Jogging knows keys and time alone; what moves and what stops is handed in.
"""

from collections.abc import Callable

import numpy as np

from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.viewmodel.console import Problems

REPEAT_S = 0.09  # terminals repeat a key 20 to 40 times a second, fingers less than 10
HELD_PRESSES = 3
SILENT_S = 0.2  # a repeat may be late by as much where the computer is busy

TOO_FAR = Message("the axis can't go so far: its reach ends before")

Step = tuple[str, int]  # axis, signed steps


class Jogging:
    """Turns key presses into moves.

    move  moves an axis by so many steps; stop: brakes it
    way   signed steps left to the end of an axis's reach in the direction of a step; None where the position is unknown
    under_way   a move that a key began is on its way
    """

    def __init__(self, move: Callable[[str, int], Problems], stop: Callable[[], object],
                 way: Callable[[str, int], int | None]):  # fmt: skip
        self._move, self._stop, self._way = move, stop, way
        self._key: Step | None = None
        self._pressed_s, self._presses = 0.0, 0
        self._further: Step | None = None
        self.under_way = self._running = False

    def press(self, step: Step, busy: bool, now_s: float) -> Problems:
        """Takes a key press, or a repeat of one; ``busy`` while a move is on its way."""
        together = step == self._key and now_s - self._pressed_s <= REPEAT_S
        self._presses = self._presses + 1 if together else 1
        self._key, self._pressed_s = step, now_s
        if not (self._running and together):
            self._further = step
        return self.carry_on(busy, now_s)

    def carry_on(self, busy: bool, now_s: float) -> Problems:
        """Ends the move of a key that was let go; begins the step that waits."""
        if busy:
            if self._running and not self._held(now_s):
                self._running = False
                self._stop()
            return ()
        self.under_way = self._running = False
        step, self._further = self._further, None
        return self._begin(*step, self._held(now_s)) if step else ()

    def forget(self) -> None:
        """Forgets the step that waits and the key that is held, because something else was asked for."""
        self._further = self._key = None

    def _begin(self, axis: str, steps: int, held: bool) -> Problems:
        way = self._way(axis, steps)
        if way is not None and abs(way) < abs(steps):
            return (TOO_FAR,)
        self._running = held and way is not None
        problems = self._move(axis, way if self._running and way is not None else steps)
        self.under_way = not problems
        return problems

    def _held(self, now_s: float) -> bool:
        return self._key is not None and self._presses >= HELD_PRESSES and now_s - self._pressed_s < SILENT_S


def way_left(machine: Machine, status: np.void, axis: str, steps: int) -> int | None:
    """Signed steps from here to the end of an axis's reach in the direction of ``steps``, 0 where it stands beyond;
    None while the position is not known.
    """
    index = machine.axis_index(axis)
    if index is None or not status["position_known"]:
        return None
    low, high = machine.reach(index)
    position = int(status["position"][index])
    return max(0, high - position) if steps > 0 else min(0, low - position)
