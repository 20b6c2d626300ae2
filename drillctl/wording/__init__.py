"""Door: words on their way to a person. Rule: nothing here knows what the words are about, and nothing is imported.

    visible.py  characters that a terminal would obey, or not show at all, as escapes
    nearest.py  the word that was probably meant
"""

from drillctl.wording.nearest import known_words, nearest
from drillctl.wording.visible import LINES, json_text, masked, one_line, visible

__all__ = ["LINES", "json_text", "known_words", "masked", "nearest", "one_line", "visible"]
