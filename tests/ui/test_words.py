"""Words: every message of the screen has its Polish, with the same fields, and no entry is left over."""

import ast
import re
from pathlib import Path

import pytest

from drillctl import ui
from drillctl.language import words
from drillctl.viewmodel.fault_texts import FAULT_WORDS
from tests.support.sentences import all_forms, form_of

ROOT = Path(ui.__file__).parent
POLISH = words.catalogue((words.LOCALE / "pl" / "LC_MESSAGES" / "drillctl.po").read_text("utf-8"))
FIELD = re.compile(r"\{(\w*)")


def messages() -> set[str]:
    """Every literal handed to _ or N_ in the screens."""
    calls = [node for file in ROOT.rglob("*.py") for node in ast.walk(ast.parse(file.read_text("utf-8")))]
    return {
        call.args[0].value
        for call in calls
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id in ("_", "N_")
        and call.args and isinstance(call.args[0], ast.Constant)
    }  # fmt: skip


def test_every_message_has_its_polish() -> None:
    assert messages() - set(POLISH) == set()


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
    """Besides the screens' own messages there are the faults' words, and the sentences of the rooms below."""
    told = all_forms() | {text for fault in FAULT_WORDS.values() for text in fault}
    left = set(POLISH) - messages()
    assert {source for source in left if form_of(source) not in told} == set()
