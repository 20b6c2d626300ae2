"""The text form: exact bytes, and back again."""

import io
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.trace import Signal, Trace, is_trace, named_signal_kind, read_text, text_lines, write_text

GOLDEN = """\
drillctl-trace 1
machine pcb-drill.toml
digest 0123abcd
tick_hz 500
command KMD_GOTOdXdY 2 0
command KMD_KONIEC
signal kmd <
signal in.0 <
signal out.0 >
signal fault >

0 kmd 1:KMD_GOTOdXdY
0 in.0 0x00000015
0 out.0 0x00000000
0 fault -
6 out.0 0x00000025
10 out.0 0x00000005
11 kmd 2:KMD_KONIEC
12 kmd -
13 fault SOFT_LIMIT
end 15
# summary one fault
"""


def text_of(trace: Trace, derived: bool = False) -> str:
    file = io.StringIO()
    write_text(trace, file, derived=derived)
    return file.getvalue()


def test_exact_bytes(trace: Trace, tmp_path: Path) -> None:
    write_text(trace, tmp_path / "golden")
    assert (tmp_path / "golden").read_bytes() == GOLDEN.encode()


def test_derived_signals_only_on_request(trace: Trace) -> None:
    lines = text_of(trace, derived=True).splitlines()
    assert "signal x.position >" in lines
    assert [line for line in lines if " x.position " in line][1:] == [
        "0 x.position 0",
        "6 x.position -1",
        "10 x.position -2",
    ]


def test_reading_gives_the_trace_back(trace: Trace) -> None:
    back = read_text(io.StringIO(text_of(trace, derived=True)))
    assert back == trace
    assert [(signal.kind, signal.derived) for signal in back.signals] == [
        (signal.kind, signal.derived) for signal in trace.signals
    ]
    assert text_of(back) == GOLDEN


def test_reading_a_path_and_asking(trace: Trace, tmp_path: Path) -> None:
    write_text(trace, tmp_path / "golden")
    back = read_text(tmp_path / "golden")
    assert back.shown_at("kmd", 11) == "2:KMD_KONIEC"
    assert back.trailer == ("summary one fault",)
    assert (back.end, back.header) == (trace.end, trace.header)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (GOLDEN.encode(), True),
        (b"drillctl-trace 2\n", True),  # to be refused by name, not passed over
        (b"drillctl-tracer 1\n", False),
        (b"drillctl", False),
        (b"", False),
        (b"\x1f\x8b\x00\xff", False),
    ],
)
def test_magic_first_line(content: bytes, expected: bool, tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(content)
    assert is_trace(tmp_path / "file") is expected


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"header": (("machine", "two\nlines"),)}, "machine"),
        ({"header": (("machine", " outer blanks "),)}, "machine"),
        ({"header": (("machine", "long" * 2000),)}, "too long"),
        ({"header": (("signal", "out.9 >"),)}, "no key"),
        ({"header": (("end", "15"),)}, "no key"),
        ({"header": (("Big", "x"),)}, "no key"),
        ({"trailer": ("two\nlines",)}, "#"),
        ({"signals": (Signal("out.0", "count", stimulus=False),)}, "its name says a word"),
    ],
)
def test_what_could_not_be_read_back_is_not_written(changes: dict[str, Any], reason: str, tmp_path: Path) -> None:
    parts: dict[str, Any] = {
        "header": (),
        "signals": (Signal("late", "count", stimulus=True),),
        "ticks": [0],
        "signal": [0],
        "values": [1],
        "end": 1,
    }
    trace = Trace.of_changes(**{**parts, **changes})
    with pytest.raises(ValueError, match=reason):
        write_text(trace, tmp_path / "golden")
    assert not (tmp_path / "golden").exists()


NAMES = ("-", "HOLD", "STOP", "ZA\u017b\u00d3\u0141\u0106")
VALUES = {
    "word": st.integers(0, 2**32 - 1),
    "count": st.integers(-(2**31), 2**31 - 1),
    "name": st.integers(0, len(NAMES) - 1),
    "command": st.one_of(st.just(0), st.integers(0, 10**9 - 1).map(lambda sequence: sequence * 64 + 1)),
}
def test_how_much_of_a_file_is_read_is_told_and_may_end_the_reading(
    trace: Trace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class GivenUp(Exception):
        pass

    def give_up(done: int, total: int) -> None:
        raise GivenUp

    monkeypatch.setattr(text_lines, "PAGE_CHARACTERS", 30)
    write_text(trace, tmp_path / "golden")
    size, told = (tmp_path / "golden").stat().st_size, []
    assert read_text(tmp_path / "golden", advance=lambda done, total: told.append((done, total))) == read_text(
        tmp_path / "golden"
    )
    assert len(told) > 3 and told == sorted(told) and {total for _, total in told} == {size} and told[-1][0] <= size
    with pytest.raises(GivenUp):
        read_text(tmp_path / "golden", advance=give_up)


PLAIN = st.text(max_size=20).map(str.strip).filter(str.isprintable)
KEYS = st.from_regex(r"[a-z][a-z0-9_-]{0,8}", fullmatch=True).filter(lambda key: key not in ("signal", "end"))
SIGNAL_NAMES = ("kmd", "in.0", "in.12", "out.0", "request", "fault", "late", "x.column", "plant.z", "other")


@st.composite
def traces(draw: st.DrawFn) -> Trace:
    """Any trace that can be recorded under the names a file knows."""
    chosen = draw(st.lists(st.sampled_from(SIGNAL_NAMES), unique=True, max_size=6))
    kinds = [named_signal_kind(name) for name in chosen]
    signals = [
        Signal(name, kind, draw(st.booleans()), derived, names=NAMES if kind in ("name", "command") else ())
        for name, (kind, derived) in zip(chosen, kinds, strict=True)
    ]
    end = draw(st.integers(0, 10**12))
    rows: list[tuple[int, int, int]] = []
    for index, signal in enumerate(signals if end else []):
        ticks = draw(st.lists(st.integers(0, end - 1), max_size=8))
        rows += [(tick, index, draw(VALUES[signal.kind])) for tick in ticks]
    ticks, which, values = ([row[column] for row in rows] for column in range(3))
    header = draw(st.lists(st.tuples(KEYS, PLAIN), max_size=4))
    trailer = draw(st.lists(PLAIN, max_size=3))
    return Trace.of_changes(header, signals, ticks, which, values, end, trailer)


@settings(max_examples=200, deadline=None)
@given(traces())
def test_round_trip(trace: Trace) -> None:
    """Whatever can be recorded is read back as it was, and written again to the same byte."""
    text = text_of(trace, derived=True)
    back = read_text(io.StringIO(text))
    assert back == trace
    assert text_of(back, derived=True) == text


@settings(max_examples=50, deadline=None)
@given(traces())
def test_without_derived_signals_only_they_are_missing(trace: Trace) -> None:
    back = read_text(io.StringIO(text_of(trace)))
    kept = [signal.name for signal in trace.signals if not signal.derived]
    assert [signal.name for signal in back.signals] == kept
    for name in kept:
        signal, same = trace.signals[trace.index_of(name)], back.signals[back.index_of(name)]
        assert same.words(back.changes_of(name)[1]).tolist() == signal.words(trace.changes_of(name)[1]).tolist()
