"""The drawings of wires are those of the tables, and the pins that WIRING.md names in words are the drawn ones."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.support.scripts import script

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "WIRING.md").read_text("utf-8")
TABLES = sorted((ROOT / "tables" / "machines").glob("*.toml"))


wiring = script("docs/wiring.py")


@pytest.mark.parametrize("name", [file.stem for file in TABLES])
def test_a_drawing_is_that_of_the_tables(name: str) -> None:
    drawn = (ROOT / "docs" / "pictures" / f"wiring-{name}.svg").read_text("utf-8")
    assert drawn == wiring.drawing(wiring.machines()[name]), "run docs/wiring.py"
    assert f"(pictures/wiring-{name}.svg)" in PAGE


def test_every_bit_of_a_machine_is_drawn_once_with_its_wire() -> None:
    machine = wiring.machines()["pcb-drill"]
    svg = ElementTree.fromstring(wiring.drawing(machine))
    texts = [text.text for text in svg.iter("{http://www.w3.org/2000/svg}text")]
    lines = list(svg.iter("{http://www.w3.org/2000/svg}path"))
    assert len(lines) == sum(len(axis.wire_bits) for axis in machine.axes) + len(machine.sensors)
    z = machine.axes[2]
    first = texts.index("motor z: two-phase") + 1
    assert texts[first : first + 3] == ["D32", str(z.wire_bits[0]), z.phase.wires[0].name]


@pytest.mark.parametrize("name", ["mega-28byj48", "pcb-drill"])
def test_the_pins_of_the_page_are_the_drawn_ones(name: str) -> None:
    machine = wiring.machines()[name]
    board = wiring.board_of(machine)
    section = PAGE.partition(f"`--machine {name}`")[2].partition("\n**")[0]
    rows = dict(re.findall(r"^\| ([xyz]) \| (D.*) \|$", section, re.M))
    assert len(rows) == 3
    for axis in machine.axes:
        assert rows[axis.name].split(" | ") == [wiring.pin(board, board.outputs, bit) for bit in axis.wire_bits]
    sensors = dict(re.findall(r"`(\w_\w+)` (D\d+)", section))
    assert sensors == {each.name: wiring.pin(board, board.inputs, each.bit) for each in machine.sensors}
