"""Words in the operator's language. Source strings are English; other languages are catalogues in ``drillctl/locale``.

Rule: a catalogue is read in gettext's compiled form, ``drillctl.mo``, which the build makes from ``drillctl.po``
(hatch_build.py) and which carries the digest of that source. Where the source was changed since, ``use`` says so.
"""

import gettext
import io
import os
import pkgutil
import unicodedata
from collections.abc import Mapping
from functools import lru_cache
from hashlib import sha256

from drillctl.language.messages import Counted, Message

LANGUAGES = ("en", "pl")
CATALOGUE = "locale/{language}/LC_MESSAGES/drillctl.{form}"
SOURCE_DIGEST = "x-source-sha256"  # the header of a compiled catalogue, as GNUTranslations.info() spells its name
NOT_COMPILED = "the words of language {language} are not compiled from their present source; run: python hatch_build.py"

_spoken = gettext.NullTranslations()


class WithoutAccents(gettext.NullTranslations):
    """Another catalogue's words in ASCII, for a terminal that has no more."""

    def __init__(self, words: gettext.NullTranslations):
        super().__init__()
        self._words = words

    def gettext(self, message: str) -> str:
        """Returns the translation without accents."""
        return _without_accents(self._words.gettext(message))

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        """Returns the translation for this number without accents."""
        return _without_accents(self._words.ngettext(msgid1, msgid2, n))


def use(language: str, plain: bool = False) -> Message | None:
    """Sets the language of ``_`` and ``ngettext`` to one of LANGUAGES; ``plain``: without accents, for a terminal that
    has none.

    Returns what is wrong with the catalogue, None where nothing is. Words that it lacks stay English.
    """
    global _spoken  # noqa: PLW0603  the language is one for the process, as gettext's own
    words, problem = (gettext.NullTranslations(), None) if language == "en" else _catalogue(language)
    _spoken = WithoutAccents(words) if plain else words
    return problem


def _catalogue(language: str) -> tuple[gettext.NullTranslations, Message | None]:
    """Returns a language's words, and what is wrong with them."""
    compiled, source = (_data(CATALOGUE.format(language=language, form=form)) for form in ("mo", "po"))
    words = gettext.GNUTranslations(io.BytesIO(compiled)) if compiled else gettext.NullTranslations()
    is_present = source is None or words.info().get(SOURCE_DIGEST) == sha256(source).hexdigest()
    return words, None if is_present else Message(NOT_COMPILED, language=language)


def _data(name: str) -> bytes | None:
    """Returns a file of the package, None where it is not installed."""
    try:
        return pkgutil.get_data("drillctl", name)
    except FileNotFoundError:
        return None


def translated(message: str) -> str:
    """Returns a message in the operator's language: its template's translation with its fields, Messages among them
    translated too. A text that is no Message is data and returned as it is.
    """
    if not isinstance(message, Message):
        return message
    fields = {name: translated(value) if isinstance(value, str) else value for name, value in message.fields.items()}
    if isinstance(message, Counted):
        return ngettext(message.template, message.plural, message.number).format(**fields)
    return _(message.template).format(**fields)


@lru_cache(maxsize=4096)
def _without_accents(text: str) -> str:
    """Returns the text with its accents removed. The Polish l with a stroke has no accent that could be removed."""
    letters = unicodedata.normalize("NFKD", text.replace("ł", "l").replace("Ł", "L"))
    return letters.encode("ascii", "ignore").decode("ascii")


def language_of(environment: Mapping[str, str] = os.environ) -> str:
    """Returns the language of LANGUAGE, LC_ALL, LC_MESSAGES and LANG, in the order of gettext; English where they name
    no other.
    """
    for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"):
        if code := environment.get(name, "")[:2]:
            return code if code in LANGUAGES else "en"
    return "en"


def _(message: str) -> str:
    """Returns the message in the operator's language."""
    return _spoken.gettext(message) if message else ""


def ngettext(one: str, many: str, count: int) -> str:
    """Returns the message for this number, of either sign, in the operator's language: in English ``one`` for 1, else
    ``many``.
    """
    return _spoken.ngettext(one, many, abs(count))


def N_(message: str) -> str:
    """Marks a message of a table for translation; it is translated where it is shown."""
    return message
