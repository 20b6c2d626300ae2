"""Whatever the bytes: a drill file or a DrillFileError, within a second (long run: benchmarks/drillfile_fuzz.py)."""

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.generation.drillfile import DrillFileError, decode, summary

FUZZER = Path(__file__).resolve().parents[3] / "benchmarks" / "drillfile_fuzz.py"


@pytest.fixture(scope="module")
def fuzzer() -> ModuleType:
    spec = importlib.util.spec_from_file_location("drillfile_fuzz", FUZZER)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


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


@pytest.mark.parametrize("seed", [1, 2])
def test_a_short_campaign(fuzzer: ModuleType, seed: int) -> None:
    verdicts, _, offences = fuzzer.campaign(1500, seed)
    assert not offences
    assert len(verdicts) > 10  # the inputs reach many different refusals, and some are read
    assert verdicts["read"] > 50
