"""A small run by hand that every test of this room can start from: a move, the queue's end, a fault."""

from collections.abc import Callable

import pytest

from drillctl.trace import Recorder, Signal, Trace, pack_command

HEADER = (
    ("machine", "pcb-drill.toml"),
    ("digest", "0123abcd"),
    ("tick_hz", "500"),
    ("command", "KMD_GOTOdXdY 2 0"),
    ("command", "KMD_KONIEC"),
)
SIGNALS = (
    Signal("kmd", "command", stimulus=True, names=("-", "KMD_GOTOdXdY", "KMD_KONIEC")),
    Signal("in.0", "word", stimulus=True),
    Signal("out.0", "word", stimulus=False),
    Signal("fault", "name", stimulus=False, names=("-", "SOFT_LIMIT")),
    Signal("x.position", "count", stimulus=False, derived=True),
)
# (tick, signal, value): a move of two steps back (columns out at 6 and 10), then a fault
ROWS = (
    (0, "kmd", pack_command(1, 1)),
    (0, "in.0", 0x15),
    (6, "out.0", 0x25),
    (6, "x.position", -1),
    (10, "out.0", 0x05),
    (10, "x.position", -2),
    (11, "kmd", pack_command(2, 2)),
    (12, "kmd", 0),
    (13, "fault", 1),
)
END = 15


def record(rows: tuple[tuple[int, str, int], ...] = ROWS, end: int = END) -> Trace:
    """The trace of rows (tick, signal, value) over SIGNALS."""
    recorder = Recorder(SIGNALS)
    index = {signal.name: place for place, signal in enumerate(SIGNALS)}
    for tick, name, value in rows:
        recorder.set(index[name], tick, value)
    return recorder.finish(end, HEADER, ("summary one fault",))


@pytest.fixture
def trace() -> Trace:
    """The run above."""
    return record()


@pytest.fixture
def changed() -> Callable[..., Trace]:
    """The run above with rows put in, each instead of the row of the same tick and signal; or another end."""

    def build(*rows: tuple[int, str, int], end: int = END) -> Trace:
        by_place = {(tick, name): value for tick, name, value in (*ROWS, *rows)}
        kept = sorted((tick, name, value) for (tick, name), value in by_place.items() if tick < end)
        return record(tuple(kept), end)

    return build
