"""Sentences from below the screen - refusals, warnings, reasons - in the operator's language.

Rule: the rooms below speak English, to people and scripts alike; a sentence of theirs is known by its form, which
stands in the catalogue with named fields (``tool T{number} has no diameter``), and what stands in the fields is put
into the translation, translated itself where it has a form. What has none stays as it is. Used wherever a screen shows
what it was answered.
"""

import re
from collections.abc import Callable
from functools import lru_cache

from drillctl.language.words import spoken_words

FIELD = re.compile(r"\\\{(\w+)\\\}")  # as re.escape leaves it
IN_BRACKETS = re.compile(r"(.+) (\(.+\))", re.DOTALL)
LEAST_LETTERS = 6  # beside its fields: a form with fewer would know any sentence as its own

Form = tuple[re.Pattern[str], str]


def translated(sentence: str) -> str:
    """The sentence as the operator reads it: as a whole, or behind its place (``FILE:LINE: ``), or before brackets.

    What stands in the catalogue word for word is looked for first.
    """
    if not spoken_words():
        return sentence
    return _found(sentence, _same) or _found(sentence, _formed) or sentence


def _found(sentence: str, word_of: Callable[[str], str]) -> str:
    """By ``word_of``, which answers with nothing for what it does not know; the place before a sentence stays."""
    if word := word_of(sentence):
        return word
    place, colon, rest = sentence.partition(": ")
    if colon and (word := _found(rest, word_of)):
        return f"{place}: {word}"
    bracketed = IN_BRACKETS.fullmatch(sentence)
    word = word_of(bracketed[1]) if bracketed else ""
    return f"{word} {bracketed[2]}" if bracketed and word else ""


def _same(sentence: str) -> str:
    return spoken_words().get(sentence, "")


def _formed(sentence: str) -> str:
    found = ((form.fullmatch(sentence), word) for form, word in _forms(tuple(spoken_words().items())))
    for match, word in found:
        if match:
            return word.format(**{name: translated(value) for name, value in match.groupdict().items()})
    return ""


@lru_cache(maxsize=2)
def _forms(entries: tuple[tuple[str, str], ...]) -> list[Form]:
    """Every entry with fields, the one with most of its own words first."""
    forms = []
    for source, word in entries:
        pattern, fields = FIELD.subn(r"(?P<\1>.+?)", re.escape(source))
        letters = len(source) - sum(len(name) + 2 for name in FIELD.findall(re.escape(source)))
        if fields and "\\{" not in pattern and letters >= LEAST_LETTERS:
            forms.append((letters, re.compile(pattern, re.DOTALL), word))
    return [(form, word) for _letters, form, word in sorted(forms, key=lambda entry: -entry[0])]
