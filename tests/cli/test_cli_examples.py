"""The two examples at the end of each verb's help: they are understood, and those that need no terminal run."""

import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.cli import main, parser
from drillctl.cli.examples import EXAMPLES

ROOT = Path(__file__).resolve().parents[2]
QUICK = (
    "drillctl", "run", "estimate", "inspect", "convert", "store", "replay", "machines", "tables", "parameters",
    "magazine", "ports", "plot", "report", "examples", "where", "completion",
)  # fmt: skip
BY_HAND = {"resume", "latency", "screen", "scope", "sweep", "tune", "grade"}  # a terminal, a cut-off job, seconds


def words(line: str) -> list[str]:
    first, *rest = shlex.split(line)
    assert first == "drillctl"
    return rest


def parsers() -> Iterator[tuple[str, str]]:
    """Each verb's name, and its help."""
    for name, verb in parser().verbs().items():
        for inner in (verb, *verb.verbs().values()):
            yield name, inner.format_help()


def test_every_verb_has_two_and_they_are_of_this_verb() -> None:
    assert set(EXAMPLES) == {"drillctl", *parser().verbs()}
    for verb, lines in EXAMPLES.items():
        assert len(set(lines)) == 2
        assert verb == "drillctl" or all(words(line)[0] == verb for line in lines)


def test_each_help_ends_with_them() -> None:
    for name, text in (*parsers(), ("drillctl", parser().format_help())):
        assert text.splitlines()[-3:] == ["examples:", *(f"  {line}" for line in EXAMPLES[name])]


@pytest.mark.parametrize("line", [line for lines in EXAMPLES.values() for line in lines])
def test_it_is_understood(line: str) -> None:
    parser().parse_args(words(line))


def test_they_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """One after the other in one folder: what one has written, a later one reads."""
    assert {*QUICK, *BY_HAND} == set(EXAMPLES)
    for name in ("examples", "tables"):
        (tmp_path / name).symlink_to(ROOT / name)
    monkeypatch.chdir(tmp_path)
    for verb in QUICK:
        for line in EXAMPLES[verb]:
            assert main(words(line)) == 0, f"{line}: {capsys.readouterr().err}"
