"""Throws broken inputs at every reader: nothing but its own error, and nothing slower than two seconds of CPU.

    python -m benchmarks.fuzz_readers [COUNT] [--seed N] [--reader NAME]...      10,000 inputs a reader by default

Most inputs are seeds with a few things changed: bits, bytes, words, lines and numbers, cuts, splices, nesting,
thousands of digits; of segments their blocks, packed again; of a journal what its lines say, sealed again. The others
are rows of words, or noise (fuzz_makers.py).
Prints, for each reader, how many inputs were read and how many refused, and the slowest; then every offence with the
bytes of its input, so that it can become a test.
"""

from __future__ import annotations

import argparse
import random
import signal
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType

from benchmarks.fuzz_journal import resealed_input
from benchmarks.fuzz_makers import EXTREMES, Material, Random, packed_input, text_input
from drillctl.console.recent_jobs import RecentJobs
from drillctl.generation import alignment, measured
from drillctl.generation.boiler_drum.pattern import read_pattern
from drillctl.generation.boiler_drum.stores import read_ram
from drillctl.generation.drillfile import DrillFileError, read, summary
from drillctl.generation.drills import read_drills
from drillctl.generation.errors import JobError
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.jobs.journal import Journal, JournalError, head_of, read_journal
from drillctl.machine import Library, TableError, shipped_tables
from drillctl.machine.source import Source
from drillctl.portio.gpiod_lines import read_line_map
from drillctl.portio.mapped import read_map
from drillctl.ports import PortLayout, PortRefused
from drillctl.replay.compare import taped_again
from drillctl.replay.header import machine_of, program_of
from drillctl.replay.player import playback
from drillctl.trace import Trace, TraceError, segment_bytes
from drillctl.trace.files import read_record, read_trace
from drillctl.trace.segment_file import MAGIC
from drillctl.viewmodel.jobs import Site

SECONDS = 2.0
GIVEN_UP_S = 5 * SECONDS
MOST_SHOWN = 500  # bytes of an input that is printed
EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
LIBRARY = Library((shipped_tables(),))
MACHINE = LIBRARY.machine("pcb-drill")
DRUM = LIBRARY.machine("boiler-drum")
SITE = Site("simulated", "free", "ideal")
WIRING = PortLayout(580, 0x2A0, (0b111,), 0, 0b11)

DRILL_SEEDS = (
    b"M48\n;FILE_FORMAT=4:4\nMETRIC,LZ\nT1F00S00C0.8\nT2C1.0\n%\nT01\nX0001Y00125\nY002\nX5G85Y6\nT2\nX01\nM30\n",
    b"%\r\nT1C0.031F200S100\r\nX005000Y012500\r\nX006000Y012500\r\nT2C0.040\r\nX010000Y020000\r\nM30\r\n",
    b"M48\nINCH,TZ,00.0000\nICI,ON\nT1C.01\n%\nG90\nT1\nX1Y1\nR5X1000\nM25\nX2Y2\nM01\nM02X100\nM08\nM30\n",
    b";T01 Holesize 1. = 8.0 Tolerance = +0.0/-0.0 PLATED MILS Quantity = 2\n%\nT01\nX00100000Y00125000\nM30\n",
    b"M48\nM71\nT1C0.8\n%\nG00X1.0Y1.0\nM15\nG02X2.0A1.0\nM16\nG05\nX 1,5 Y 2,5\nM72\nX1.0\nT0\nM30\nX1\n\x1a",
    bytes.fromhex("540708802304080823017680320b803707388007388054132080") * 3,
    (EXAMPLES / "blinker.drl").read_bytes(),
)
DRILL_WORDS = (
    *(b"/* */ M48 M30 M95 M71 M72 M25 M01 M02 M08 M15 M16 G85 G90 G91 G93".split()),
    *(b"M97,TEXT G00 G05 % T1 T2C0.8 T0 R3 R999999999".split()),
    *(b"X1 Y2 X-0.5 Y+12 X99999999999999999999 X. Xnan INCH,LZ METRIC,TZ,000.000".split()),
    *(b"ICI,ON ;FILE_FORMAT=9:9".split()),
    *(b"T99999 T1C1e9 T1C0 ( ) ; , \r \n \n \n \x00 \x1a \xff FORMAT={2:4/ absolute / inch / keep".split(b" ")),
)
KMD_WORDS = (
    b"KMD_GOTOXY 1 2", b"KMD_GOTOdXdY", b"KMD_RUCH x=1", b"KMD_CZEKAJ", b"KMD_PREDKOSC", b"KMD_KONIEC",
    b"KMD_WYJSCIE", b"KMD_LINIA", b"KMD_BAZA", b"x=", b"y=-1", b"#", b"=", *EXTREMES,
)  # fmt: skip
TRACE_WORDS = (
    b"signal out.0 >", b"signal kmd <", b"tick_hz 500", b"end 8", b"# x", b"command 1 KMD_KONIEC", b"0 kmd -",
    b"7 out.0 0x00000025", b"0 in.0 0x00000000", b"overrun 1", b"drillctl-trace 1", b"drillctl-trace 2",
)  # fmt: skip
TABLE_WORDS = (
    b"[", b"]", b"[[wire]]", b"[[state]]", b"[[axis]]", b"[[drill]]", b"=", b'"', b"'''", b"{", b"}", b"true",
    b"1979-05-27T07:32:00Z", b"name = 'a'", b"x.", b",", *EXTREMES,
)  # fmt: skip
SENTENCE_WORDS = (b"6F0100", b"8A9999", b"2", b"0000", b"#", b"\n", b"\xff", *EXTREMES)
STORE_WORDS = (b":00000001FF", b":10", b"FF", b"00C6", b"\n", b"drillctl-store 1 crc32 00000000", *EXTREMES)
JSON_WORDS = (b'{"begun": 1}', b'{"done": 1}', b'{"ended": "done"}', b"null", b"[]", b"{}", b'"', b"true", *EXTREMES)
DRILLS_SEED = b"""tolerance_mm = 0.05
[[drill]]
diameter_mm = 0.8
life_hits = 2000
used_hits = 150
[[drill]]
diameter_mm = 1.0
"""
HOLES_SEED = b"# file_x file_y machine_x machine_y\n0 0 10.5 20.25\n30 0 40.5 20.3\n0 20 10.4 40.2\n30 20 40.4 40.3\n"
MAP_SEED = b'chip = "/dev/gpiochip0"\noutputs = { 0 = 17, 1 = 27, 2 = 22 }\ninputs = { 0 = 5, 1 = 6 }\n'
CARD_SEED = b"".join(n.to_bytes(4, "little") for n in (int.from_bytes(b"DRIL", "little"), 1, 1, 7, 0, 3))
RECENT_SEED = b'{"recent":[{"file":"/a.drl","asked":{}}]}'
Make = Callable[[Random, Material], bytes]


@dataclass(frozen=True)
class Reader:
    """What is tried: the call, the errors that are its own, and how its inputs are made."""

    call: Callable[[Path], object]
    errors: tuple[type[Exception], ...]
    material: Material
    suffix: str = ""
    make: Make = text_input


def _trace(file: Path) -> object:
    """As replay reads it: whether it could be run at all."""
    kept = read_record(file)
    head = kept if isinstance(kept, Trace) else kept.rest
    machine = machine_of(head, file, LIBRARY)
    return program_of(head, machine, file), playback(head, machine, file), read_trace(file)


def _job(file: Path) -> object:
    return load_job(file, MACHINE, JobSetup("pcb-drill"))


def _measured(file: Path) -> object:
    return measured.parse(file.read_bytes(), name="holes")


def _line_map(file: Path) -> object:
    return read_line_map(str(file), WIRING)


def _journal(file: Path) -> object:
    account = read_journal(file)
    return account.holes_begun, JobSetup.of_journal(account.head.options, file)


def _segments(rng: Random, material: Material) -> bytes:
    return packed_input(rng, material, MAGIC)


def _files(folder: Path, pattern: str) -> list[bytes]:
    return [file.read_bytes() for file in sorted(folder.glob(pattern))]


def _short_traces() -> list[bytes]:
    return [data for data in _files(EXAMPLES / "traces", "*.trace") if len(data) < 30_000]


def _segment_seeds() -> list[bytes]:
    found = []
    for file in sorted((EXAMPLES / "traces").glob("*.trace")):
        trace = read_trace(file)
        found.append(segment_bytes(taped_again(trace, machine_of(trace, file, LIBRARY), file)))
    return found


def _journal_seed() -> bytes:
    """Of a board that was stopped after its first hole, gone on with, and cut off at its third."""
    options = JobSetup(machine="pcb-drill")
    job = load_job(EXAMPLES / "blinker.drl", MACHINE, options)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "journal"
        with closing(Journal(file, head_of(EXAMPLES / "blinker.drl", job, options.as_journalled()), SITE)) as journal:
            journal.begun(1)
            journal.done([1])
            journal.ended("stopped")
        with closing(Journal(file, read_journal(file), SITE)) as journal:
            journal.begun(2)
            journal.done([2])
            journal.begun(3)
        return file.read_bytes()


def _table(kind: str) -> Reader:
    seeds = _files(shipped_tables() / kind, "*.toml")
    return Reader(lambda file: LIBRARY.check_source(Source.read(file)), (TableError,), Material(seeds, TABLE_WORDS))


def readers() -> dict[str, Reader]:
    """Every reader by its name."""
    holes = Material([HOLES_SEED], (b"1", b"-0.5", b"#", b",", b"\n", *EXTREMES))
    boards, traces = Material(DRILL_SEEDS, DRILL_WORDS), (TraceError, TableError)
    return {
        "drill": Reader(lambda file: summary(read(file)), (DrillFileError,), boards),
        "board": Reader(_job, (JobError,), boards),
        "kmd": Reader(_job, (JobError,), Material(_files(EXAMPLES, "*.kmd"), KMD_WORDS), ".kmd"),
        "sentences": Reader(
            lambda file: load_job(file, DRUM, JobSetup("boiler-drum")),
            (JobError,),
            Material(_files(EXAMPLES, "*.sentences"), SENTENCE_WORDS),
            ".sentences",
        ),
        "pattern": Reader(
            read_pattern, (JobError, TableError), Material(_files(EXAMPLES, "drum-row.toml"), TABLE_WORDS), ".toml"
        ),
        "store": Reader(
            lambda file: read_ram(DRUM, file).damages(),
            (JobError,),
            Material(_files(shipped_tables() / "eprom", "*.hex"), STORE_WORDS),
        ),
        "trace": Reader(_trace, traces, Material(_short_traces(), TRACE_WORDS)),
        "segments": Reader(_trace, traces, Material(_segment_seeds(), TRACE_WORDS), make=_segments),
        "journal": Reader(
            _journal, (JournalError, JobError), Material([_journal_seed()], JSON_WORDS), make=resealed_input
        ),
        "phase": _table("phase"),
        "ramp": _table("ramp"),
        "motor": _table("motor"),
        "dynamics": _table("dynamics"),
        "machine": _table("machines"),
        "drills": Reader(read_drills, (JobError,), Material([DRILLS_SEED], TABLE_WORDS)),
        "align": Reader(alignment.load, (measured.AlignmentError,), holes),
        "measured": Reader(_measured, (measured.AlignmentError,), holes),
        "line map": Reader(_line_map, (PortRefused,), Material([MAP_SEED], TABLE_WORDS)),
        "mapped card": Reader(read_map, (PortRefused,), Material([CARD_SEED], [CARD_SEED[:8]])),
        "recent jobs": Reader(lambda file: RecentJobs(file).read(), (), Material([RECENT_SEED], JSON_WORDS)),
    }


@dataclass
class Score:
    """What came of one reader's inputs."""

    read: int = 0
    refused: int = 0
    slowest_s: float = 0.0
    offences: list[str] = field(default_factory=list)


def campaign(reader: Reader, count: int, seed: str) -> Score:
    """So many inputs for one reader; the seed is any text."""
    rng, score = Random(seed), Score()
    with tempfile.TemporaryDirectory() as folder, _given_up():
        file = Path(folder) / f"input{reader.suffix}"
        for _ in range(count):
            data = reader.make(rng, reader.material)
            file.write_bytes(data)
            score.slowest_s = max(score.slowest_s, _tried(reader, file, data, score))
    return score


def _tried(reader: Reader, file: Path, data: bytes, score: Score) -> float:
    """Seconds of CPU that one input took."""
    started = time.process_time()
    signal.setitimer(signal.ITIMER_PROF, GIVEN_UP_S)
    try:
        reader.call(file)
        score.read += 1
    except reader.errors as error:
        score.refused += 1
        if not str(error).strip():
            score.offences.append(f"refused without a word: {_shown(data)}")
    except BaseException as error:  # what is looked for
        if isinstance(error, KeyboardInterrupt):
            raise
        score.offences.append(f"{type(error).__name__}: {str(error)[:800]} for {_shown(data)}")
    signal.setitimer(signal.ITIMER_PROF, 0)
    seconds = time.process_time() - started
    if seconds > SECONDS:
        score.offences.append(f"{seconds:.2f} s for {_shown(data)}")
    return seconds


class GivenUp(BaseException):
    """An input took far too long; the text is where."""


@contextmanager
def _given_up() -> Iterator[None]:
    """An input that takes GIVEN_UP_S of CPU ends with an exception."""

    def end(_number: int, frame: FrameType | None) -> None:
        raise GivenUp("".join(traceback.format_stack(frame)[-3:]))

    before = signal.signal(signal.SIGPROF, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGPROF, before)


def _shown(data: bytes) -> str:
    return repr(data) if len(data) <= MOST_SHOWN else f"{data[:MOST_SHOWN]!r}... ({len(data)} bytes)"


def _lines(names: list[str], count: int, seed: int) -> Iterator[tuple[str, Score]]:
    every = readers()
    for name in names or every:
        yield name, campaign(every[name], count, f"{name} {seed}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", nargs="?", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6), help="default: a new one")
    parser.add_argument("--reader", action="append", default=[], metavar="NAME", help="only this one (repeatable)")
    arguments = parser.parse_args()
    print(f"{arguments.count} inputs a reader, --seed {arguments.seed}")
    offences = 0
    for name, score in _lines(arguments.reader, arguments.count, arguments.seed):
        offences += len(score.offences)
        told = f"{name:12} read {score.read:6d}  refused {score.refused:6d}  offences {len(score.offences):4d}"
        print(f"{told}  slowest {score.slowest_s * 1000:7.1f} ms of CPU", flush=True)
        print("\n".join(score.offences[:5]), end="\n" if score.offences else "")
    return 1 if offences else 0


if __name__ == "__main__":
    raise SystemExit(main())
