"""The Firmata driver on the real, unmodified StandardFirmata, down to the AVR's pins; only the silicon is simulated."""

import os
import random
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from drillctl.portio import firmata_pins
from drillctl.portio.firmata import FirmataCard, open_firmata
from drillctl.portio.firmata_protocol import PinState, query_pin
from drillctl.ports import PortLayout, PortLost, PortRefused, bits_of
from tests.firmware import board as boards
from tests.firmware.board import SimulatedBoard, wait_until

pytestmark = [pytest.mark.paced, pytest.mark.skipif(bool(boards.missing()), reason=boards.missing())]

TICKS = 1_000
FEW_BYTES = 128  # waiting in the kernel
TICK_S = 0.002
LISTEN_S = 0.2


@dataclass(frozen=True)
class Case:
    """A board, a machine's wiring on it, and where each bit must come out, written down by hand."""

    kind: boards.Kind
    pinout: firmata_pins.Board
    wiring: PortLayout
    output_pins: dict[int, int]
    input_pins: dict[int, int]

    def all_output_pins(self) -> set[int]:
        """Those of all wires; the tests of single bits hold the board's table to what is written down by hand."""
        ports = self.pinout.outputs
        return {ports[bit // 8] * 8 + bit % 8 for bit in bits_of(self.wiring.outputs)}


PHASES = 0b0110_1111  # one motor's byte of the paper's Table 1
MEGA = Case(
    boards.MEGA,
    firmata_pins.MEGA,
    PortLayout(500, 0, (PHASES, PHASES << 8, PHASES << 16), 1 << 24, 0b11_0000_0011_1111),
    {0: 16, 1: 17, 6: 22, 8: 24, 14: 30, 16: 32, 22: 38, 24: 48},
    {0: 40, 5: 45, 12: 60, 13: 61},
)
UNO = Case(
    boards.UNO,
    firmata_pins.UNO,
    PortLayout(500, 0, (0b0010_0100 | 1 << 14, 0b0100_1000 | 1 << 15, 0b1001_0000 | 1 << 16), 1 << 12, 0b1110 << 8),
    {2: 2, 5: 5, 3: 3, 4: 4, 7: 7, 14: 14, 15: 15, 16: 16, 12: 12},
    {9: 9, 10: 10, 11: 11},
)


@pytest.fixture(scope="module", params=[MEGA, UNO], ids=["mega", "uno"])
def case(request: pytest.FixtureRequest) -> Case:
    return request.param


@pytest.fixture(scope="module")
def arduino(host: Path, case: Case, tmp_path_factory: pytest.TempPathFactory) -> Iterator[SimulatedBoard]:
    running = SimulatedBoard(host, case.kind, tmp_path_factory.mktemp(case.kind.name))
    yield running
    running.close()


@pytest.fixture
def card(arduino: SimulatedBoard, case: Case) -> Iterator[FirmataCard]:
    driver = open_firmata(case.pinout, arduino.device, case.wiring, LISTEN_S)
    yield driver
    driver.close()


def high_pins(arduino: SimulatedBoard, case: Case) -> set[int]:
    """The output pins that are high."""
    levels = arduino.levels()
    return {pin for pin in case.all_output_pins() if levels[pin]}


@pytest.mark.parametrize("first_level", [0, 1])
def test_a_new_card_is_safe_and_its_inputs_are_known_at_once(
    arduino: SimulatedBoard, case: Case, first_level: int
) -> None:
    """The first latch already has every level, on firmware 2.3 too, which reports only what is high."""
    wanted = 0
    for number, (bit, pin) in enumerate(case.input_pins.items()):
        level = first_level ^ number & 1
        arduino.set_input(pin, level)
        wanted |= level << bit
    driver = open_firmata(case.pinout, arduino.device, case.wiring, LISTEN_S)
    try:
        assert driver.latch() & sum(1 << bit for bit in case.input_pins) == wanted
        assert not high_pins(arduino, case)
    finally:
        driver.close()


def test_each_bit_comes_out_at_its_pin(arduino: SimulatedBoard, case: Case, card: FirmataCard) -> None:
    for bit, pin in case.output_pins.items():
        card.flush(1 << bit)
        wait_until(lambda: high_pins(arduino, case) == {pin}, f"bit {bit} at D{pin}")  # noqa: B023  # called at once
    card.flush(0)
    wait_until(lambda: not high_pins(arduino, case), "all low again")


def test_inputs_come_back(arduino: SimulatedBoard, case: Case, card: FirmataCard) -> None:
    for bit, pin in case.input_pins.items():
        for level in (0, 1, 0, 1):
            arduino.set_input(pin, level)
            wait_until(lambda: card.latch() >> bit & 1 == level, f"level {level} of D{pin} at bit {bit}")  # noqa: B023  # called at once


def test_writing_outputs_leaves_the_pull_ups_on(arduino: SimulatedBoard, case: Case, card: FirmataCard) -> None:
    """On the Uno outputs and inputs share a port, and a zero written to an input switches its pull-up off."""
    for image in (case.wiring.outputs, 0):
        card.flush(image)
        for pin in case.input_pins.values():
            assert card._line.answer(query_pin(pin), PinState) == PinState(pin, 0, state=1)


def test_every_update_arrives_in_its_order(arduino: SimulatedBoard, case: Case, card: FirmataCard) -> None:
    """Two seconds at 500 Hz, three motors at once: each message is seen at the pins, none lost, none merged."""
    time.sleep(0.1)
    since = len(arduino.changes())
    sent = list(flush_at_random(card, case))
    pins = case.all_output_pins()
    wait_until(lambda: arduino.port_updates(pins, since)[-1:] == sent[-1:], "the last update")
    time.sleep(0.1)
    assert arduino.port_updates(pins, since) == sent


def flush_at_random(card: FirmataCard, case: Case) -> Iterator[tuple[int, int]]:
    """So many ticks of images; yields (Firmata port, value) for each port that must change, in the order of ports.

    On a busy computer the simulated board is slower than a real one: the next image then waits for the line.
    """
    chance = random.Random(720)
    now, due_s = 0, time.monotonic()
    for _ in range(TICKS):
        image = chance.getrandbits(32) & case.wiring.outputs
        wait_until(lambda: card._line._serial.out_waiting < FEW_BYTES, "the board takes what was sent")
        card.flush(image)
        card.latch()
        for n, port in enumerate(case.pinout.outputs):
            new, old = image >> 8 * n & 0xFF, now >> 8 * n & 0xFF
            if new != old:
                yield port, new
        now = image
        due_s = max(due_s + TICK_S, time.monotonic())
        time.sleep(max(0.0, due_s - time.monotonic()))


def test_a_message_cut_short_does_not_spoil_the_safe_image(
    arduino: SimulatedBoard, case: Case, card: FirmataCard
) -> None:
    """As when the process that ticks is killed within a write, and another one makes the outputs safe."""
    card.flush(case.wiring.outputs)
    wait_until(lambda: high_pins(arduino, case) == case.all_output_pins(), "all outputs high")
    cut = bytes((0x90 | case.pinout.outputs[0], 0x7F))
    child = os.fork()
    if child == 0:
        card._line.send(cut)
        card.safe()
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0
    wait_until(lambda: not high_pins(arduino, case), "all outputs low")


def test_the_next_card_starts_safe_whatever_the_last_one_left(arduino: SimulatedBoard, case: Case) -> None:
    first = open_firmata(case.pinout, arduino.device, case.wiring, LISTEN_S)
    first.flush(case.wiring.outputs)
    wait_until(lambda: bool(high_pins(arduino, case)), "outputs high")
    first._line.close()
    second = open_firmata(case.pinout, arduino.device, case.wiring, LISTEN_S)
    assert not high_pins(arduino, case)
    second.close()


def test_two_cards_on_one_line_are_refused(arduino: SimulatedBoard, case: Case, card: FirmataCard) -> None:
    with pytest.raises(PortRefused, match="nobody else has it"):
        open_firmata(case.pinout, arduino.device, case.wiring, LISTEN_S)


def test_a_pulled_plug_is_a_lost_port(host: Path, case: Case, tmp_path: Path) -> None:
    arduino = SimulatedBoard(host, case.kind, tmp_path)
    try:
        driver = open_firmata(case.pinout, arduino.device, case.wiring)
        arduino.pull_the_plug()
        for call in (driver.latch, driver.safe, lambda: driver.flush(case.wiring.outputs)):
            with pytest.raises(PortLost, match="check cable and power"):
                call()
        driver.close()
    finally:
        arduino.close()
