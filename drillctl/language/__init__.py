"""Words on their way to a person. Rule: nothing here knows what the words are about.

visible.py    characters that a terminal would obey, or not show at all, as escapes
nearest.py    the word that was probably meant
messages.py   a template and its fields, a number's forms; the root of all refusals
words.py      the operator's language: gettext's catalogues, messages translated
number_text.py  durations, numbers and millimetres as people type and read them
"""

from drillctl.language.messages import Counted, Message, Refusal, joined, message_of, verbatim
from drillctl.language.nearest import known_words, nearest
from drillctl.language.visible import LINES, json_text, masked, one_line, visible

__all__ = [
    "LINES",
    "Counted",
    "Message",
    "Refusal",
    "joined",
    "json_text",
    "known_words",
    "masked",
    "message_of",
    "nearest",
    "one_line",
    "verbatim",
    "visible",
]
