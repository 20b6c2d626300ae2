"""Outputs summed up while a text trace is read: the checksum that the segments of the same run have."""

import io
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.trace import Recorder, Segments, Signal, Trace, segments, text_lines, text_summary, write_text
from drillctl.trace.text_summary import read_summary

ROWS = st.lists(st.tuples(st.integers(0, 400), st.integers(0, 2), st.integers(0, 3)), max_size=60)


def run(rows: list[tuple[int, int, int]], cards: int, end: int = 401) -> Trace:
    """A run of one or two cards and an input; equal rows are no changes."""
    outputs = [Signal(f"out.{card}", "word", stimulus=False) for card in range(cards)]
    recorder = Recorder([*outputs, Signal("in.0", "word", stimulus=True)])
    for tick, signal, value in sorted(rows):
        recorder.set(min(signal, cards), tick, value << 8 * signal)
    return recorder.finish(end, [("machine", "m")], ["remark"])


@settings(max_examples=60, deadline=None)
@given(ROWS, st.integers(1, 2), st.integers(20, 300), st.integers(1, 500))
def test_the_checksum_is_that_of_the_segments(
    rows: list[tuple[int, int, int]], cards: int, page: int, chunk: int
) -> None:
    trace, file = run(rows, cards), Path("x.trace")
    text = io.StringIO()
    write_text(trace, text)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(text_lines, "PAGE_CHARACTERS", page)
        patch.setattr(text_summary, "CHUNK_TICKS", chunk)
        patch.setattr("drillctl.files.inputs.opened", lambda path: io.BytesIO(text.getvalue().encode()))
        patch.setattr("drillctl.trace.reader.bytes_read", lambda file, advance: lambda: None)
        summary = read_summary(file)
    assert summary.rest == segments.without_outputs(trace)
    assert summary.of(Segments.of_trace(trace))
    other = run([*rows, (400, 0, 3), (400, 1, 2)], cards)
    assert summary.of(Segments.of_trace(other)) == (other == trace)
