"""The corpus of real and broken drill files, read in place; tests skip where it is not at hand."""

import json
from pathlib import Path

import pytest

CORPUS = Path(__file__).resolve().parents[4] / "shared" / "drill-files"


def corpus_entries(kind: str) -> list[dict]:
    """The entries of a corpus ('real', 'malformed') with a 'path' each; none where the corpus is absent."""
    index = CORPUS / kind / "index.json"
    if not index.exists():
        return []
    entries = json.loads(index.read_text())
    return [entry | {"path": CORPUS / kind / entry["file"]} for entry in entries]


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """`real` and `malformed` run once a corpus file; without the corpus there is one skipped test."""
    for kind in ("real", "malformed"):
        if kind in metafunc.fixturenames:
            entries = [entry for entry in corpus_entries(kind) if not entry.get("unsure")]
            absent = pytest.param(None, marks=pytest.mark.skip(reason=f"the corpus {CORPUS / kind} is not here"))
            metafunc.parametrize(kind, entries or [absent], ids=lambda entry: entry["file"] if entry else "absent")


@pytest.fixture(scope="session")
def real_files() -> list[dict]:
    """All sure entries of the real corpus; skips where it is absent."""
    entries = [entry for entry in corpus_entries("real") if not entry["unsure"]]
    if not entries:
        pytest.skip(f"the corpus {CORPUS / 'real'} is not here")
    return entries
