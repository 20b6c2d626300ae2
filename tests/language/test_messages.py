"""Messages: formatted once in English, translated by their template, with data left as it is."""

import pickle
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.generation.drillfile import read
from drillctl.generation.drillfile.errors import REFUSALS, WARNINGS, Remark
from drillctl.kmd import KmdError, Names, parse_program
from drillctl.language import Message, Refusal, joined, message_of, verbatim, words
from drillctl.language.messages import MOST_SHOWN, message_from, packed
from drillctl.language.words import translated
from drillctl.machine import Library, shipped_tables
from drillctl.machine.errors import TableError
from drillctl.machine.source import Source
from drillctl.ports import PortRefused
from drillctl.ticker.message_text import LONGEST_BYTES, message_read, message_text
from tests.support.messages import POLISH

BLINKER = Path(__file__).resolve().parents[2] / "examples" / "blinker.drl"
NO_DIAMETER = "tool T{number} has no diameter, so no drill can be chosen for it"


@pytest.fixture
def polish() -> Iterator[None]:
    words.use("pl")
    yield
    words.use("en")


def test_a_message_is_its_english_text() -> None:
    message = Message(NO_DIAMETER, number=3)
    assert message == "tool T3 has no diameter, so no drill can be chosen for it"
    assert (message.template, message.fields) == (NO_DIAMETER, {"number": 3})


def test_a_message_without_one_of_its_fields_is_no_message() -> None:
    with pytest.raises(KeyError):
        Message(NO_DIAMETER)


@pytest.mark.parametrize(
    ("place", "text", "line"),
    [(("a.drl",), "a.drl: cut short", None), (("a.drl", 7), "a.drl:7: cut short", 7),
     (("a.drl", 7, 2), "a.drl:7:2: cut short", 7), ((Path("a.drl"), None), "a.drl: cut short", None)],
)  # fmt: skip
def test_a_place_stands_before_the_text(place: tuple[object, ...], text: str, line: int | None) -> None:
    placed = Message("cut short").at(*place)
    assert (placed, placed.line) == (text, line)
    assert Message("{why}; give it up", why=placed).line == line


fields = st.one_of(st.integers(), st.text(max_size=9))
messages = st.recursive(
    st.builds(lambda one, two: Message("{one} and {two}", one=one, two=two), fields, fields),
    lambda inner: st.builds(
        lambda one, two: Message("{one}; {two}", one=one, two=two), inner, st.one_of(fields, inner)
    ),
    max_leaves=4,
)


@given(messages)
def test_a_message_comes_whole_through_json_and_pickle(message: Message) -> None:
    for copy in (
        message_from(packed(message)),
        pickle.loads(pickle.dumps(message)),
        message_read(message_text(message)),
    ):
        assert (copy, copy.template, copy.fields) == (message, message.template, message.fields)


def test_a_field_that_json_has_no_form_for_comes_as_its_text() -> None:
    message = Message("{file} is there", file=Path("a.drl"))
    assert message_read(message_text(message)) == message


@pytest.mark.parametrize("letter", ["x", "\n", "\u0119", "\U0001f527", '"'])
def test_a_message_that_is_too_long_for_the_link_is_cut(letter: str) -> None:
    line = message_text(Message("lost: {why}", why=letter * 5000))
    assert len(line) <= LONGEST_BYTES and line.isascii() and "\n" not in line
    assert message_read(line).startswith(f"lost: {letter * 250}")


def test_a_refusal_is_a_line_for_each_message() -> None:
    refusal = Refusal(*(Message("hole {number}", number=number) for number in range(MOST_SHOWN + 2)))
    lines = str(refusal).split("\n")
    assert (lines[0], lines[-1], len(lines)) == ("hole 0", "and 2 more", MOST_SHOWN + 1)
    assert len(refusal.messages) == MOST_SHOWN + 2
    assert str(Refusal(Message("no {name}", name="a\nb"))) == "no a\\nb"


@pytest.mark.parametrize(
    "refusal",
    [TableError("a.toml", Message("no {name}", name="x"), 3), KmdError("a.kmd", 3, 1, Message("cut short")),
     PortRefused("gpio", Message("cut short")), Refusal(Message("a"), Message("b"))],
)  # fmt: skip
def test_a_refusal_comes_whole_through_a_pickle(refusal: Refusal) -> None:
    copy = pickle.loads(pickle.dumps(refusal))
    assert type(copy) is type(refusal) and str(copy) == str(refusal) and vars(copy) == vars(refusal)


@pytest.mark.parametrize(
    ("error", "text"),
    [(ValueError("plain"), "plain"), (ValueError(Message("no {what}", what=1)), "no 1"),
     (OSError(2, "No such file", "a.drl"), "No such file"), (OSError("gone"), "gone"), (Refusal(Message("a")), "a")],
)  # fmt: skip
def test_what_an_exception_says(error: Exception, text: str) -> None:
    assert message_of(error) == text


def test_in_english_nothing_changes() -> None:
    assert translated(Message(NO_DIAMETER, number=3)) == Message(NO_DIAMETER, number=3)


@pytest.mark.usefixtures("polish")
def test_a_table_named_like_a_word_of_the_screen_keeps_its_name() -> None:
    assert "Hold" in POLISH
    assert translated(Message("there is a table named {name} already", name="Hold")) == (
        POLISH["there is a table named {name} already"].format(name="Hold")
    )
    assert translated("Hold") == translated(verbatim("Hold")) == "Hold"


@pytest.mark.usefixtures("polish")
def test_a_message_in_a_message_is_translated_and_its_place_is_not() -> None:
    inner = Message("the file holds no commands")
    assert translated(inner.at("Hold", 3)) == "Hold:3: plik nie zawiera poleceń"
    assert translated(joined("; ", [inner, "Hold"])) == "plik nie zawiera poleceń; Hold"
    assert translated(Message("{error}; to go on with another journal, name it", error=inner)).startswith("plik nie")


@pytest.mark.usefixtures("polish")
@pytest.mark.parametrize(
    ("line", "word"),
    [
        ("KMD_BAZZA", "nieznany rozkaz 'KMD_BAZZA'; może KMD_BAZA?"),
        ("KMD_GOTOdXdY 1", "1 argument; zapis: KMD_GOTOdXdY dX dY"),
        ("KMD_GOTOdXdY 1 b", "'b' to nie liczba całkowita"),
        ("KMD_WYJSCIE lampa 1", "nieznana nazwa 'lampa' (wyjście); ta maszyna nie ma żadnych"),
        ("KMD_RUCH q=1", "nie ma osi 'q'; są x, y"),
    ],
)
def test_a_wrong_line_of_a_queue_is_told(line: str, word: str) -> None:
    with pytest.raises(KmdError) as refused:
        parse_program(line, Names(("x", "y"), {}, {}), "a.kmd")
    assert translated(refused.value.message).startswith("a.kmd:1:")
    assert translated(refused.value.reason) == word


@pytest.mark.usefixtures("polish")
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
    assert translated(refused.value.message).partition(": ")[2] == word


@pytest.mark.usefixtures("polish")
@pytest.mark.parametrize("code", [*REFUSALS, *WARNINGS])
def test_a_remark_on_a_drill_file_keeps_its_code_and_what_it_quotes(code: str) -> None:
    english = {**REFUSALS, **WARNINGS}[code]
    assert translated(Remark(code, 3, "G99").reason) == f"{code}: {POLISH[english]} ('G99')"


@pytest.mark.usefixtures("polish")
def test_the_reason_of_a_recognition_is_told_whole(tmp_path: Path) -> None:
    for fmt in (None, "inch,2:4,trailing"):
        assert translated(read(BLINKER, fmt=fmt).reason) != read(BLINKER, fmt=fmt).reason
    (tmp_path / "bare.drl").write_text("%\nT1C0.031\nX005000Y012500\nX006000Y012500\nX0065Y0135\nM30\n")
    reason = translated(read(tmp_path / "bare.drl").reason)
    assert reason.startswith("nic nie zadeklarowano; ") and "daje: " in reason and "w drugiej kolejności" in reason
    assert not any(word in reason for word in ("suppressed", "zeros", "overlapping", "extent"))
