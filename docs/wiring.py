"""Draws the wiring of every machine from its tables: card bit, pin, wire, motor or sensor. A test compares.

    python docs/wiring.py       writes docs/pictures/wiring-MACHINE.svg

Rule: a drawing has a row a wire, in the order of what it ends at, so that no two lines cross. Pins are an Arduino's: an
Uno's where the machine's card is one, a Mega's where the machine's bits fit on it, else none.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import escape

from drillctl.machine import Library, Machine, shipped_tables
from drillctl.portio.firmata_pins import MEGA, UNO, Board
from drillctl.portio.firmata_protocol import PORT_PINS

PICTURES = Path(__file__).resolve().parent / "pictures"
FIRST_ANALOG = {"Mega": 54, "Uno": 14}  # the pin that is printed A0
ROW, GAP, MARGIN, WIDTH = 18, 14, 20, 640
PIN_X, BIT_X, LINE_X, BOX_X, BOX_WIDTH = 20, 95, 165, 330, 290
HEAD_HEIGHT = 72
COLOURS = {"wire": "#1f5fa8", "forcing": "#b3261e", "output": "#6a3d9a", "input": "#2f7d4e"}
STYLE = "text { font: 12px sans-serif; fill: #1b1f24 } .small { fill: #57606a } .title { font-size: 16px } "
STYLE += "rect { fill: none; stroke: #57606a } rect.ground { fill: #ffffff; stroke: none }"


class Row(NamedTuple):
    """One line: the first bit of the card, how many bits it has, what the wire is called, and its colour."""

    bit: int
    bits: int
    name: str
    kind: str


class Box(NamedTuple):
    """What wires end at."""

    title: str
    rows: list[Row]


def boxes(machine: Machine) -> tuple[list[Box], list[Box]]:
    """The boxes at the outputs, and those at the inputs."""
    motors = []
    for axis in machine.axes:
        kinds = ("forcing" if wire.forcing else "wire" for wire in axis.phase.wires)
        wires = zip(axis.wire_bits, (wire.name for wire in axis.phase.wires), kinds, strict=True)
        rows = [Row(bit, 1, name, kind) for bit, name, kind in wires]
        motors.append(Box(f"motor {axis.name}: {axis.motor.name}", rows))
    others = [Row(bit, 1, name, "output") for name, bit in machine.outputs]
    others += [Row(word.bit, word.bits, word.name, "output") for word in machine.output_words]
    outputs = [*motors, Box("other outputs", others)]
    ends = [Row(each.bit, 1, f"{each.name}, reached: {each.active_level}", "input") for each in machine.sensors]
    rest = [Row(each.bit, 1, f"{each.name}, on: {each.active_level}", "input") for each in machine.inputs]
    rest += [Row(word.bit, word.bits, word.name, "input") for word in machine.input_words]
    inputs = [Box("limit sensors (inputs)", ends), Box("other inputs", rest)]
    return [box for box in outputs if box.rows], [box for box in inputs if box.rows]


def board_of(machine: Machine) -> Board | None:
    """The Arduino whose pins are drawn."""
    outputs, inputs = boxes(machine)
    fits = all(
        row.bit + row.bits <= PORT_PINS * len(ports)
        for side, ports in ((outputs, MEGA.outputs), (inputs, MEGA.inputs))
        for box in side
        for row in box.rows
    )
    return UNO if machine.configuration.card == "UNO" else MEGA if fits else None


def pin(board: Board | None, ports: tuple[int, ...], bit: int) -> str:
    """As it is printed on the board; empty without one."""
    if board is None:
        return ""
    number = PORT_PINS * ports[bit // PORT_PINS] + bit % PORT_PINS
    analog = number - FIRST_ANALOG[board.name]
    return f"D{number}" if analog < 0 else f"A{analog}"


def drawing(machine: Machine) -> str:
    """The SVG."""
    board = board_of(machine)
    outputs, inputs = boxes(machine)
    parts, y = [], HEAD_HEIGHT
    for side, ports in ((outputs, board.outputs if board else ()), (inputs, board.inputs if board else ())):
        for box in side:
            parts += _box(box, y, board, ports)
            y += ROW * (len(box.rows) + 1) + GAP
    size = f'width="{WIDTH}" height="{y + MARGIN}"'
    head = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y + MARGIN}" {size}>',
        f"<title>Wiring of {escape(machine.name)}</title><style>{STYLE}</style>",
        f'<rect class="ground" {size}/>',
        _text(PIN_X, 26, machine.name, "title"),
        _text(PIN_X, 56, f"{board.name} pin" if board else "", "small"),
        _text(BIT_X, 56, "card bit", "small"),
        _text(LINE_X, 56, "wire: 24 V red, outputs violet, inputs green", "small"),
    ]
    return "\n".join([*head, *parts, "</svg>", ""])


def _box(box: Box, y: int, board: Board | None, ports: tuple[int, ...]) -> Iterator[str]:
    height = ROW * (len(box.rows) + 1)
    yield f'<rect x="{BOX_X}" y="{y}" width="{BOX_WIDTH}" height="{height}" rx="4"/>'
    yield _text(BOX_X + 10, y + 14, box.title, "small")
    for number, row in enumerate(box.rows, 1):
        middle = y + ROW * number + ROW // 2
        last = f" to {row.bit + row.bits - 1}" if row.bits > 1 else ""
        yield _text(PIN_X, middle + 4, pin(board, ports, row.bit))
        yield _text(BIT_X, middle + 4, f"{row.bit}{last}")
        yield f'<path d="M{LINE_X} {middle}H{BOX_X}" stroke="{COLOURS[row.kind]}" stroke-width="2"/>'
        yield _text(BOX_X + 10, middle + 4, row.name)


def _text(x: int, y: int, words: str, kind: str = "") -> str:
    return f'<text x="{x}" y="{y}"{f" class={kind!r}" if kind else ""}>{escape(words)}</text>'


def machines() -> dict[str, Machine]:
    """Every machine that comes with the program."""
    library = Library((shipped_tables(),))
    return {name: library.machine(name) for name in library.machine_names()}


if __name__ == "__main__":
    for name, machine in machines().items():
        (PICTURES / f"wiring-{name}.svg").write_text(drawing(machine), "utf-8")
