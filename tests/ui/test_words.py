"""Words: every message of the screen has its Polish, with the same fields, and no entry is left over."""

import pkgutil
import re
from pathlib import Path

import pytest

from drillctl.language import Counted, words
from drillctl.viewmodel.fault_texts import FAULT_WORDS
from tests.support.messages import (
    CATALOGUE,
    POLISH,
    POLISH_FORMS,
    TRANSLATED,
    all_templates,
    screen_templates,
    templates_in,
)

GLOSSARY = Path(__file__).parents[2] / "docs" / "GLOSSARY.md"
FIELD = re.compile(r"\{(\w+)([^}]*)\}")


def test_every_message_that_a_screen_may_show_has_its_polish() -> None:
    assert screen_templates() - TRANSLATED == set()


def test_a_planted_message_would_be_missed() -> None:
    planted = "raise JobError(Message('no {what}', what=1) if a else Message('b'), N_('c'), _('d'))"
    planted += "; Counted('{count} hole', '{count} holes', 2); ngettext('e', 'f', 2)"
    assert set(templates_in(planted)) == {"no {what}", "b", "c", "d", "{count} hole", "{count} holes", "e", "f"}


def is_kept(source: str, word: str) -> bool:
    """Whether fields, a space at the end and the hot letter of a source text are in its translation too."""
    fields = sorted(FIELD.findall(word)) == sorted(FIELD.findall(source))
    return fields and word.endswith(" ") == source.endswith(" ") and ("&" in word) == ("&" in source)


def test_translations_keep_fields_spaces_and_hot_letters() -> None:
    assert [(source, word) for source, word in POLISH.items() if not is_kept(source, word)] == []


def test_a_number_s_three_forms_keep_its_fields() -> None:
    for (one, many), forms in POLISH_FORMS.items():
        assert len(forms) == 3 and "{count" in one
        assert [form for form in (many, *forms) if not is_kept(one, form)] == []


@pytest.mark.parametrize(
    ("count", "polish", "plain"),
    [(0, "0 kroków", "0 steps"), (1, "1 krok", "1 step"), (2, "2 kroki", "2 steps"), (4, "4 kroki", "4 steps"),
     (5, "5 kroków", "5 steps"), (12, "12 kroków", "12 steps"), (21, "21 kroków", "21 steps"),
     (22, "22 kroki", "22 steps"), (112, "112 kroków", "112 steps"), (124, "124 kroki", "124 steps"),
     (-1, "-1 krok", "-1 step"), (-3, "-3 kroki", "-3 steps")],
)  # fmt: skip
def test_a_number_has_its_form_in_both_languages(count: int, polish: str, plain: str) -> None:
    message = Counted("{count} step", "{count} steps", count)
    assert message == plain == words.translated(message)
    words.use("pl")
    assert words.translated(message) == polish
    assert words.ngettext("{count} step", "{count} steps", count).format(count=count) == polish


def test_a_catalogue_that_is_older_than_its_source_is_told_of(monkeypatch: pytest.MonkeyPatch) -> None:
    read = pkgutil.get_data
    assert words.use("pl") is None
    monkeypatch.setattr(pkgutil, "get_data", lambda package, name: read(package, name) + b"\n")
    assert words.use("pl") == words.NOT_COMPILED.format(language="pl") and words._("Tool") == "Wiertło"


def test_a_clone_without_compiled_words_speaks_english_and_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    read = pkgutil.get_data

    def sources_only(package: str, name: str) -> bytes | None:
        if name.endswith(".mo"):
            raise FileNotFoundError(name)
        return read(package, name)

    monkeypatch.setattr(pkgutil, "get_data", sources_only)
    assert words.use("pl") == words.NOT_COMPILED.format(language="pl") and words._("Tool") == "Tool"


def test_faults_are_told_in_polish() -> None:
    told = {text for fault in FAULT_WORDS.values() for text in fault}
    assert told - set(POLISH) == set()


@pytest.mark.parametrize(
    ("environment", "language"),
    [({"LANG": "pl_PL.UTF-8"}, "pl"), ({"LANG": "C.UTF-8"}, "en"), ({}, "en"), ({"LANG": "de_DE"}, "en"),
     ({"LANGUAGE": "pl", "LANG": "en_GB.UTF-8"}, "pl"), ({"LC_ALL": "en_GB", "LANG": "pl_PL"}, "en")],
)  # fmt: skip
def test_the_language_follows_the_environment(environment: dict[str, str], language: str) -> None:
    assert words.language_of(environment) == language


def test_a_poor_terminal_gets_letters_without_accents() -> None:
    try:
        words.use("pl", plain=True)
        assert words._("Order") == "Kolejnosc" and words._("Tool") == "Wiertlo"
    finally:
        words.use("en")


def test_every_entry_is_read_from_the_compiled_form() -> None:
    words.use("pl")
    assert {source: words._(source) for source in POLISH} == POLISH
    assert CATALOGUE.metadata["Plural-Forms"].startswith("nplurals=3;")


def test_no_entry_is_left_over() -> None:
    assert TRANSLATED - all_templates() == set()


def test_no_word_that_the_glossary_rules_out_is_used() -> None:
    section = GLOSSARY.read_text("utf-8").partition("## Words that are not used")[2]
    rows = [row.split("|")[1].strip() for row in section.splitlines() if row.startswith("| ")][1:]
    beginnings = [word for row in rows for word in row.split(", ")]
    ruled_out = re.compile(rf"\b(?:{'|'.join(beginnings)})", re.IGNORECASE)
    polish = [*POLISH.values(), *(form for forms in POLISH_FORMS.values() for form in forms)]
    assert len(beginnings) > 9 and ruled_out.search("nowa tabela")
    assert [text for text in polish if ruled_out.search(text)] == []
