"""The segment form: nothing is lost on the way to a file and back; an image at any tick; damage is refused."""

import tracemalloc
import zlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.trace import (
    Segments,
    Signal,
    Trace,
    TraceError,
    dense,
    is_segments,
    read_segments,
    segment_bytes,
)
from drillctl.trace.segment_file import COUNT, MAGIC, SUMS
from drillctl.trace.tapes import PERIOD, ImagePool, Tape, images

SIGNALS = (
    Signal("in.0", "word", True),
    Signal("out.0", "word", False),
    Signal("in.1", "word", True),
    Signal("out.1", "word", False),
    Signal("kmd", "command", False, names=("-", "KMD_CZEKAJ", "KMD_KONIEC")),
    Signal("fault", "name", False, names=("-", "RANGE")),
)
HEAD = b"drillctl-trace 1\nsignal out.0 >\n\nend 0\n"
MOST = (1 << 32, 1 << 32, 1 << 32, 1 << 32, 1, 2)


@st.composite
def traces(draw: st.DrawFn) -> Trace:
    end = draw(st.integers(1, 400))
    rows = draw(st.lists(st.tuples(st.integers(0, end - 1), st.integers(0, len(SIGNALS) - 1), st.integers(0, 1 << 40))))
    ticks, signal, values = (list(column) for column in zip(*rows, strict=True)) if rows else ([], [], [])
    values = [value % MOST[index] for value, index in zip(values, signal, strict=True)]
    header = [("machine", "m"), ("command", "1 KMD_CZEKAJ 5"), ("command", "2 KMD_KONIEC")]
    return Trace.of_changes(header, SIGNALS, ticks, signal, values, end, ["late 3"])


@settings(max_examples=60, deadline=None)
@given(trace=traces(), data=st.data())
def test_nothing_is_lost(trace: Trace, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory) -> None:
    file = tmp_path_factory.mktemp("seg") / "a.seg"
    segments = Segments.of_trace(trace)
    file.write_bytes(segment_bytes(segments))
    back = read_segments(file)
    assert is_segments(file) and back.like(segments) and back.header == trace.header
    assert back.trace() == trace
    assert segment_bytes(back) == file.read_bytes()
    tick = data.draw(st.integers(0, trace.end - 1))
    image = int(dense(trace, "out.0")[tick]) | int(dense(trace, "out.1")[tick]) << 32
    assert back.images(tick, tick + 1).tolist() == [image]


def test_commands_that_are_numbered_otherwise_keep_their_numbers(tmp_path: Path) -> None:
    header = [("command", "7 KMD_CZEKAJ 5"), ("command", "2 KMD_KONIEC")]
    trace = Trace.of_changes(header, SIGNALS, [], [], [], 3)
    (tmp_path / "a.seg").write_bytes(segment_bytes(Segments.of_trace(trace)))
    assert read_segments(tmp_path / "a.seg").trace() == trace


@settings(max_examples=100, deadline=None)
@given(
    slices=st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3 * PERIOD)), max_size=12),
    window=st.tuples(st.floats(0, 1), st.floats(0, 1)),
)
def test_tapes_against_arrays(slices: list[tuple[int, int]], window: tuple[float, float]) -> None:
    """Steady images 0 and 5, a strip that goes round, and one that doesn't."""
    pool = ImagePool(np.uint32)
    round_about, once = np.tile(np.arange(1, 8), 2 * PERIOD // 7 + 2), np.arange(100)
    kinds = [(pool.steady(0), PERIOD), (pool.steady(5), PERIOD)]
    kinds += [(pool.add(round_about), 7 * (PERIOD // 7 + 1)), (pool.add(once), PERIOD + 1)]
    wanted = []
    start, ticks, period = [], [], []
    for kind, length in slices:
        shown = min(length, 100) if kind == 3 else length
        start.append(kinds[kind][0])
        ticks.append(shown)
        period.append(kinds[kind][1])
        wanted.append([np.zeros(shown), np.full(shown, 5), np.arange(shown) % 7 + 1, once[:shown]][kind])
    whole = np.concatenate([np.zeros(0), *wanted]).astype(np.uint32)
    if not len(whole):
        return
    tape = Tape.of(*(np.array(column, np.int64) for column in (start, ticks, period)))
    first, end = sorted(int(part * (len(whole) - 1)) for part in window)
    lamp = Tape.steady(pool.steady(1 << 31), len(whole))
    out = images(pool.images, [tape, lamp], np.empty(end + 1 - first, np.uint32), first)
    assert np.array_equal(out, whole[first : end + 1] | np.uint32(1 << 31))


@pytest.mark.parametrize("cut", [0, 5, 19, 20, 21, 60, -1])
def test_a_file_cut_short_is_refused(tmp_path: Path, cut: int) -> None:
    data = segment_bytes(Segments.of_trace(Trace.of_changes([], SIGNALS, [0], [1], [7], 50)))
    (tmp_path / "a.seg").write_bytes(data[:cut])
    with pytest.raises(TraceError, match=r"a\.seg: (damaged|not segments)"):
        read_segments(tmp_path / "a.seg")


def test_an_image_that_was_changed_is_noticed(tmp_path: Path) -> None:
    segments = Segments.of_trace(Trace.of_changes([], SIGNALS, [0], [1], [7], 50))
    checksum, pool = segments.checksum, segments.pool.copy()
    pool[25] ^= 1
    other = Segments(segments.rest, segments.signals, pool, segments.tapes)
    assert other.checksum != checksum and not other.like(segments)
    object.__setattr__(other, "checksum", checksum)  # as a file that was tampered with says
    (tmp_path / "a.seg").write_bytes(segment_bytes(other))
    with pytest.raises(TraceError, match="checksum"):
        read_segments(tmp_path / "a.seg")


def packed(end: int, blocks: list[bytes]) -> bytes:
    """A file of these blocks, behind its sums: one tape."""
    whole = [SUMS.pack(end, 0, 32, 1, 0), *blocks]
    return MAGIC + zlib.compress(b"".join(COUNT.pack(len(block)) + block for block in whole))


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (packed(10, [bytes(400_000_000)]), "more than a file of its size has"),
        (packed(10, [HEAD, b"", bytes(4), COUNT.pack(1 << 40) + COUNT.pack(1) + bytes(8)]), "more than a file"),
        (packed(10, [HEAD, b"", bytes(4), COUNT.pack(1) + COUNT.pack((1 << 32) + 1) + bytes(8)]), "different values"),
        (packed(10**12, []), "at most 100000000"),
        (packed(10, []), "damaged"),
        (MAGIC + zlib.compress(COUNT.pack((1 << 63) + 5) + b"x"), "more than a file of its size has"),
        (MAGIC + zlib.compress(COUNT.pack((1 << 64) - 1) + b"x"), "more than a file of its size has"),
        (packed(10, [COUNT.pack(2)] * 9), "damaged"),
    ],
    ids=["400 MB", "2**40 rows", "2**32 values", "10**12 ticks", "no blocks", "2**63 bytes", "2**64 bytes", "no head"],
)
def test_what_claims_too_much_is_refused_before_it_is_made(data: bytes, reason: str, tmp_path: Path) -> None:
    (tmp_path / "a.seg").write_bytes(data)
    tracemalloc.start()
    with pytest.raises(TraceError, match=reason):
        read_segments(tmp_path / "a.seg")
    _, peak_bytes = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak_bytes < 100_000_000 + 10 * len(data)


@settings(max_examples=40, deadline=None)
@given(trace=traces(), data=st.data())
def test_the_first_ticks_are_those_of_the_whole_run(trace: Trace, data: st.DataObject) -> None:
    segments = Segments.of_trace(trace)
    assert segments.change_count == len(trace.ticks)
    end = data.draw(st.integers(1, trace.end))
    rows = trace.ticks < end
    part = segments.up_to(end).trace()
    assert part.end == end and np.array_equal(part.ticks, trace.ticks[rows])
    assert np.array_equal(part.values, trace.values[rows]) and np.array_equal(part.signal, trace.signal[rows])
