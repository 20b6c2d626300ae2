"""Number formats by the names that people know, the paper's four first, and the texts typed into the Files dialogs.

What the formats stand for: docs/DRILL-FILES.md. EXCELLON *adding zero* leaves trailing zeros out, so that they are to
be added; the *ASCII drill format* is written at full width.

Rule: a text that can't be read is a ValueError with a sentence for the operator; whether the board can be drilled so is
not asked here.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeVar

from drillctl.language import Message, message_of
from drillctl.language.words import N_, _
from drillctl.ui.widgets.dialogs import Accept, Answered
from drillctl.viewmodel.job_options import PanelOf, PinsOf


class Format(NamedTuple):
    """A name, its hot letter marked by ``&``, and the option it stands for; an empty one: recognised."""

    name: str
    option: str


RECOGNISED = Format(N_("&Recognised"), "")
FORMATS = (
    RECOGNISED,
    Format(N_("&ASCII drill format"), "inch,2:4,none"),
    Format(N_("EXCELLON &decimal"), "inch,decimal"),
    Format(N_("EXCELLON adding &zero"), "inch,2:4,trailing"),
    Format(N_("EXCELLON &metric"), "mm,3:3,trailing"),
    Format(N_("EXCELLON, &leading zeros left out"), "inch,2:4,leading"),
    Format(N_("EXCELLON metric, leading zeros le&ft out"), "mm,3:3,leading"),
    Format(N_("EXCELLON metric, de&cimal"), "mm,decimal"),
    Format(N_("EXCELLON metric, f&ull width"), "mm,4:2,none"),
)
BY_OPTION = {entry.option: entry for entry in FORMATS}


Read = TypeVar("Read")


def accepted(read: Callable[[Sequence[str]], Read], then: Callable[[Read, Answered], object]) -> Accept:
    """What a form calls with its texts: what can't be read is its problem, else what ``then`` answers."""

    def accept(texts: list[str], answered: Answered) -> None:
        try:
            made = read(texts)
        except ValueError as error:
            answered((message_of(error),))
            return
        then(made, answered)

    return accept


def panel_of(texts: Sequence[str]) -> PanelOf | None:
    """A panel from columns, rows, pitch in X and in Y as typed; None for a panel of one board."""
    columns, rows = (_count(text) for text in texts[:2])
    pitch_x_mm, pitch_y_mm = (length_mm(text) or 0.0 for text in texts[2:])
    return None if columns == rows == 1 else PanelOf(columns, rows, pitch_x_mm, pitch_y_mm)


def pins_of(text: str) -> PinsOf | None:
    """Pins as ``--pins`` takes them; None where nothing is typed."""
    return PinsOf.typed(text) if text.strip() else None


def is_yes(text: str) -> bool:
    """Whether a yes is typed, in the operator's language or in English, or a part of it; nothing typed is a no."""
    word = text.strip().lower()
    if not any(yes.startswith(word) for yes in (_("yes"), "yes")):
        raise ValueError(Message("{text!r} is neither yes nor empty", text=text))
    return bool(word)


def length_mm(text: str) -> float | None:
    """A length typed with a point or a comma; None where nothing is typed."""
    if not text.strip():
        return None
    try:
        value_mm = float(text.replace(",", "."))
    except ValueError:
        value_mm = math.nan
    if not math.isfinite(value_mm):
        raise ValueError(Message("{text!r} is not a length in mm, such as 0.5", text=text))
    return value_mm


def tool_numbers(text: str) -> tuple[int, ...]:
    """The numbers in a text such as ``2 T3,4``; none where nothing is typed."""
    words = text.replace(",", " ").upper().split()
    numbers = [word.removeprefix("T") for word in words]
    if not all(number.isdecimal() for number in numbers):
        raise ValueError(Message("{text!r} is not a list of tools, such as 2 3", text=text))
    return tuple(sorted({int(number) for number in numbers}))


def _count(text: str) -> int:
    if not text.strip().isdecimal():
        raise ValueError(Message("{text!r} is not a number of boards, such as 2", text=text))
    return int(text)
