"""What each fault of the dynamic plant does, in words and drawn: the machine as it should be, then with the fault.

Rule: a row of EFFECTS for each fault that there is, by the word before its ``.`` or ``=``. A drawing is of the kind of
fault, not of a number: its length stands for no time and no way.
"""

from collections.abc import Mapping
from typing import NamedTuple

from drillctl.language.words import N_, _
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.text_graphics import LEVELS, PLAIN_LEVELS
from drillctl.ui.widgets.texts import Line

LABEL_COLUMNS = 14
WAVES = str.maketrans("_-", "▁▔")
PLANTS_IN_WORDS = (
    N_("What stands behind the simulated machine. Ideal motors turn at once"),
    N_("to where their windings pull; dynamic ones have inertia, friction:"),
    N_("they lag, swing, and lose steps when they are driven too fast."),
    N_("F6 offers both plants. Enter asks for the faults of the"),
    N_("dynamic one, several with a space between, and for its seed:"),
    N_("the same faults and seed give the same run again."),
    N_("A fault has one number N; the list says its range and its meaning."),
    N_("> is the fault explained: ▁ (_) off, ▔ (-) on, other bars: the way."),
    N_("The machine starts anew: initialise it, and open the board again."),
    N_("Lost steps stand after Lost on the machine's first screen."),
)  # what F1 says of the screen


class Effect(NamedTuple):
    """``cause``: what is wrong with the machine. ``seen``: what comes of it. ``drawn``: labels, and behind each a wave
    of ``_`` (off) and ``-`` (on), or a curve of levels from 0 to 8.
    """

    cause: str
    seen: str
    drawn: tuple[tuple[str, str], ...]


WHOLE, COUNTED, ROTOR = N_("as it should"), N_("counted"), N_("rotor")
EFFECTS: Mapping[str, Effect] = {
    "stuck": Effect(
        N_("Wire broken (0) or shorted (1): the answer is always the same."),
        N_("Homing ends in HOMING_NOT_FOUND; Z's lower sensor: DRILL_NOT_DOWN."),
        ((WHOLE, "________----------------____"), ("N=0", "____________________________"),
         ("N=1", "----------------------------")),
    ),
    "dirty": Effect(
        N_("Dust: the sensor answers N mm later than it should; -N: earlier."),
        N_("Machine zero is N mm off, and every hole with it. Nothing is reported."),
        ((WHOLE, "________--------------------"), ("N", "______________--------------")),
    ),
    "bouncing": Effect(
        N_("A bad contact: after a change the wire goes on and off for N ticks."),
        N_("A few ticks do no harm; many end in HOMING_NOT_FOUND."),
        ((WHOLE, "________--------------------"), ("N", "________-_-_--_-------------")),
    ),
    "loose": Effect(
        N_("Play of N mm: after a turn back the carriage follows the motor late."),
        N_("Holes are up to N mm off, by the side of approach. Nothing is reported."),
        ((N_("motor"), "0123456788765432101234567887"), (N_("carriage"), "0001234566666543211112345666")),
    ),
    "jammed": Effect(
        N_("The guide rubs N times as hard: the motor lags more and loses steps."),
        N_("Lost shows them. HOMING_NOT_FOUND or DRILL_NOT_DOWN follows."),
        ((COUNTED, "0001122334455667788888888888"), (ROTOR, "0001122223322332233222222222")),
    ),
    "blunt": Effect(
        N_("The bit is worn as after N metres of board: Z's motor stalls in it."),
        N_("Z loses steps, its lower sensor never answers: DRILL_NOT_DOWN."),
        ((COUNTED, "0001122334455667788888888888"), (ROTOR, "0001122334434434434433333333")),
    ),
    "worn": Effect(
        N_("The bit of this head is worn as after N metres; blunt wears all bits."),
        N_("It needs more thrust: its head lags, or the bit breaks in its hole."),
        ((N_("head"), "0024688642000246886420002468"), (N_("in the board"), "1111888111111111111111111111")),
    ),
    "broken": Effect(
        N_("The bit has broken off: the head goes down and touches no board."),
        N_("Holes count as drilled and none is made. Nothing is reported."),
        ((N_("head"), "0024688642000246886420002468"), (N_("in the board"), "1111111111111111111111111111")),
    ),
    "breaks": Effect(
        N_("The bit of this head breaks as it begins its N-th hole."),
        N_("From then on it touches 3 mm deeper, and makes no more holes."),
        ((N_("head"), "0024688642000246886420002468"), (N_("in the board"), "1111888111111111111111111111")),
    ),
    "missing": Effect(
        N_("Place N of the magazine holds no bit for this spindle."),
        N_("Its tool sensor stays off after the chuck has closed there."),
        ((N_("chuck open"), "______--------______________"), (N_("tool in it"), "____________________________")),
    ),
    "dropped": Effect(
        N_("The N-th bit that the chuck of this head takes falls out again."),
        N_("Its tool sensor is on, and goes off as the head rises."),
        ((N_("chuck open"), "______--------______________"), (N_("tool in it"), "______________-----_________")),
    ),
}  # fmt: skip


def effect_of(usage: str) -> Effect | None:
    """The effect of a fault by how it is written, ``loose.AXIS=N``; None for one without a row."""
    return EFFECTS.get(usage.partition("=")[0].partition(".")[0])


def effect_words(usage: str, columns: int) -> list[Line]:
    """What a fault is and what comes of it, in as many lines as so many columns ask for."""
    effect = effect_of(usage)
    return folded([[_(effect.cause)], [("warning", _(effect.seen))]], columns) if effect else []


def effect_lines(usage: str, columns: int, plain: bool) -> list[Line]:
    """The words, and below them the drawing."""
    effect = effect_of(usage)
    drawn: list[Line] = [
        [("dark", f"{_(label):{LABEL_COLUMNS}}"), ("lit" if row == 0 else "warning", _row(marks, columns, plain))]
        for row, (label, marks) in enumerate(effect.drawn if effect else ())
    ]
    return [*effect_words(usage, columns), *drawn]


def _row(marks: str, columns: int, plain: bool) -> str:
    """A wave or a curve in the characters of the terminal, as many for each mark as there is room for."""
    marks = "".join(mark * max((columns - LABEL_COLUMNS) // len(marks), 1) for mark in marks)
    if marks.isdecimal():
        return "".join((PLAIN_LEVELS if plain else LEVELS)[int(level)] for level in marks)
    return marks if plain else marks.translate(WAVES)
