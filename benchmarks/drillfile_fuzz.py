"""Throws broken drill files at the reader: nothing but DrillFileError, nothing slower than a second.

    python benchmarks/drillfile_fuzz.py [COUNT] [--seed N]      100,000 inputs by default

Half of the inputs are seeds with bytes changed, lines shuffled, doubled and joined; the others are rows of
drill words, or plain noise. Prints the count of each verdict, the slowest input, and every offence in full.
"""

from __future__ import annotations

import argparse
import random
import time
from collections import Counter
from collections.abc import Callable

from drillctl.generation.drillfile import DrillFileError, decode, summary

SECONDS = 1.0
SEEDS = (
    b"M48\n;FILE_FORMAT=4:4\nMETRIC,LZ\nT1F00S00C0.8\nT2C1.0\n%\nT01\nX0001Y00125\nY002\nX5G85Y6\nT2\nX01\nM30\n",
    b"%\r\nT1C0.031F200S100\r\nX005000Y012500\r\nX006000Y012500\r\nT2C0.040\r\nX010000Y020000\r\nM30\r\n",
    b"M48\nINCH,TZ,00.0000\nICI,ON\nT1C.01\n%\nG90\nT1\nX1Y1\nR5X1000\nM25\nX2Y2\nM01\nM02X100\nM08\nM30\n",
    b";T01 Holesize 1. = 8.0 Tolerance = +0.0/-0.0 PLATED MILS Quantity = 2\n%\nT01\nX00100000Y00125000\nM30\n",
    b"M48\nM71\nT1C0.8\n%\nG00X1.0Y1.0\nM15\nG02X2.0A1.0\nM16\nG05\nX 1,5 Y 2,5\nM72\nX1.0\nT0\nM30\nX1\n\x1a",
    bytes.fromhex("540708802304080823017680320b803707388007388054132080") * 3,
)
WORDS = (
    *(b"/* */ M48 M30 M95 M71 M72 M25 M01 M02 M08 M15 M16 G85 G90 G91 G93".split()),
    *(b"M97,TEXT G00 G05 % T1 T2C0.8 T0 R3 R999999999".split()),
    *(b"X1 Y2 X-0.5 Y+12 X99999999999999999999 X. Xnan INCH,LZ METRIC,TZ,000.000".split()),
    *(b"ICI,ON ;FILE_FORMAT=9:9".split()),
    *(b"T99999 T1C1e9 T1C0 ( ) ; , \r \n \n \n \x00 \x1a \xff FORMAT={2:4/ absolute / inch / keep".split(b" ")),
)
Random = random.Random


def noise(rng: Random) -> bytes:
    return rng.randbytes(rng.randrange(400))


def words(rng: Random) -> bytes:
    count = rng.randrange(1, 60)
    return b"".join(rng.choice(WORDS) + rng.choice((b"", b"\n", b"\n", b" ")) for _ in range(count))


def mutated(rng: Random) -> bytes:
    data = bytearray(rng.choice(SEEDS))
    for _ in range(rng.randrange(1, 8)):
        at = rng.randrange(len(data) + 1)
        rng.choice(MUTATIONS)(data, at, rng)
    return bytes(data)


def _replace(data: bytearray, at: int, rng: Random) -> None:
    data[at : at + 1] = rng.randbytes(1)


def _delete(data: bytearray, at: int, rng: Random) -> None:
    del data[at : at + rng.randrange(12)]


def _double(data: bytearray, at: int, rng: Random) -> None:
    data[at:at] = data[at : at + rng.randrange(40)] * rng.randrange(1, 30)


def _insert_word(data: bytearray, at: int, rng: Random) -> None:
    data[at:at] = rng.choice(WORDS)


def _shuffle_lines(data: bytearray, at: int, rng: Random) -> None:
    lines = bytes(data).split(b"\n")
    rng.shuffle(lines)
    data[:] = b"\n".join(lines)


MUTATIONS = (_replace, _replace, _delete, _double, _insert_word, _insert_word, _shuffle_lines)
MAKERS: tuple[Callable[[Random], bytes], ...] = (mutated, mutated, words, noise)


def campaign(count: int, seed: int) -> tuple[Counter[str], float, list[str]]:
    """Verdicts by code, seconds of the slowest input, and offences (empty when all is well)."""
    rng = Random(seed)
    verdicts: Counter[str] = Counter()
    slowest, offences = 0.0, []
    for _ in range(count):
        data = rng.choice(MAKERS)(rng)
        started = time.process_time()
        try:
            summary(decode(data, name="fuzz"))
            verdicts["read"] += 1
        except DrillFileError as error:
            verdicts[error.code] += 1
        except Exception as error:  # what is looked for
            offences.append(f"{type(error).__name__}: {error} for {data!r}")
        seconds = time.process_time() - started
        slowest = max(slowest, seconds)
        if seconds > SECONDS:
            offences.append(f"{seconds:.2f} s for {data!r}")
    return verdicts, slowest, offences


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", nargs="?", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    verdicts, slowest, offences = campaign(arguments.count, arguments.seed)
    for code, times in verdicts.most_common():
        print(f"{times:8d} {code}")
    print(f"slowest input: {slowest * 1000:.1f} ms of CPU; offences: {len(offences)}")
    print("\n".join(offences[:20]))
    return 1 if offences else 0


if __name__ == "__main__":
    raise SystemExit(main())
