"""``drillctl magazine``: the record shown, what somebody has seen entered, wrong words refused with nothing changed."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.cli import main

Capture = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def own_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    return tmp_path


def magazine(capture: Capture, *words: str, code: int = 0) -> str:
    assert main(["magazine", *words]) == code
    told = capture.readouterr()
    return told.err if code else told.out


def test_what_somebody_has_seen_is_entered_and_shown(capsys: Capture, own_state: Path) -> None:
    assert "not written yet" in magazine(capsys, "list")
    magazine(capsys, "set", "spindle.3=tool.2", "place.2.3=empty", "spindle.1=unknown", "place.1=unknown")
    shown = magazine(capsys, "list").splitlines()
    assert {"spindle.1 = unknown", "spindle.2 = empty", "spindle.3 = tool.2"} <= set(shown)
    assert "place.1 = unknown (tool.1)" in shown
    assert any(line.startswith("place.2 = 2.1: full, 2.2: full, 2.3: empty") for line in shown)
    magazine(capsys, "fill")
    assert "unknown" not in magazine(capsys, "list")


@pytest.mark.parametrize(
    "wrong", ["", "spindle.3", "spindle.7=empty", "spindle.1=full", "spindle.1=tool.99", "place.99=full",
              "place.1.7=full", "place.1=new", "tool.99=new", "tool.1=empty", "tool.1.1=new", "place.1=tool.2"],
)  # fmt: skip
def test_what_can_not_be_meant_is_refused_and_nothing_is_written(wrong: str, capsys: Capture, own_state: Path) -> None:
    assert repr(wrong) in magazine(capsys, "set", "spindle.1=empty", wrong, code=2)
    assert list(own_state.rglob("*.magazine")) == []


def test_a_machine_without_a_magazine_is_refused(capsys: Capture) -> None:
    assert "pcb-drill has no magazine" in magazine(capsys, "list", "--machine", "pcb-drill", code=2)
