"""PCL-720 cards on ordinary files: addresses, several cards, cards that do not answer."""

import os
from pathlib import Path

import pytest

from drillctl.portio import pcl720
from drillctl.portio.pcl720 import Pcl720, card_bases, lock, open_pcl720
from drillctl.ports import PortLayout, PortLost, PortRefused
from tests.portio.conformance import WIRING

TWO_CARDS = PortLayout(500, 0x2A0, (0xFF,), 1 << 40, 1 << 63)


def registers(file: Path, size: int = 0x400) -> int:
    file.write_bytes(bytes(size))
    return os.open(file, os.O_RDWR)


def test_two_cards_are_one_image(tmp_path: Path) -> None:
    out, into = registers(tmp_path / "out"), registers(tmp_path / "in")
    cards = Pcl720(out, into, card_bases("", TWO_CARDS))
    cards.flush(0x8899AABB_CCDDEEFF)
    assert os.pread(out, 12, 0x2A0).hex(" ") == "ff ee dd cc 00 00 00 00 bb aa 99 88"
    os.pwrite(into, b"\x01\x02\x03\x04", 0x2A8)
    assert cards.latch() == 0x04030201_00000000
    cards.close()


def test_only_data_registers_are_written(tmp_path: Path) -> None:
    descriptor = registers(tmp_path / "out")
    os.pwrite(descriptor, b"\xee" * 0x400, 0)
    cards = Pcl720(descriptor, descriptor, (0x2A0,))
    cards.flush(0x12345678)
    assert {at for at, byte in enumerate(os.pread(descriptor, 0x400, 0)) if byte != 0xEE} == set(range(0x2A0, 0x2A4))
    cards.close()


def test_a_card_that_does_not_answer_is_lost(tmp_path: Path) -> None:
    cards = Pcl720(registers(tmp_path / "out"), registers(tmp_path / "in", 0x2A2), (0x2A0,))
    with pytest.raises(PortLost, match="no answer at 0x2a0"):
        cards.latch()
    cards.close()


def test_one_program_drives_the_cards(tmp_path: Path) -> None:
    first, second = registers(tmp_path / "port"), os.open(tmp_path / "port", os.O_RDWR)
    lock(first)
    with pytest.raises(PortRefused, match="another run"):
        lock(second)
    os.close(first)


def test_errors_of_the_port_are_errors_of_the_system(tmp_path: Path) -> None:
    descriptor = registers(tmp_path / "out")
    cards = Pcl720(descriptor, descriptor, (0x2A0,))
    os.close(descriptor)
    for call in (cards.latch, cards.safe, lambda: cards.flush(1)):
        with pytest.raises(OSError, match="Bad file descriptor"):
            call()


@pytest.mark.parametrize(
    ("address", "wiring", "bases"),
    [
        ("", WIRING, [0x2A0]),
        ("", TWO_CARDS, [0x2A0, 0x2A8]),
        ("300", WIRING, [0x300]),
        ("0x300,2E0", TWO_CARDS, [0x300, 0x2E0]),
    ],
)
def test_where_the_cards_are(address: str, wiring: PortLayout, bases: list[int]) -> None:
    assert card_bases(address, wiring) == bases


@pytest.mark.parametrize("address", ["ZAR1", "300,", "300,308", "FFFF", "-8", " "])
def test_what_is_no_address(address: str) -> None:
    with pytest.raises(PortRefused, match="pcl720"):
        card_bases(address, WIRING)


def test_a_computer_without_ports_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(pcl720, "DEVICE", str(tmp_path / "none"))
    with pytest.raises(PortRefused, match="this kernel was built without it"):
        open_pcl720("", WIRING)


def test_it_opens_what_the_kernel_gives(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    os.close(registers(tmp_path / "port"))
    monkeypatch.setattr(pcl720, "DEVICE", str(tmp_path / "port"))
    card = open_pcl720("", WIRING)
    card.flush(0xA5)
    assert (tmp_path / "port").read_bytes()[0x2A0] == 0xA5
    card.close()
    assert (tmp_path / "port").read_bytes()[0x2A0] == 0
