"""Whatever the bytes: a drill file or a DrillFileError, within a second (long run: benchmarks/fuzz_readers.py)."""

from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.generation.drillfile import DrillFileError, decode, summary


def survives(data: bytes) -> None:
    try:
        summary(decode(data, name="fuzz"))
    except DrillFileError as error:
        assert "\n" not in str(error) and len(str(error)) < 300


@settings(max_examples=300, deadline=1000)
@given(st.binary(max_size=300))
def test_bytes(data: bytes) -> None:
    survives(data)


@settings(max_examples=300, deadline=1000)
@given(st.text("XYTGMRC0123456789.,-+;%\n /*()", max_size=300))
def test_drill_letters(text: str) -> None:
    survives(b"M48\nMETRIC\nT1C0.8\n%\nT1\n" + text.encode())
