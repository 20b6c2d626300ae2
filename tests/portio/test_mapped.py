"""The mapped card: what is in its file while it runs, and after its process was killed."""

import errno
import os
import signal
import struct
from pathlib import Path

import pytest

from drillctl.portio.mapped import CardMap, MappedCard, read_map
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import PortRefused
from tests.portio.conformance import StandInPlant


def card_at(file: Path, cards: int = 1) -> tuple[MappedCard, StandInPlant]:
    plant = StandInPlant()
    return MappedCard(SimulatedCard(plant), file, cards), plant


def test_the_layout_is_as_written_down(tmp_path: Path) -> None:
    card, plant = card_at(tmp_path / "card", cards=2)
    plant.inputs = 0x0000_0007_0000_0030
    card.latch()
    card.flush(0x8000_0001_0000_0041)
    words = (1, 2, 1, 0x41, 0x8000_0001, 0x30, 0x07)
    assert (tmp_path / "card").read_bytes() == b"DRIL" + struct.pack("<7I", *words)
    assert read_map(tmp_path / "card") == CardMap(1, 0x8000_0001_0000_0041, 0x0000_0007_0000_0030)


def test_a_full_disk_is_refused_in_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Room that were missed at the first output only would be a bus error."""

    def full(*arguments: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "pwrite", full)
    with pytest.raises(PortRefused, match="can't be the card's file: No space left on device"):
        card_at(tmp_path / "card")


def test_the_plant_is_driven_too(tmp_path: Path) -> None:
    card, plant = card_at(tmp_path / "card")
    card.flush(0x41)
    assert plant.image == 0x41
    card.safe()
    assert plant.image == 0


def test_a_killed_process_leaves_its_outputs_in_the_file_until_somebody_makes_them_safe(tmp_path: Path) -> None:
    card, _ = card_at(tmp_path / "card")
    child = os.fork()
    if child == 0:
        card.flush(0x6F6F6F)
        os.kill(os.getpid(), signal.SIGKILL)
    os.waitpid(child, 0)
    assert read_map(tmp_path / "card").outputs == 0x6F6F6F
    card.safe()
    assert read_map(tmp_path / "card").outputs == 0


def test_the_file_of_an_earlier_run_is_taken_over_safe(tmp_path: Path) -> None:
    child = os.fork()
    if child == 0:
        earlier, _ = card_at(tmp_path / "card", cards=2)
        earlier.flush(0x41)
        os.kill(os.getpid(), signal.SIGKILL)
    os.waitpid(child, 0)
    card_at(tmp_path / "card", cards=1)
    assert read_map(tmp_path / "card") == CardMap(0, 0, 0)


def test_one_run_drives_a_card(tmp_path: Path) -> None:
    card, _ = card_at(tmp_path / "card", cards=2)
    card.flush(0x41)
    with pytest.raises(PortRefused, match="another run is using this card"):
        card_at(tmp_path / "card")
    assert read_map(tmp_path / "card").outputs == 0x41
    card.close()
    card_at(tmp_path / "card")


@pytest.mark.parametrize("content", [b"DRIL", b"something else", b"DRIL" + bytes(20), b"DRIL" + bytes(4000)])
def test_any_other_file_is_refused_and_kept(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "card").write_bytes(content)
    with pytest.raises(PortRefused, match="not the image of a mapped card"):
        card_at(tmp_path / "card")
    assert (tmp_path / "card").read_bytes() == content


def test_a_link_is_no_card(tmp_path: Path) -> None:
    (tmp_path / "mine").write_bytes(b"")
    for name, target in (("link", "mine"), ("dangling", "nowhere")):
        (tmp_path / name).symlink_to(tmp_path / target)
        with pytest.raises(PortRefused, match="symbolic link"):
            card_at(tmp_path / name)
    assert (tmp_path / "mine").read_bytes() == b"" and not (tmp_path / "nowhere").exists()


@pytest.mark.parametrize("place", ["no/such/folder/card", ".", "/dev/null"])
def test_a_place_where_no_file_can_be(tmp_path: Path, place: str) -> None:
    with pytest.raises(PortRefused, match="can't be the card's file"):
        card_at(tmp_path / place)


def test_closing_twice_does_no_harm(tmp_path: Path) -> None:
    card, _ = card_at(tmp_path / "card")
    card.close()
    card.close()
    assert read_map(tmp_path / "card").outputs == 0
