"""Words: every message of the screen has its Polish, with the same fields, and no entry is left over."""

import re

import pytest

from drillctl.language import words
from drillctl.viewmodel.fault_texts import FAULT_WORDS
from tests.support.messages import POLISH, all_templates, screen_templates, templates_in

FIELD = re.compile(r"\{(\w+)([^}]*)\}")


def test_every_message_that_a_screen_may_show_has_its_polish() -> None:
    assert screen_templates() - set(POLISH) == set()


def test_a_planted_message_would_be_missed() -> None:
    planted = "raise JobError(Message('no {what}', what=1) if a else Message('b'), N_('c'), _('d'))"
    assert set(templates_in(planted)) == {"no {what}", "b", "c", "d"}


@pytest.mark.parametrize("source", POLISH)
def test_a_translation_keeps_fields_spaces_and_hot_letter(source: str) -> None:
    word = POLISH[source]
    assert sorted(FIELD.findall(word)) == sorted(FIELD.findall(source))
    assert word.endswith(" ") == source.endswith(" ") and ("&" in word) == ("&" in source)


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


def test_entries_of_several_lines_and_escapes_are_read() -> None:
    text = '# note\nmsgid ""\nmsgstr "header"\n\nmsgid "a"\n"b"\nmsgstr ""\n"c\\n"\n"\\"d\\""\n'
    assert words.catalogue(text) == {"ab": 'c\n"d"'}


def test_no_entry_is_left_over() -> None:
    assert set(POLISH) - all_templates() == set()
