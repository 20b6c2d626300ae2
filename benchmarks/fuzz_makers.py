"""Broken inputs for every kind of file that is read: whole seeds with a few things changed, rows of words, noise.

Rule: everything comes from the generator that is handed in, so a seed gives the same inputs again. Used by
fuzz_readers.py.
"""

from __future__ import annotations

import random
import re
import struct
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass

Random = random.Random
NUMBER = re.compile(rb"\d+")
EXTREMES = (
    b"0", b"-1", b"2147483647", b"2147483648", b"4294967296", b"9223372036854775807", b"18446744073709551616",
    b"1000000000000", b"1e308", b"1e999", b"nan", b"inf", b"-inf",
    b"0x" + b"f" * 5000, b"9" * 6000, b"1." + b"3" * 5000,
)  # fmt: skip
NESTED = (b"[" * 100_000, b'{"a":' * 100_000, b"{a = " * 50_000, b"a." * 50_000, b"[[" * 50_000, b"(" * 5000)
BINARY = (b"\x00", b"\xff", b"\xfe\xff", b"\r", b"\x1a", b"\xc2\x9b", b"\xed\xa0\x80", b"\xe2\x80\xae", b"\x1b[2J")
COUNTS = (0, 1, 255, 4096, 1 << 20, 1 << 31, 1 << 32, 10**12, (1 << 63) - 1, 1 << 63, (1 << 64) - 1)


@dataclass(frozen=True)
class Material:
    """What inputs of one kind are made from: whole files, and words that mean something to its reader."""

    seeds: Sequence[bytes]
    words: Sequence[bytes]


def text_input(rng: Random, material: Material) -> bytes:
    """An input of a kind that is text."""
    return rng.choices((changed, row_of_words, noise), weights=(6, 2, 1))[0](rng, material)


def packed_input(rng: Random, material: Material, magic: bytes) -> bytes:
    """An input of a kind that is a line and then a zlib stream of blocks, each behind its length (u64)."""
    seed = rng.choice(material.seeds)
    if rng.random() < 0.3:
        return changed(rng, Material([seed], material.words))
    blocks = _blocks(zlib.decompress(seed[len(magic) :]))
    for _ in range(rng.randrange(1, 4)):
        at = rng.randrange(len(blocks))
        blocks[at] = rng.choice(BLOCK_CHANGES)(bytearray(blocks[at]), rng)
    lengths = [len(block) if rng.random() < 0.95 else rng.choice(COUNTS) for block in blocks]
    whole = b"".join(struct.pack("<Q", size) + block for size, block in zip(lengths, blocks, strict=True))
    return magic + zlib.compress(whole, 1) + rng.choice((b"", b"", b"rest"))


def changed(rng: Random, material: Material) -> bytes:
    """A seed with one to seven changes."""
    data = bytearray(rng.choice(material.seeds))
    for _ in range(rng.choice((1, 1, 1, 2, 3, 7))):
        rng.choice(CHANGES)(data, rng.randrange(len(data) + 1), rng, material)
    return bytes(data)


def row_of_words(rng: Random, material: Material) -> bytes:
    """Up to sixty words, with blanks, line ends or nothing between them."""
    words = (rng.choice(material.words) for _ in range(rng.randrange(1, 60)))
    return b"".join(word + rng.choice((b"", b"\n", b"\n", b" ")) for word in words)


def noise(rng: Random, _: Material) -> bytes:
    """Any bytes."""
    return rng.randbytes(rng.randrange(400))


def _replace(data: bytearray, at: int, rng: Random, _: Material) -> None:
    data[at : at + 1] = rng.randbytes(1)


def _flip_bit(data: bytearray, at: int, rng: Random, _: Material) -> None:
    if at < len(data):
        data[at] ^= 1 << rng.randrange(8)


def _delete(data: bytearray, at: int, rng: Random, _: Material) -> None:
    del data[at : at + rng.randrange(12)]


def _double(data: bytearray, at: int, rng: Random, _: Material) -> None:
    data[at:at] = data[at : at + rng.randrange(40)] * rng.randrange(1, 30)


def _insert_word(data: bytearray, at: int, rng: Random, material: Material) -> None:
    data[at:at] = rng.choice(rng.choice((material.words, BINARY)))


def _shuffle_lines(data: bytearray, _at: int, rng: Random, _: Material) -> None:
    lines = bytes(data).split(b"\n")
    rng.shuffle(lines)
    data[:] = b"\n".join(lines)


def _double_line(data: bytearray, _at: int, rng: Random, _: Material) -> None:
    lines = bytes(data).split(b"\n")
    lines.insert(rng.randrange(len(lines)), rng.choice(lines))
    data[:] = b"\n".join(lines)


def _other_number(data: bytearray, _at: int, rng: Random, _: Material) -> None:
    """One of the numbers is another one."""
    if numbers := list(NUMBER.finditer(bytes(data))):
        found = rng.choice(numbers)
        data[found.start() : found.end()] = rng.choice(EXTREMES)


def _cut(data: bytearray, at: int, _rng: Random, _: Material) -> None:
    del data[at:]


def _splice(data: bytearray, at: int, rng: Random, material: Material) -> None:
    """The rest of another seed follows."""
    other = rng.choice(material.seeds)
    data[at:] = other[rng.randrange(len(other) + 1) :]


def _nest(data: bytearray, at: int, rng: Random, _: Material) -> None:
    if rng.random() < 0.2:  # they are long
        data[at:at] = rng.choice(NESTED)


def _blanks(data: bytearray, at: int, rng: Random, _: Material) -> None:
    data[at:at] = rng.choice((b" ", b"\t", b"\n", b"#", b"0")) * rng.choice((1, 100, 5000))


CHANGES: tuple[Callable[[bytearray, int, Random, Material], None], ...] = (
    _replace, _replace, _flip_bit, _flip_bit, _delete, _double, _insert_word, _insert_word, _shuffle_lines,
    _double_line, _other_number, _other_number, _cut, _splice, _nest, _blanks,
)  # fmt: skip


def _blocks(data: bytes) -> list[bytes]:
    found, at = [], 0
    while at < len(data):
        size = struct.unpack_from("<Q", data, at)[0]
        found.append(data[at + 8 : at + 8 + size])
        at += 8 + size
    return found


def _other_count(block: bytearray, rng: Random) -> bytes:
    """A number of eight bytes, at the front as counts are, or anywhere."""
    at = rng.choice((0, 8, rng.randrange(len(block) + 1)))
    block[at : at + 8] = struct.pack("<Q", rng.choice(COUNTS))
    return bytes(block)


def _other_bytes(block: bytearray, rng: Random) -> bytes:
    for _ in range(rng.randrange(1, 4)):
        if block:
            block[rng.randrange(len(block))] = rng.randrange(256)
    return bytes(block)


def _other_size(block: bytearray, rng: Random) -> bytes:
    at = rng.randrange(len(block) + 1)
    return rng.choice((bytes(block[:at]), b"", bytes(block) * 2, bytes(block) + rng.randbytes(9), bytes(1 << 20)))


def _other_text(block: bytearray, rng: Random) -> bytes:
    return changed(rng, Material([bytes(block)], EXTREMES))


BLOCK_CHANGES: tuple[Callable[[bytearray, Random], bytes], ...] = (_other_count, _other_bytes, _other_size, _other_text)
