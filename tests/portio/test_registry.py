"""The table of ports: names, addresses, rates that are refused before anything is opened; the verb that lists them."""

import json
import re
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.machine import Library, shipped_tables
from drillctl.portio.firmata import max_tick_hz
from drillctl.portio.firmata_pins import MEGA, UNO, Board, Pins
from drillctl.portio.mapped import MappedCard
from drillctl.portio.registry import PORTS, open_port, select
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import PortLayout, PortRefused, bits_of
from drillctl.ticker.launch import port_layout
from tests.portio.conformance import WIRING, StandInPlant

LIBRARY = Library((shipped_tables(),))
GUIDE = (Path(__file__).resolve().parents[2] / "docs" / "WIRING.md").read_text("utf-8")


def simulated() -> SimulatedCard:
    return SimulatedCard(StandInPlant())


@pytest.mark.parametrize(
    ("spec", "name", "address"),
    [
        ("simulated", "simulated", ""),
        ("firmata:/dev/ttyACM0@115200", "firmata", "/dev/ttyACM0@115200"),
        ("mapped:a:b", "mapped", "a:b"),
    ],
)
def test_name_and_address(spec: str, name: str, address: str) -> None:
    port, found = select(spec)
    assert (port.name, found) == (name, address)


@pytest.mark.parametrize("spec", ["", "lpt", "Simulated", ":x"])
def test_an_unknown_port_is_refused_with_those_there_are(spec: str) -> None:
    with pytest.raises(PortRefused, match="there are simulated, mapped, firmata"):
        select(spec)


def test_the_simulated_card_is_the_one_handed_in() -> None:
    card = simulated()
    assert open_port("simulated", WIRING, card) is card
    with pytest.raises(PortRefused, match="no address"):
        open_port("simulated:x", WIRING, card)


def test_the_mapped_card_is_put_around_it(tmp_path: Path) -> None:
    assert isinstance(open_port(f"mapped:{tmp_path / 'card'}", WIRING, simulated()), MappedCard)
    with pytest.raises(PortRefused, match="Name a file"):
        open_port("mapped", WIRING, simulated())


@pytest.mark.parametrize(("tick_hz", "baud", "most_hz"), [(609, "", 608), (1217, "@115200", 1216)])
def test_a_rate_that_a_line_cannot_carry_is_refused_with_the_one_it_can(tick_hz: int, baud: str, most_hz: int) -> None:
    too_fast = PortLayout(tick_hz, 0, WIRING.axis_outputs, 0, 0)
    with pytest.raises(PortRefused, match=f"{tick_hz} interrupts .* 3 axes moving; --tick-hz {most_hz} is the most"):
        open_port(f"firmata:/dev/null{baud}", too_fast)
    as_fast = PortLayout(most_hz, 0, WIRING.axis_outputs, 0, 0)
    with pytest.raises(PortRefused, match="can't be opened"):
        open_port(f"firmata:/dev/null{baud}", as_fast)


@pytest.mark.parametrize("name", LIBRARY.machine_names())
def test_a_machines_wiring_is_its_bits(name: str) -> None:
    machine = LIBRARY.machine(name)
    wiring = port_layout(machine)
    wires = [bit for axis in machine.axes for bit in axis.wire_bits]
    words = machine.output_words, machine.input_words
    numbers = [[bit for word in each for bit in bits_of(word.mask)] for each in words]
    assert bits_of(wiring.outputs) == sorted([*wires, *(bit for _, bit in machine.outputs), *numbers[0]])
    assert bits_of(wiring.inputs) == sorted([*(line.bit for line in machine.input_lines), *numbers[1]])
    assert wiring.cards == machine.cards


@pytest.mark.parametrize(("board", "name"), [(MEGA, "mega-28byj48"), (MEGA, "pcb-drill"), (UNO, "cnc-shield")])
def test_a_shipped_machine_fits_its_board_at_its_own_rate(board: Board, name: str) -> None:
    wiring = port_layout(LIBRARY.machine(name))
    Pins(board, wiring, "firmata")
    most_hz = max_tick_hz(board, "", wiring, range(len(wiring.axis_outputs)))
    assert most_hz is not None and wiring.tick_hz <= most_hz


def test_the_wiring_guide_has_the_pins_that_are_driven() -> None:
    """Its table of the Mega: bits, pins, bits, pins; a row is a port."""
    told = re.findall(r"(\d+)-(\d+) \| D(\d+)-D(\d+)", GUIDE)
    rows = [tuple(map(int, row)) for row in told]
    ports = [(8 * n, 8 * port) for board in (MEGA.outputs, MEGA.inputs) for n, port in enumerate(board)]
    assert sorted(rows) == sorted((bit, bit + 7, pin, pin + 7) for bit, pin in ports)


@pytest.mark.parametrize("name", ["mega-28byj48", "pcb-drill"])
def test_the_wiring_guide_has_the_wires_of_each_motor(name: str) -> None:
    """Its tables of wires: a column a wire, a row a motor."""
    for axis in LIBRARY.machine(name).axes:
        pins = [f"D{8 * MEGA.outputs[bit // 8] + bit % 8}" for bit in axis.wire_bits]
        assert f"| {axis.name} | {' | '.join(pins)} |" in GUIDE


def test_each_port_says_what_it_needs_and_why_not_here(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["ports", "--json"]) == 0
    told = {row["name"]: row for row in json.loads(capsys.readouterr().out)}
    assert told.keys() == PORTS.keys()
    for row in told.values():
        assert row["summary"] and row["needs"]
        assert row["usable"] == (row["reason"] is None)
    assert told["simulated"]["usable"] and told["mapped"]["usable"]


def test_the_list_for_a_person(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["ports"]) == 0
    paragraphs = capsys.readouterr().out.split("\n\n")
    assert [paragraph.split(":")[0].split("\n")[0] for paragraph in paragraphs] == list(PORTS)
