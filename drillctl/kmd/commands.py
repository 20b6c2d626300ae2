"""The KMD commands, defined once: docs/KMD.md, the text form and the opcodes all come from ``COMMANDS``.

Rule: a command is one fixed-size record of integers; an array of records is a *program*. The paper names KMD_GOTOdXdY,
KMD_GOTO_X_Y and KMD_WIERTLO_DOL; the others are ours, in its style.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum, IntFlag

import numpy as np

from drillctl.language import Message

MOST_AXES = 10  # eight that work, and room for those of a magazine
MOST_ARGUMENT = 2**31 - 1

# The wire form: 60 bytes, little-endian, whatever machine reads it.
RECORD = np.dtype(
    [
        ("sequence", "<u4"),  # counts up from 1 within a program
        ("epoch", "<u4"),  # raised by stop, emergency stop and fault: older commands are discarded
        ("opcode", "u1"),
        ("flags", "u1"),
        ("axes", "<u2"),  # mask: bit i = axis i of the machine's file
        ("floor_ticks", "<i4"),  # slowest allowed interval between steps, 0 = none
        ("tag", "<i4"),  # the hole's number in the job, from 1; 0 = none
        ("args", "<i4", (MOST_AXES,)),  # by axis: a move's way, a head's own floor; else as the command's form says
    ]
)


class Op(IntEnum):
    """Opcodes; 0 is no command."""

    IDLE = 0
    GOTO_DXDY = 1
    GOTO_X_Y = 2
    WIERTLO_DOL = 3
    WIERTLO_GORA = 4
    INICJALIZACJA = 5
    BAZA = 6
    RUCH = 7
    RUCH_D = 8
    LINIA = 9
    LINIA_D = 10
    PREDKOSC = 11
    CZEKAJ = 12
    WYJSCIE = 13
    CZEKAJ_WE = 14
    WRZECIONO = 15
    NARZEDZIE = 16
    FAZY_WYL = 17
    KONIEC = 18
    POWROT = 19
    GORA_X_Y = 20
    KROK = 21
    WIERTLO_DOM = 22
    SUW = 23
    DOTYK = 24


class Flag(IntFlag):
    """How a move's arguments are meant."""

    NONE = 0
    ABSOLUTE = 1  # from the working base; else from here
    LINKED = 2  # all axes along one straight line


class ArgumentForm(IntEnum):
    """Which arguments follow a command's name in the text form."""

    NOTHING = 0
    XY = 1  # two integers, for the axes x and y
    MOVES = 2  # axis=integer, one or more
    AXES = 3  # axis names, none = the command's own choice
    NUMBER = 4  # one integer
    OUTPUT = 5  # output name, 0|1
    INPUT = 6  # input name, 0|1, timeout in ticks
    HEADS = 7  # axis or axis=ticks: heads, each with its own least interval; none = all heads of the machine
    XY_HEADS = 8  # as XY, then as HEADS


# The forms of commands that move axes, and so carry the feed (KMD_PREDKOSC).
MOVING = frozenset((ArgumentForm.XY, ArgumentForm.MOVES, ArgumentForm.HEADS, ArgumentForm.XY_HEADS))


@dataclass(frozen=True, slots=True)
class Spec:
    """One command: name, opcode, form of its arguments, how they are written, what it does (a screen translates both),
    flags, least number allowed.
    """

    name: str
    op: Op
    form: ArgumentForm
    usage: str
    meaning: Message
    flags: Flag = Flag.NONE
    least: int = 0


_BASE = Flag.ABSOLUTE
_LINE = Flag.LINKED
_AXES, _PLACES = Message("[axis ...]"), Message("axis=steps ...")
_HEADS = Message("[axis[=ticks] ...]")
_TICKS, _NOTHING = Message("ticks"), ""
_ALL = (
    Spec("KMD_GOTOdXdY", Op.GOTO_DXDY, ArgumentForm.XY, "dX dY", Message("move X and Y by so many steps from here")),
    Spec(
        "KMD_GOTO_X_Y", Op.GOTO_X_Y, ArgumentForm.XY, "X Y",
        Message("move X and Y to a place, in steps from the working base"), _BASE,
    ),
    Spec("KMD_WIERTLO_DOL", Op.WIERTLO_DOL, ArgumentForm.HEADS, _HEADS, Message("lower the head to its lower sensor")),
    Spec(
        "KMD_WIERTLO_GORA", Op.WIERTLO_GORA, ArgumentForm.HEADS, _HEADS, Message("raise the head to its upper sensor")
    ),
    Spec(
        "KMD_INICJALIZACJA", Op.INICJALIZACJA, ArgumentForm.NOTHING, _NOTHING,
        Message("head up, then to X=0, Y=0 as the limit sensors set it; the position is known from here on"),
    ),
    Spec(
        "KMD_BAZA", Op.BAZA, ArgumentForm.AXES, _AXES,
        Message("take this place as working base, in X and Y or the axes named"),
    ),
    Spec(
        "KMD_RUCH", Op.RUCH, ArgumentForm.MOVES, _PLACES,
        Message("move the named axes to a place, in steps from the working base"), _BASE,
    ),
    Spec(
        "KMD_RUCHd", Op.RUCH_D, ArgumentForm.MOVES, _PLACES, Message("move the named axes by so many steps from here")
    ),
    Spec(
        "KMD_LINIA", Op.LINIA, ArgumentForm.MOVES, _PLACES, Message("as KMD_RUCH, along one straight line"),
        _BASE | _LINE,
    ),
    Spec(
        "KMD_LINIAd", Op.LINIA_D, ArgumentForm.MOVES, _PLACES, Message("as KMD_RUCHd, along one straight line"), _LINE
    ),
    Spec(
        "KMD_PREDKOSC", Op.PREDKOSC, ArgumentForm.NUMBER, _TICKS,
        Message("limit the feed: later moves wait at least so many ticks between two steps; 0: no limit"),
    ),
    Spec("KMD_CZEKAJ", Op.CZEKAJ, ArgumentForm.NUMBER, _TICKS, Message("wait so many ticks")),
    Spec("KMD_WYJSCIE", Op.WYJSCIE, ArgumentForm.OUTPUT, Message("output 0|1"), Message("switch an output on or off")),
    Spec(
        "KMD_CZEKAJ_WE", Op.CZEKAJ_WE, ArgumentForm.INPUT, Message("input 0|1 timeout"),
        Message("wait until a sensor is reached (1) or clear (0), at most so many ticks"),
    ),
    Spec(
        "KMD_WRZECIONO", Op.WRZECIONO, ArgumentForm.NUMBER, Message("rpm"),
        Message("switch the spindle on, at so many turns a minute, and wait for them where they are measured; 0: off"),
    ),
    Spec(
        "KMD_NARZEDZIE", Op.NARZEDZIE, ArgumentForm.NUMBER, Message("number"),
        Message("note which tool is in the spindle, by its number"),
    ),
    Spec(
        "KMD_FAZY_WYL", Op.FAZY_WYL, ArgumentForm.AXES, _AXES,
        Message("switch the phases of all axes, or of those named, off: the position is lost"),
    ),
    Spec("KMD_KONIEC", Op.KONIEC, ArgumentForm.NOTHING, _NOTHING, Message("the end of the queue")),
    Spec(
        "KMD_POWROT", Op.POWROT, ArgumentForm.NOTHING, _NOTHING,
        Message("return to zero by the count of steps: the heads first, then all other axes"),
    ),
    Spec(
        "KMD_GORA_X_Y", Op.GORA_X_Y, ArgumentForm.XY_HEADS, Message("X Y [axis[=ticks] ...]"),
        Message("raise the heads; once all of them are clear of the board, X and Y start to a place, in steps from "
                "the working base"), _BASE,
    ),
    Spec(
        "KMD_KROK", Op.KROK, ArgumentForm.NUMBER, Message("step"),
        Message("begin this step of the machine's tool change, whose time limit and fault hold from here on; 0: none"),
    ),
    Spec(
        "KMD_WIERTLO_DOM", Op.WIERTLO_DOM, ArgumentForm.AXES, _AXES,
        Message("raise the head until its upper sensor answers, even where its place is known"),
    ),
    Spec(
        "KMD_SUW", Op.SUW, ArgumentForm.MOVES, _PLACES,
        Message("set how far KMD_WIERTLO_GORA raises these heads, in steps from machine zero, until the next "
                "initialisation or stop"),
    ),
    Spec(
        "KMD_DOTYK", Op.DOTYK, ArgumentForm.HEADS, _HEADS,
        Message("lower the heads slowly until their bits touch the board; one that touches too deep is broken"),
    ),
)  # fmt: skip

COMMANDS: Mapping[str, Spec] = {spec.name: spec for spec in _ALL}
BY_OP: Mapping[Op, Spec] = {spec.op: spec for spec in _ALL}


@dataclass(frozen=True)
class Names:
    """The names that a machine gives to axes (by index), outputs and inputs (by bit); ``heads`` are the axes that
    drill, none where that is not known.
    """

    axes: tuple[str, ...]
    outputs: Mapping[str, int] = field(default_factory=dict)
    inputs: Mapping[str, int] = field(default_factory=dict)
    heads: tuple[str, ...] = ()


class Command:
    """One record unpacked. Allocated once: ``load`` overwrites it in place."""

    __slots__ = ("args", "axes", "epoch", "flags", "floor_ticks", "opcode", "sequence", "tag")

    def __init__(self) -> None:
        self.sequence = self.epoch = self.opcode = self.flags = self.axes = self.floor_ticks = self.tag = 0
        self.args = [0] * MOST_AXES

    def load(self, record: np.void) -> None:
        """Overwrites this command with a record of dtype RECORD."""
        row = record.item()
        self.sequence, self.epoch, self.opcode, self.flags, self.axes, self.floor_ticks, self.tag = row[:7]
        self.args[:] = record["args"].tolist()
