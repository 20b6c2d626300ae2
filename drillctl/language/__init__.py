"""Words on their way to a person. Rule: nothing here knows what the words are about.

visible.py    characters that a terminal would obey, or not show at all, as escapes
nearest.py    the word that was probably meant
words.py      the operator's language: catalogues
sentences.py  sentences of other rooms, translated
figures.py    durations, numbers, millimetres
"""

from drillctl.language.nearest import known_words, nearest
from drillctl.language.visible import LINES, json_text, masked, one_line, visible

__all__ = ["LINES", "json_text", "known_words", "masked", "nearest", "one_line", "visible"]
