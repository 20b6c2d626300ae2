"""Words in the operator's language. Source strings are English; other languages are catalogues in ``drillctl/locale``.

Rule: a catalogue is the ``.po`` file itself, as translators' tools write it; nothing is compiled, so nothing can be
stale. The standard library reads only compiled catalogues, hence ``catalogue`` below.
"""

import ast
import gettext
import os
import pkgutil
import re
import unicodedata
from collections.abc import Mapping

from drillctl.language.messages import Message

LANGUAGES = ("en", "pl")
ENTRY = re.compile(r'^msgid ((?:".*"\s*)+)^msgstr ((?:".*"\s*)+)', re.MULTILINE)
QUOTED = re.compile(r'".*"')


class Catalogue(gettext.NullTranslations):
    """The translations of one language by English source; what is missing stays English."""

    def __init__(self, words: Mapping[str, str]):
        super().__init__()
        self.words = words

    def gettext(self, message: str) -> str:
        """Returns the translation, or the English text where there is none."""
        return self.words.get(message) or message


_spoken = Catalogue({})


def catalogue(text: str) -> dict[str, str]:
    """Returns a ``.po`` file's entries by source string, without its header. Plural forms are not read."""
    found = {_joined(source): _joined(word) for source, word in ENTRY.findall(text)}
    return {source: word for source, word in found.items() if source}


def use(language: str, plain: bool = False) -> None:
    """Sets the language of ``_`` to one of LANGUAGES; ``plain``: without accents, for a terminal that has none."""
    words = {} if language == "en" else catalogue(catalogue_text(language))
    if plain:
        words = {source: _without_accents(word) for source, word in words.items()}
    _spoken.words = words


def translated(message: str) -> str:
    """Returns a message in the operator's language: its template's translation with its fields, Messages among them
    translated too. A text that is no Message is data and returned as it is.
    """
    if not isinstance(message, Message):
        return message
    fields = {name: translated(value) if isinstance(value, str) else value for name, value in message.fields.items()}
    return _(message.template).format(**fields)


def catalogue_text(language: str) -> str:
    """Returns the text of a language's catalogue. Raises OSError where it is not installed."""
    return (pkgutil.get_data("drillctl", f"locale/{language}/LC_MESSAGES/drillctl.po") or b"").decode()


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


def N_(message: str) -> str:
    """Marks a message of a table for translation; it is translated where it is shown."""
    return message


def _joined(quoted: str) -> str:
    return "".join(ast.literal_eval(part) for part in QUOTED.findall(quoted))
