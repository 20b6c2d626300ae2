"""What the reader refuses: a good file with one thing wrong, and the line and reason it must name."""

import io
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.trace import Trace, TraceError, read_text, reader, text_lines, write_text
from drillctl.trace.text_changes import TextChanges

GOOD = """\
drillctl-trace 1
tick_hz 500
signal kmd <
signal out.0 >
signal late <

0 kmd -
0 out.0 0x00000000
0 late 0
3 kmd 1:KMD_CZEKAJ
3 out.0 0x00000025
7 late -2
end 9
# late 1
"""


def read(text: str) -> Trace:
    return read_text(io.StringIO(text), "golden.trace")


def test_the_good_file_is_read() -> None:
    assert read(GOOD).value_at("late", 8) == -2


@pytest.mark.parametrize(
    ("old", "new", "line", "reason"),
    [
        ("drillctl-trace 1", "drillctl-tracer 1", 1, "not a trace"),
        ("drillctl-trace 1", "drillctl-trace 2", 1, "reads version 1"),
        ("drillctl-trace 1", "\ufeffdrillctl-trace 1", 1, "not a trace"),
        ("trace 1\n", "trace 1\r\n", 1, "CR LF"),
        ("tick_hz 500", "tick_hz 500\r", 2, "out of place"),
        ("tick_hz 500", "Tick_hz 500", 2, "out of place"),
        ("tick_hz 500", "tick_hz 500 ", 2, "out of place"),
        ("tick_hz 500", "tick_hz  500", 2, "out of place"),
        ("signal late <", "signal late <\nseed 4", 6, "out of place"),
        ("signal late <", "signal late", 5, "expected a name, then <"),
        ("signal late <", "signal late =", 5, "expected a name, then <"),
        ("signal late <", "signal out.0 >", 5, "declared twice"),
        ("0 late 0\n", "", 9, "'late' has no value at tick 0"),
        ("0 late 0\n", "0 late 0\n0 out.7 0x00000000\n", 10, "'out.7' is not declared"),
        ("0 out.0 0x00000000\n0 late 0", "0 late 0\n0 out.0 0x00000000", 9, "out of order"),
        ("3 out.0", "2 out.0", 11, "tick 2 out.0: out of order"),
        ("3 out.0 0x00000025", "3 out.0 0x00000025\n3 out.0 0x00000026", 12, "out of order"),
        ("3 out.0 0x00000025", "3 out.0 0x00000000", 11, "only changes are listed"),
        ("3 out.0", "03 out.0", 11, "'03' is no tick"),
        ("3 out.0", "+3 out.0", 11, "is no tick"),
        ("3 out.0", "-3 out.0", 11, "is no tick"),
        ("3 out.0", "\u0663 out.0", 11, "is no tick"),
        ("3 out.0", "1000000000001 out.0", 11, "is no tick"),
        ("3 out.0", "9" * 4000 + " out.0", 11, "is no tick"),
        ("3 out.0", " out.0", 11, "is no tick"),
        ("0x00000025", "0x25", 11, "no port word"),
        ("0x00000025", "0x0000002A", 11, "no port word"),
        ("0x00000025", "37", 11, "no port word"),
        ("0x00000025", "0x00000025 ", 11, "no port word"),
        ("0x00000025", "0x00000025\r", 11, "no port word"),
        ("late -2", "late -02", 12, "no whole number"),
        ("late -2", "late 2.5", 12, "no whole number"),
        ("late -2", "late", 12, "no whole number"),
        ("late -2", "late 2147483648", 12, "too large"),
        ("late -2", "late " + "9" * 4000, 12, "too large"),
        ("1:KMD_CZEKAJ", "KMD_CZEKAJ", 10, "no command"),
        ("1:KMD_CZEKAJ", "1:-", 10, "no command"),
        ("1:KMD_CZEKAJ", "1:", 10, "no command"),
        ("1:KMD_CZEKAJ", "9999999999:KMD_CZEKAJ", 10, "no command"),
        ("1:KMD_CZEKAJ", "1:KMD CZEKAJ", 10, "no word"),
        ("end 9", "end 7", 13, "change at tick 7"),
        ("end 9", "end", 13, "is no tick"),
        ("end 9\n# late 1\n", "", 12, "without 'end'"),
        ("end 9\n# late 1\n", "end 9", 13, "cut short"),
        ("# late 1", "10 late 3", 14, "only # lines may follow"),
        ("# late 1", "# bell \x07", 14, "only # lines may follow"),
        ("tick_hz 500", "x" * 5000, 2, "longer than 4096"),
        ("# late 1", "# " + "x" * 5000, 14, "longer than 4096"),
    ],
)
def test_refused_by_line_and_reason(old: str, new: str, line: int, reason: str) -> None:
    assert GOOD.count(old) >= 1
    with pytest.raises(TraceError) as caught:
        read(GOOD.replace(old, new, 1))
    assert str(caught.value).startswith(f"golden.trace:{line}: ")
    assert reason in caught.value.reason
    assert len(str(caught.value)) < 160


@pytest.mark.parametrize(("lines", "line"), [(0, 1), (1, 1), (4, 4), (6, 6), (7, 7), (12, 12)])
def test_cut_at_a_line(lines: int, line: int) -> None:
    with pytest.raises(TraceError, match=f"golden.trace:{line}: .*(cut short|not a trace)"):
        read("".join(GOOD.splitlines(keepends=True)[:lines]))


def test_a_run_without_changes_still_lists_tick_zero() -> None:
    head, _, changes = GOOD.partition("\n\n")
    tick_zero = "".join(line for line in changes.splitlines(keepends=True) if line.startswith("0 "))
    assert read(f"{head}\n\n{tick_zero}end 9\n").end == 9
    assert read(f"{head}\n\nend 0\n").end == 0
    with pytest.raises(TraceError, match=r":7: signal 'kmd' has no value at tick 0"):
        read(f"{head}\n\nend 9\n")


def test_the_longest_line_that_is_read() -> None:
    fits = "tick_hz " + "5" * (4096 - len("tick_hz \n"))
    assert read(GOOD.replace("tick_hz 500", fits)).header_value("tick_hz") == fits.split()[1]
    with pytest.raises(TraceError, match=":2: the line is longer than 4096"):
        read(GOOD.replace("tick_hz 500", fits + "5"))


def test_every_truncation_is_refused_or_loses_remarks_only() -> None:
    whole = read(GOOD)
    for length in range(len(GOOD) - len("# late 1\n") + 1, len(GOOD)):
        with pytest.raises(TraceError):
            read(GOOD[:length])
    without_remark = read(GOOD.removesuffix("# late 1\n"))
    assert (without_remark.end, without_remark.trailer) == (whole.end, ())
    for length in range(len(GOOD) - len("# late 1\n")):
        with pytest.raises(TraceError):
            read(GOOD[:length])


def test_what_is_not_utf8_is_refused_where_it_stands(tmp_path: Path) -> None:
    (tmp_path / "golden").write_bytes(GOOD.replace("tick_hz 500", "tick_hz 5\x00").encode("utf-16-le"))
    with pytest.raises(TraceError, match=":1: not a trace"):
        read_text(tmp_path / "golden")
    (tmp_path / "golden").write_bytes(GOOD.encode().replace(b"KMD_CZEKAJ", b"KMD_\xff"))
    with pytest.raises(TraceError, match=r":10: kmd: .* is no word") as caught:
        read_text(tmp_path / "golden")
    assert caught.value.file == str(tmp_path / "golden")
    str(caught.value).encode()  # the bad byte must not make the message unprintable


@pytest.mark.parametrize(
    ("limit", "reason"),
    [("SIGNALS_LIMIT", "more than 2 signals"), ("CHANGES_LIMIT", "more than 2 changes")],
)
def test_limits_are_named(limit: str, reason: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reader, limit, 2)
    with pytest.raises(TraceError, match=reason):
        read(GOOD)


def test_remarks_behind_the_end_are_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    """A stream of them need not end."""
    monkeypatch.setattr(reader, "REMARKS_LIMIT", 3)
    head = GOOD[: GOOD.rindex("end ")]
    last = next(line for line in GOOD.splitlines() if line.startswith("end "))
    assert len(read(f"{head}{last}\n" + "# x\n" * 3).trailer) == 3
    with pytest.raises(TraceError, match="more than 3 lines follow the end"):
        read(f"{head}{last}\n" + "# x\n" * 4)


def test_no_more_command_names_than_opcodes() -> None:
    commands = "".join(f"{tick} kmd 1:K{tick}\n" for tick in range(1, 65))
    head = "drillctl-trace 1\nsignal kmd <\n\n0 kmd -\n"
    read(head + commands.removesuffix("64 kmd 1:K64\n") + "end 99\n")
    with pytest.raises(TraceError, match=r":68: kmd: 'K64' is one name too many"):
        read(head + commands + "end 99\n")


@settings(max_examples=300, deadline=None)
@given(st.integers(0, len(GOOD)), st.integers(0, 12), st.text(max_size=6) | st.sampled_from(["\n", "0x", " "]))
def test_nothing_but_a_trace_error(start: int, length: int, put_in: str) -> None:
    """A file with a piece replaced is refused, or read as it stands: only remarks may differ when written."""
    text = GOOD[:start] + put_in + GOOD[start + length :]
    try:
        trace = read(text)
    except TraceError as error:
        assert 1 <= error.line <= text.count("\n") + 1
    else:
        again = io.StringIO()
        write_text(trace, again, derived=True)
        assert again.getvalue().partition("#")[0] == text.partition("#")[0]


LONG = GOOD[: GOOD.index("7 late")] + "".join(
    f"{tick} out.0 0x{tick % 7:08x}\n" + f"{tick} late {tick}\n" * (tick % 3 == 0) for tick in range(4, 60)
) + "end 60\n# late 1\n"  # fmt: skip


def outcome(text: str) -> Trace | str:
    """The trace in a text, or why and where it is refused."""
    try:
        return read(text)
    except TraceError as error:
        return str(error)


CHANGES = LONG[LONG.index("\n\n") + 2 :].splitlines()
DAMAGES = (
    *(lambda line, word=word: word + line for word in ("", "0", " ", "-", "x", "\u0663", "\udcff", "7 late 3\n", "\n")),
    *(lambda line, word=word: line + word for word in (" ", "0", "\n\n", "x" * 4096)),
    *(lambda line, digit=digit: line[:-1] + digit for digit in "0123456"),
    lambda line: line.replace(" ", "", 1), lambda line: line.replace(" out", " oat"), lambda line: "end 5",
    lambda line: f"{line}\n{line}", lambda line: line[:-1], lambda line: f"{line.partition(' ')[0]} late 4",
)  # fmt: skip


@settings(max_examples=250, deadline=None)
@given(
    st.integers(1, 400), st.integers(3, len(CHANGES) - 1), st.integers(0, 6), st.sampled_from(DAMAGES)
)  # fmt: skip
def test_pages_of_lines_are_read_as_single_lines_are(
    page: int, at: int, from_there: int, damage: Callable[[str], str]
) -> None:
    """Whatever is damaged or moved to another line, and wherever pages end: the same trace, or the same refusal."""
    other = CHANGES[max(at - from_there, 0)]
    text = LONG.replace(f"{CHANGES[at]}\n", f"{damage(other)}\n")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(text_lines, "PAGE_CHARACTERS", page)
        by_pages = outcome(text)
        patch.setattr(TextChanges, "_page", lambda changes, page: None)
        assert by_pages == outcome(text)


def test_a_page_of_changes_is_not_gone_through_line_by_line(monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[int] = []
    keep = TextChanges._keep
    monkeypatch.setattr(text_lines, "PAGE_CHARACTERS", 300)
    monkeypatch.setattr(TextChanges, "_keep", lambda self, *row: (kept.append(row[0]), keep(self, *row)))
    assert read(LONG).value_at("late", 59) == 57
    assert len(kept) < 30
