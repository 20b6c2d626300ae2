"""Broken inputs for every reader: a short, seeded piece of benchmarks/fuzz_readers.py."""

import time
from pathlib import Path

import pytest

from benchmarks.fuzz_makers import Material
from benchmarks.fuzz_readers import Reader, campaign, readers
from drillctl.generation.errors import JobError

COUNT = 60
READERS = readers()


@pytest.mark.parametrize("name", READERS)
def test_a_reader_raises_its_own_error_or_none(name: str) -> None:
    score = campaign(READERS[name], COUNT, f"{name} 1")
    assert not score.offences
    assert score.read + score.refused == COUNT


@pytest.mark.parametrize("name", READERS)
def test_the_seeds_themselves_are_read(name: str, tmp_path: Path) -> None:
    """Else the inputs would not come far."""
    reader = READERS[name]
    for seed in reader.material.seeds:
        (tmp_path / f"seed{reader.suffix}").write_bytes(seed)
        try:
            reader.call(tmp_path / f"seed{reader.suffix}")
        except reader.errors:
            assert name in ("drill", "board")  # where some are refused for a reason, late


def test_an_input_that_breaks_a_reader_is_an_offence() -> None:
    broken = Reader(lambda file: 1 // 0, (JobError,), Material([b"seed"], [b"word"]))
    score = campaign(broken, 3, "1")
    assert len(score.offences) == 3 and "ZeroDivisionError" in score.offences[0]


def test_an_input_that_takes_long_is_an_offence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("benchmarks.fuzz_readers.SECONDS", 0.01)
    monkeypatch.setattr("benchmarks.fuzz_readers.GIVEN_UP_S", 0.05)

    def waits(_: Path) -> None:
        while time.process_time() > 0:
            pass

    score = campaign(Reader(waits, (JobError,), Material([b"seed"], [b"word"])), 1, "1")
    assert any("GivenUp" in offence for offence in score.offences)


def test_the_same_seed_makes_the_same_inputs() -> None:
    seen: list[bytes] = []
    reader = READERS["trace"]
    for _ in range(2):
        campaign(Reader(lambda file: seen.append(file.read_bytes()), (), reader.material), 5, "7")
    assert seen[:5] == seen[5:] and len(set(seen)) > 3
