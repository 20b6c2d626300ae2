"""Sentences from below in the operator's language: known by their form, wherever they stand."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.generation.drillfile import read
from drillctl.generation.drillfile.errors import REFUSALS, WARNINGS
from drillctl.kmd import KmdError, Names, parse_program
from drillctl.language import words
from drillctl.language.sentences import translated
from drillctl.machine import Library, shipped_tables
from drillctl.machine.errors import TableError
from drillctl.machine.source import Source
from tests.support.sentences import editors_findings, form_of, refusals
from tests.ui.test_words import POLISH

BLINKER = Path(__file__).resolve().parents[2] / "examples" / "blinker.drl"


@pytest.fixture(autouse=True)
def polish() -> Iterator[None]:
    words.use("pl")
    yield
    words.use("en")


@pytest.mark.parametrize(
    ("sentence", "word"),
    [
        ("the file holds no commands", "plik nie zawiera poleceń"),
        ("job.drl:3: the file holds no commands", "job.drl:3: plik nie zawiera poleceń"),
        ("job.drl:7: duplicate-hole: the same hole is drilled twice ('3 in all')",
         "job.drl:7: duplicate-hole: ten sam otwór jest wiercony dwa razy ('3 in all')"),
        ("j.drl: no drill serves tool T2 (1.000 mm); the nearest is 0.800 mm",
         "j.drl: żadne wiertło nie pasuje do T2 (1.000 mm); najbliższe ma 0.800 mm"),
        ("inch 2:4, trailing zeros suppressed", "inch 2:4, pominięto: zera końcowe"),
        ("nothing declared; the numbers carry decimal points",
         "nic nie zadeklarowano; liczby mają kropki dziesiętne"),
        ("X 4 steps is outside 0..2; Y 9 steps is outside 0..5",
         "X 4 kroków jest poza 0..2; Y 9 kroków jest poza 0..5"),
        ("a sentence that nobody has translated", "a sentence that nobody has translated"),
        ("", ""),
    ],
)  # fmt: skip
def test_a_sentence_is_told_by_its_form(sentence: str, word: str) -> None:
    assert translated(sentence) == word


def test_in_english_nothing_changes() -> None:
    words.use("en")
    assert translated("inch 2:4, trailing zeros suppressed") == "inch 2:4, trailing zeros suppressed"


@pytest.mark.parametrize("sentence", sorted(refusals()))
def test_every_refusal_and_warning_of_generation_has_its_polish(sentence: str) -> None:
    assert sentence in {form_of(source) for source in POLISH}


@pytest.mark.parametrize("sentence", sorted(editors_findings()))
def test_every_finding_of_the_editors_has_its_polish(sentence: str) -> None:
    assert sentence in {form_of(source) for source in POLISH}


@pytest.mark.parametrize(
    ("line", "word"),
    [
        ("KMD_BAZZA", "nieznany rozkaz 'KMD_BAZZA'; może KMD_BAZA?"),
        ("KMD_GOTOdXdY 1", "argumentów: 1; zapis: KMD_GOTOdXdY dX dY"),
        ("KMD_GOTOdXdY 1 b", "'b' to nie liczba całkowita"),
        ("KMD_WYJSCIE lampa 1", "nieznana nazwa 'lampa' (wyjście); ta maszyna nie ma żadnych"),
        ("KMD_RUCH q=1", "nie ma osi 'q'; są x, y"),
    ],
)
def test_a_wrong_line_of_a_queue_is_told(line: str, word: str) -> None:
    with pytest.raises(KmdError) as refused:
        parse_program(line, Names(("x", "y"), {}, {}))
    assert translated(f"3:1: {refused.value.reason}") == f"3:1: {word}"


@pytest.mark.parametrize(
    ("written", "instead", "word"),
    [
        ("tick_hz = 500", "tick_hz = 0", "tick_hz: oczekiwano int >= 1"),
        ("tick_hz = 500", 'tick_hz = "a"', "tick_hz: oczekiwano int, jest str"),
        ("tick_hz = 500", "", "tick_hz: brak"),
        ("tick_hz = 500", "tick_hz = 500\nhz = 1", "nieznany klucz hz"),
        ("tick_hz = 500", "tick_hz = =", "to nie TOML: Invalid value"),
        ('"drop"', '"x"', "emergency_stop: niedozwolona wartość 'x'"),
        ('name = "x"', 'name = "x y"', "axis[0].name: nazwa to litery, cyfry, - i _, nie zaczyna się od - ani _"),
        ('name = "y_min"', 'name = "x_min"', "sensor x_min: ta nazwa już jest"),
        ('"x.1b" = 1', '"x.1b" = 0', 'wiring: bit wyjściowy 0 dla "x.1b" zajmuje już x.1a'),
        ('"x.1b" = 1', "", 'wiring: brak bitu dla "x.1b", przewodu z tablicy faz'),
    ],
)
def test_a_wrong_machine_is_told(written: str, instead: str, word: str) -> None:
    text = (shipped_tables() / "machines" / "pcb-drill.toml").read_text("utf-8")
    assert written in text
    with pytest.raises(TableError) as refused:
        Library((shipped_tables(),)).check_source(Source(Path("own.toml"), text.replace(written, instead, 1)))
    assert translated(str(refused.value)).partition(": ")[2] == word


@pytest.mark.parametrize("code", [*REFUSALS, *WARNINGS])
def test_every_remark_on_a_drill_file_has_its_polish(code: str) -> None:
    english = {**REFUSALS, **WARNINGS}[code]
    assert translated(f"{code}: {english} ('G99')") == f"{code}: {POLISH[english]} ('G99')"


def test_the_reason_of_a_recognition_is_told_whole(tmp_path: Path) -> None:
    for fmt in (None, "inch,2:4,trailing"):
        assert translated(read(BLINKER, fmt=fmt).reason) != read(BLINKER, fmt=fmt).reason
    (tmp_path / "bare.drl").write_text("%\nT1C0.031\nX005000Y012500\nX006000Y012500\nX0065Y0135\nM30\n")
    reason = translated(read(tmp_path / "bare.drl").reason)
    assert reason.startswith("nic nie zadeklarowano; ") and "daje: " in reason and "w drugiej kolejności" in reason
    assert not any(word in reason for word in ("suppressed", "zeros", "overlapping", "extent"))


@given(st.text(max_size=60))
def test_any_text_can_be_told(text: str) -> None:
    assert isinstance(translated(text), str)
