"""The word that was probably meant, for the refusal of an unknown one.

Rule: a suggestion is one of the words that exist, and there is none where none is alike.
"""

from collections.abc import Iterable
from difflib import get_close_matches

from drillctl.language.messages import Message

CLOSE_ENOUGH = 0.6  # difflib's ratio: `pcb-dril` is 0.94 like `pcb-drill`, `dig` 0.57 like `run` at most
LONGEST_WORD = 60  # characters compared and shown; a longer word is no typing error


def nearest(word: str, known: Iterable[str]) -> str | None:
    """Returns the word most like this one, whatever its capitals; None where none is like it."""
    lowered = {name.casefold(): name for name in known}
    found = get_close_matches(word[:LONGEST_WORD].casefold(), lowered, n=1, cutoff=CLOSE_ENOUGH)
    return lowered[found[0]] if found else None


def known_words(word: str, known: Iterable[str]) -> Message:
    """Returns what follows the refusal of a word: ``there are a, b; did you mean b?``, the question where one is like
    it.
    """
    names = list(known)
    listed, meant = ", ".join(names), nearest(word, names)
    if meant:
        return Message("there are {names}; did you mean {word}?", names=listed, word=meant)
    return Message("there are {names}", names=listed) if names else Message("there are none")
