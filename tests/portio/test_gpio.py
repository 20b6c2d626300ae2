"""GPIO lines: the line map, one call a tick, and how lines are asked for (with a stand-in for the gpiod package)."""

import sys
from enum import Enum
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from drillctl.portio import gpiod_lines
from drillctl.portio.gpiod_lines import GpioLines, LineMap, open_gpio, read_line_map
from drillctl.ports import PortLayout, PortLost, PortRefused
from tests.portio.test_conformance import FakeRequest

WIRING = PortLayout(500, 0, (0b11,), 0b100, 0b10)
GOOD = 'chip = "/dev/gpiochip0"\noutputs = { 0 = 17, 1 = 27, 2 = 22, 3 = 4 }\ninputs = { 1 = 5 }\n'


def written(folder: Path, text: str) -> str:
    (folder / "lines.toml").write_text(text)
    return str(folder / "lines.toml")


def test_a_line_map_gives_the_machines_bits_and_no_others(tmp_path: Path) -> None:
    lines = read_line_map(written(tmp_path, GOOD), WIRING)
    assert lines == LineMap("/dev/gpiochip0", {0: 17, 1: 27, 2: 22}, {1: 5})


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("1 = 27, ", "", "outputs has no line for bit 1"),
        ("1 = 5", "0 = 5", "inputs has no line for bit 1"),
        ("1 = 5", "1 = 22", "two bits have the same line"),
        ("= 17", '= "17"', "no line for bit 0"),
        ("= 17", "= true", "no line for bit 0"),
        ("= 17", "= -1", "no line for bit 0"),
        ("inputs =", "input =", "chip, outputs and inputs, and nothing else"),
        ('"/dev/gpiochip0"', "0", "chip, outputs and inputs"),
        ("outputs = {", "outputs = 5 #", "no line for bit 0"),
        ("chip", "chip =", "no line map"),
    ],
)
def test_a_bad_line_map_is_refused(tmp_path: Path, old: str, new: str, reason: str) -> None:
    assert old in GOOD
    with pytest.raises(PortRefused, match=reason):
        read_line_map(written(tmp_path, GOOD.replace(old, new, 1)), WIRING)


@pytest.mark.parametrize("file", ["", "/nonexistent/lines.toml", "/"])
def test_no_line_map(file: str) -> None:
    with pytest.raises(PortRefused, match=r"Name a line map|can't be read"):
        read_line_map(file, WIRING)


def test_an_output_that_lets_go_is_a_lost_port() -> None:
    """As of a chip that was reset, whose lines are inputs again; a level that is pulled up reads wrong as well."""
    for image, level in ((0b110, "low"), (0b010, "high")):
        request = FakeRequest()
        card = GpioLines(request, LineMap("chip", {1: 2, 2: 3}, {0: 1}), ("low", "high"))
        for put in (0b100, 0, image):
            card.flush(put)
            card.latch()
        request.levels[3] = level
        with pytest.raises(PortLost, match="line 3 does not hold"):
            card.latch()


def test_a_chip_that_reads_its_outputs_as_low_is_no_lost_port() -> None:
    """The kernel lets a chip's driver do so."""

    class Blind(FakeRequest):
        def get_values(self, lines: list[int]) -> list[str]:
            return ["high" if line == 1 else "low" for line in lines]

    card = GpioLines(Blind(), LineMap("chip", {1: 2, 2: 3}, {0: 1}), ("low", "high"))
    for image in (0b110, 0, 0b010):
        card.flush(image)
        assert card.latch() == 1


def test_each_flush_is_one_call() -> None:
    request = FakeRequest()
    card = GpioLines(request, LineMap("chip", {0: 1, 1: 2, 2: 3}, {}), ("low", "high"))
    before = request.calls
    card.flush(0b101)
    assert request.calls == before + 1
    assert request.levels == {1: "high", 2: "low", 3: "high"}
    assert card.latch() == 0


def test_closing_gives_the_lines_back() -> None:
    request = FakeRequest()
    GpioLines(request, LineMap("chip", {0: 1}, {}), ("low", "high")).close()
    assert request.released


class Value(Enum):
    INACTIVE = 0
    ACTIVE = 1


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """A gpiod package that notes how lines are requested; its chip is there."""
    calls: list[Any] = []

    def request_lines(chip: str, config: dict[int, Any], consumer: str) -> FakeRequest:
        calls.append((chip, config, consumer))
        return FakeRequest()

    bias, direction = SimpleNamespace(PULL_UP="up"), SimpleNamespace(OUTPUT="out", INPUT="in")
    line = SimpleNamespace(Value=Value, Bias=bias, Direction=direction)
    package = SimpleNamespace(LineSettings=SimpleNamespace, request_lines=request_lines, line=line)
    monkeypatch.setitem(sys.modules, "gpiod", package)
    monkeypatch.setitem(sys.modules, "gpiod.line", line)
    monkeypatch.setattr(gpiod_lines, "missing", lambda: "")
    return calls


def test_outputs_are_asked_for_low_and_inputs_with_pull_up(tmp_path: Path, asked: list[Any]) -> None:
    card = open_gpio(written(tmp_path, GOOD), WIRING)
    ((chip, config, consumer),) = asked
    assert (chip, consumer) == ("/dev/gpiochip0", "drillctl")
    low = SimpleNamespace(direction="out", output_value=Value.INACTIVE)
    assert config == {17: low, 27: low, 22: low, 5: SimpleNamespace(direction="in", bias="up")}
    card.flush(0b001)
    card.close()


def test_a_chip_that_cannot_be_had_is_refused(
    tmp_path: Path, asked: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    def busy(*arguments: object) -> FakeRequest:
        raise OSError(16, "Device or resource busy")

    monkeypatch.setattr(sys.modules["gpiod"], "request_lines", busy)
    with pytest.raises(PortRefused, match=r"gpiochip0: Device or resource busy; see that"):
        open_gpio(written(tmp_path, GOOD), WIRING)


def test_without_the_package_it_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gpiod_lines, "find_spec", lambda name: None)
    with pytest.raises(PortRefused, match=r"pip install gpiod"):
        open_gpio(written(tmp_path, GOOD), WIRING)
