"""The keys: one table for the frame and one for each screen. A key's row names the method that it calls.

Rule: what these tables say is all that there is: the key line, the help and the dispatch are made from them, so a
key that the help tells of works, and one that works is told of. Screens have their table as ``keys``.
"""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from drillctl.language.words import N_, _


class Key(NamedTuple):
    """A row: urwid's names of the keys, how they are printed, the method called, what it does, and that in a word.

    A key without a ``short`` word stands in the help only. ``argument`` is handed to the method where it is not None.
    """

    names: tuple[str, ...]
    printed: str
    method: str
    help: str
    short: str = ""
    argument: str | int | None = None


# Live everywhere, in dialogs, menus and fields too: looked at before anything else. F10 always; the key that can also
# be typed is a character only in a text field, while nothing moves.
TYPED_STOP = "!"
EMERGENCY = Key(
    ("f10", TYPED_STOP), "F10 !", "emergency_stop",
    N_("emergency stop, always; ! is typed in fields at rest"), N_("E-STOP"),
)  # fmt: skip

# Live everywhere as well, while anything is under way. The letter is a letter in a text field.
STOP_LETTER, STOP_IN_TEXT = "x", "ctrl x"
STOP = Key((STOP_IN_TEXT, STOP_LETTER), "X", "stop", N_("ends the job, always; in a text field: Ctrl-X"), N_("Stop"))

# Looked at before anything else too, so that a dialog can be copied.
COPY = Key(("ctrl g",), "Ctrl-G", "copy_screen", N_("keeps a picture of the screen (SVG) in this folder"))

FRAME_KEYS = (
    EMERGENCY,
    STOP,
    Key(("f1", "?"), "F1 ?", "help", N_("explains the screen and lists its keys"), N_("Help")),
    Key(("f9",), "F9", "menu", N_("the menu; or Alt with a letter of it"), N_("Menu")),
    Key(("esc",), "Esc", "back", N_("closes what is on top"), N_("Back")),
    Key(("q",), "Q", "leave_top", N_("as Esc; on the first screen it ends the program")),
    Key(("ctrl p",), "Ctrl-P", "find_action", N_("finds any action by its words, English or your own")),
    COPY,
    Key(("f4",), "F4", "leave", N_("ends the program; the outputs are made safe"), N_("Quit")),
)


# The same in every editor. Letters are typed in some of them.
UNDO_KEYS = (
    Key(("ctrl u",), "Ctrl-U", "undo", N_("takes the last change back"), N_("Undo")),
    Key(("ctrl r",), "Ctrl-R", "redo", N_("makes it again")),
)
WHEEL = {4: "up", 5: "down"}  # buttons of the mouse, and the key that each of them stands for
CURSOR_METHODS = ("go", "upwards", "downwards", "row")  # of keys that move a cursor and nothing else


def wheel_key(keys: Iterable[Key], button: int) -> str | None:
    """Returns the key that a turn of the wheel stands for where it moves a cursor; None for any other key or button."""
    name = WHEEL.get(button)
    return name if any(name in key.names and key.method in CURSOR_METHODS for key in keys) else None


def called(target: object, keys: Iterable[Key], pressed: str) -> bool:
    """Calls the method of the key that was pressed, if there is such a row.

    A capital without a row of its own is its letter: keys are printed as capitals, and Caps Lock may be on.
    """
    rows = tuple(keys)
    key = _row(rows, pressed) or _row(rows, pressed.lower())
    if key is None:
        return False
    method = getattr(target, key.method)
    method() if key.argument is None else method(key.argument)
    return True


def key_parts(keys: Sequence[Key]) -> list[list[str | tuple[str, str]]]:
    """The keys that have a short word, as marked text for the bottom lines."""
    return [[(_attribute(key), _(key.printed)), f" {_(key.short)}  "] for key in keys if key.short]


def help_lines(keys: Sequence[Key]) -> list[str]:
    """A line of help for each key."""
    return [f"{_(key.printed):<12}{_(key.help)}" for key in keys]


def _row(keys: Sequence[Key], pressed: str) -> Key | None:
    return next((key for key in keys if pressed in key.names), None)


def _attribute(key: Key) -> str:
    return "danger" if key is EMERGENCY else "key"
