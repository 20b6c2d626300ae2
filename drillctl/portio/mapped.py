"""A card whose outputs and inputs are in a mapped file, which outlives the process as a real card does.

After a crash the file shows what the coils were left with. Layout, little-endian 32-bit words: "DRIL", version 1, n
cards, flushes so far (modulo 2**32), n words of outputs, n words of inputs.

Rule: another driver is the card proper (with its plant, in the ticker's process); this one copies through to the file.
``read_map`` reads it without a driver.
"""

import mmap
import os
from dataclasses import dataclass
from pathlib import Path

from drillctl.files import system
from drillctl.files.inputs import read_start
from drillctl.language import Message, message_of
from drillctl.ports import CARD_BITS, SAFE_IMAGE, Driver, PortLayout, PortRefused, word

MAGIC = int.from_bytes(b"DRIL", "little")
VERSION = 1
WORD_BYTES = CARD_BITS // 8
MOST_CARDS = 4
_FLUSHES, _OUTPUTS = 3, 4  # places of words; the inputs follow the outputs
LARGEST_FILE_BYTES = WORD_BYTES * (_OUTPUTS + 2 * MOST_CARDS)


@dataclass(frozen=True)
class CardMap:
    """The content of a mapped card's file."""

    flushes: int
    outputs: int
    inputs: int


class MappedCard:
    """A driver (ports.Driver) around another one. The file is shared by all processes that inherit this."""

    def __init__(self, inner: Driver, file: Path, cards: int):
        """Makes the file, or takes one over that an earlier run left. Raises PortRefused for any other file."""
        self._inner, self._cards = inner, cards
        self._map = _mapped(file, _OUTPUTS + 2 * cards)
        self._words = memoryview(self._map).cast("I")
        self._words[:_OUTPUTS] = memoryview(_header(cards)).cast("I")
        self.safe()

    def latch(self) -> int:
        """Returns the inner card's inputs, and copies them to the file."""
        image = self._inner.latch()
        self._put(_OUTPUTS + self._cards, image)
        return image

    def flush(self, image: int) -> None:
        """Writes the image to the file, then to the inner card: the file has it even if the process dies between."""
        self._put(_OUTPUTS, image)
        self._words[_FLUSHES] = self._words[_FLUSHES] + 1 & 0xFFFF_FFFF
        self._inner.flush(image)

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Writes the safe image to the file, and drives the inner card with it."""
        self._put(_OUTPUTS, image)
        self._inner.safe(image)

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Closes file and inner card; the file stays, with the safe image."""
        if self._map.closed:
            return
        self._put(_OUTPUTS, image)
        self._words.release()
        self._map.close()
        self._inner.close(image)

    def _put(self, place: int, image: int) -> None:
        for card in range(self._cards):
            self._words[place + card] = word(image, card)


def open_mapped(address: str, layout: PortLayout, card: Driver) -> MappedCard:
    """Makes a simulated card with its image in the file ``ADDRESS``. Raises PortRefused."""
    if not address:
        raise PortRefused("mapped", Message("where should the card's image be? Name a file: mapped:FILE"))
    return MappedCard(card, Path(address), layout.cards)


def read_map(file: Path) -> CardMap:
    """Reads a mapped card's file, during a run or after it. Raises PortRefused for any other file, OSError for none."""
    data = read_start(file, LARGEST_FILE_BYTES + 1)
    words = memoryview(data[: len(data) // WORD_BYTES * WORD_BYTES]).cast("I")
    if not _is_map(words):
        raise PortRefused("mapped", Message("{file} exists and is not the image of a mapped card", file=file))
    cards = words[2]
    outputs, inputs = (_image(words[start : start + cards]) for start in (_OUTPUTS, _OUTPUTS + cards))
    return CardMap(words[_FLUSHES], outputs, inputs)


def _header(cards: int) -> bytes:
    return b"".join(value.to_bytes(WORD_BYTES, "little") for value in (MAGIC, VERSION, cards, 0))


def _is_map(words: memoryview) -> bool:
    if len(words) < _OUTPUTS or words[0] != MAGIC or words[1] != VERSION:
        return False
    return words[2] <= MOST_CARDS and len(words) == _OUTPUTS + 2 * words[2]


def _image(words: memoryview) -> int:
    return sum(value << CARD_BITS * card for card, value in enumerate(words))


def _mapped(file: Path, words: int) -> mmap.mmap:
    """Maps exactly so many words of a file, shared."""
    try:
        descriptor = _descriptor(file)
        try:
            _lock(descriptor, file)
            if os.fstat(descriptor).st_size:
                read_map(file)
            os.ftruncate(descriptor, words * WORD_BYTES)
            # Takes the room on the disk now: a mapped page without room is a bus error when it is first written.
            os.pwrite(descriptor, bytes(words * WORD_BYTES), 0)
            return mmap.mmap(descriptor, words * WORD_BYTES)
        finally:
            os.close(descriptor)
    except PortRefused:
        raise
    except OSError as error:
        raise PortRefused(
            "mapped", Message("can't be the card's file: {why}", why=message_of(error)).at(file)
        ) from error


def _descriptor(file: Path) -> int:
    """Opens the file that is there, or a new one; refuses a link."""
    flags = system.flags("O_RDWR", "O_NOFOLLOW", "O_CLOEXEC")
    try:
        return os.open(file, flags)
    except FileNotFoundError:
        return os.open(file, flags | os.O_CREAT | os.O_EXCL, 0o666)


def _lock(descriptor: int, file: Path) -> None:
    """Locks the file for this run. The map's own copy of the descriptor holds the lock in every process that inherits
    it.
    """
    try:
        system.lock(descriptor)
    except BlockingIOError as error:
        raise PortRefused("mapped", Message("another run is using this card").at(file)) from error
