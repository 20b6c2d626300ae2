"""What is refused, by which code, at which line, in what time; and that a message stays a message."""

import io
import json
import signal
import subprocess
import sys
import time
import tracemalloc

import pytest

from drillctl.generation.drillfile import DrillFileError, decode, read
from drillctl.generation.drillfile.errors import REFUSALS, TEXT_LIMIT, WARNINGS, Complaint, shorten
from drillctl.generation.drillfile.intake import READ_LIMIT, condense
from drillctl.generation.drillfile.program import COMMAND_LIMIT
from drillctl.generation.drillfile.rows import HOLE_LIMIT

HEADER = "M48\nMETRIC,TZ,000.000\nT1C0.8\nT2C1.0\n%\nT1\n"  # the body begins in line 7
SECONDS = 1.5
MEGABYTES = 150
BLANKS = b" " * (1 << 20)


def refusal(data: bytes | str, **options: object) -> DrillFileError:
    raw = data.encode("latin-1") if isinstance(data, str) else data
    with pytest.raises(DrillFileError) as caught:
        decode(raw, name="test.drl", **options)
    return caught.value


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("X1e3Y1.0", "bad-number"),
        ("XNaNY1.0", "bad-number"),
        ("X1.0Y", "bad-number"),
        ("X1.2.3Y1.0", "bad-number"),
        ("X1.0Y1.0G85", "bad-number"),
        ("X1.0X2.0", "duplicate-axis"),
        ("X99999999999999999999Y1.0", "coordinate-out-of-range"),
        ("X6000.0Y1.0", "coordinate-out-of-range"),
        ("T7", "undefined-tool"),
        ("T", "bad-tool-number"),
        ("T-1", "bad-tool-number"),
        ("T12345", "bad-tool-number"),
        ("T3C-0.8", "bad-diameter"),
        ("T3Cinf", "bad-diameter"),
        ("M123", "unknown-command"),
        ("G77", "unknown-command"),
        ("drill here", "unknown-command"),
        ("M97,TEXT", "unsupported-command"),
        ("G84X1.0", "unsupported-command"),
        ("X1.0G84", "unsupported-command"),
        ("R3X1.0", "repeat-without-hole"),
        ("M02X1.0", "pattern-without-start"),
        ("T0\nX1.0Y1.0", "no-tool-selected"),
        ("X1.0Y1.0\nR0X1.0", "bad-repeat-count"),
        ("X1.0Y1.0\nR-2X1.0", "bad-repeat-count"),
        ("X1.0Y1.0\nR2", "repeat-without-offset"),
        ("M25\nM25", "bad-pattern"),
        ("M25\nM02X1.0", "bad-pattern"),
        ("X1.0Y1.0\n" + "X" * 5000, "line-too-long"),
        (f"X1.0Y1.0\nR{HOLE_LIMIT}X1.0", "repeat-too-large"),
        (f"M25\nX1.0Y1.0\nM01\nR{HOLE_LIMIT}M02X1.0", "repeat-too-large"),
    ],
)
def test_a_faulty_line(line: str, code: str) -> None:
    error = refusal(f"{HEADER}{line}\nM30\n")
    assert (error.code, error.line) == (code, 7 + line.count("\n"))
    assert str(error).startswith(f"test.drl:{error.line}: {code}")


@pytest.mark.parametrize(
    ("header", "code", "line"),
    [
        ("M48\nMETRIC\nINCH\n", "contradictory-units", 3),
        ("M48\nMETRIC\nM72\n", "contradictory-units", 3),
        ("M48\nMETRIC\nT1C0.8\nT1C0.9\n", "tool-redefined", 4),
        ("M48\nMETRIC\nT1C0.0\n", "bad-diameter", 3),
        ("M48\nMETRIC\nT1C9999\n", "bad-diameter", 3),
    ],
)
def test_a_faulty_header(header: str, code: str, line: int) -> None:
    error = refusal(f"{header}%\nT1\nX1.0Y1.0\nM30\n")
    assert (error.code, error.line) == (code, line)


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (b"", "empty-file"),
        (b"\n \r\n\t", "empty-file"),
        (b"; only a comment\n", "empty-file"),
        (b"\x00" * 1000, "empty-file"),
        (b"PK\x03\x04 zip", "archive"),
        (b"\x1f\x8b gzip", "archive"),
        (b"\x00" * 257 + b"ustar", "archive"),
        (b"\x89PNG\r\n\x1a\n", "not-text"),
        (b"\xff\xd8\xff\xe0 jpeg", "not-text"),
        (b"%PDF-1.4\n", "not-text"),
        (b"M48\nMETRIC\x00\n", "not-text"),
        (b"%FSLAX24Y24*%\n%MOIN*%\n", "gerber-not-drill"),
        (b"G04 layer*\nX0Y0D02*\n", "gerber-not-drill"),
        (b"G21\nG90\nG0 X1 Y1\nG1 Z-2\n", "gcode-not-drill"),
        (b"N10 G1 X1 Y2 Z-1.5\n", "gcode-not-drill"),
        (b"IN;SP1;PU100,100;", "hpgl-not-drill"),
        (b"  0\nSECTION\n  2\nHEADER\n", "not-a-drill-file"),
        (b"<!DOCTYPE html>\n<html>\n", "not-a-drill-file"),
        (b'{"holes": []}\n', "not-a-drill-file"),
        (b"(kicad_pcb (version 20171130)\n", "not-a-drill-file"),
        (b"Dear board house,\nplease drill.\n", "not-a-drill-file"),
        (b"NCDrill File Report For: b.pcb\nT1 31mil (0.7874mm) 12\n", "tool-report-not-drill"),
    ],
)
def test_other_files(data: bytes, code: str) -> None:
    assert refusal(data).code == code


HUGE = 40_000_000
# Made when they are used: together they are 165 MB, and every process that runs tests imports this module.
BOMBS = {
    "a long number": (lambda: HEADER.encode() + b"X" + b"1" * HUGE, "line-too-long"),
    "a picture": (lambda: b"\x89PNG" + b"\x00" * HUGE, "not-text"),
    "prose": (lambda: b"hello world\n" * (HUGE // 12), "file-too-large"),
    "holes": (lambda: HEADER.encode() + b"X1Y1\n" * (HOLE_LIMIT + 1), "too-many-holes"),
    "commands": (lambda: HEADER.encode() + b"G05\n" * (COMMAND_LIMIT + 1), "file-too-large"),
    "comments": (lambda: b";\n" * (HUGE // 20), "file-too-large"),
    "repeats": (lambda: HEADER.encode() + b"X1Y1\n" + b"R9999X1\n" * 2000, "repeat-too-large"),
    "patterns": (lambda: HEADER.encode() + b"M25\nX1Y1\nR9999X1\nM01\n" + b"R9M02X1\n" * 20_000, "repeat-too-large"),
    "brackets": (lambda: b"M48\n" + b"(" * HUGE, "line-too-long"),
}


@pytest.mark.parametrize("name", BOMBS)
def test_bombs_are_refused_soon_and_small(name: str, tmp_path) -> None:
    make, code = BOMBS[name]
    data = make()
    path = tmp_path / "bomb.drl"
    path.write_bytes(data)
    tracemalloc.start()
    with pytest.raises(DrillFileError) as caught:
        read(path)
    peak_bytes = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    started = time.process_time()  # apart: tracing memory costs time
    assert refusal(data).code == caught.value.code == code
    assert time.process_time() - started < SECONDS
    assert peak_bytes < MEGABYTES * 1e6 and len(str(caught.value)) < 300


class Endless(io.RawIOBase):
    """A stream that begins with ``head`` and goes on with ``rest`` for ever; it fails where nobody stops reading."""

    def __init__(self, head: bytes, rest: bytes):
        self._data, self._rest, self.bytes_read = head, rest, 0

    def readable(self) -> bool:
        return True

    def readinto(self, buffer) -> int:
        assert self.bytes_read < 2 * READ_LIMIT, "nobody stops reading"
        while len(self._data) < len(buffer):
            self._data += self._rest
        buffer[:], self._data = self._data[: len(buffer)], self._data[len(buffer) :]
        self.bytes_read += len(buffer)
        return len(buffer)


@pytest.mark.parametrize("head", [f"{HEADER}X1".encode(), f"{HEADER};".encode(), b"\xff\xfe"], ids=["X", ";", "16"])
def test_a_line_without_end_is_read_up_to_a_limit(head: bytes) -> None:
    stream = io.BufferedReader(Endless(head, b" \0" * 500_000 if head == b"\xff\xfe" else b" " * 1_000_000))
    with pytest.raises(Complaint) as caught:
        condense(stream)
    assert caught.value.code == "file-too-large"


def test_a_pipe_that_never_ends_is_refused() -> None:
    """Standard input may be a pipe, and what writes to it may never stop."""
    assert signal.getsignal(signal.SIGPIPE) is signal.SIG_IGN, "something lets a broken pipe end the tests' process"
    call = [sys.executable, "-m", "drillctl", "inspect", "--json", "/dev/stdin"]
    with subprocess.Popen(call, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as program:
        with pytest.raises(BrokenPipeError):
            program.stdin.write(HEADER.encode() + b"X1")
            for _ in range(2 * READ_LIMIT // len(BLANKS)):
                program.stdin.write(BLANKS)
        assert program.wait(60) == 2 and b"file-too-large" in program.stdout.read()
        program.stdin = None  # is broken; there is nothing to flush


def test_a_long_comment_is_only_cut() -> None:
    drill_file = decode(b"M48\n;" + b"x" * HUGE + b"\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0\nM30\n", name="long")
    assert [(remark.code, remark.line) for remark in drill_file.warnings] == [("line-too-long", 2)]
    assert drill_file.hole_line.tolist() == [7]


def test_several_problems_are_listed_the_first_is_raised() -> None:
    error = refusal(f"{HEADER}X1.0X2.0\nX1.0Y1.0\nM123\n" + "T9\n" * 100)
    assert [(problem.code, problem.line) for problem in error.problems[:3]] == [
        ("duplicate-axis", 7),
        ("unknown-command", 9),
        ("undefined-tool", 10),
    ]
    assert len(error.problems) == 20


def test_an_error_as_json() -> None:
    error = refusal(f"{HEADER}M123\n")
    assert json.loads(json.dumps(error.as_dict()))["error"] == {
        "code": "unknown-command",
        "line": 7,
        "text": "M123",
        "reason": error.reason,
    }


def test_messages_are_short_and_printable() -> None:
    assert shorten("a" * TEXT_LIMIT) == "a" * TEXT_LIMIT
    assert len(shorten("b" * 10**6)) == TEXT_LIMIT
    assert shorten("\x1b[31mred\n") == "?[31mred"


def test_a_code_is_a_refusal_or_a_warning() -> None:
    assert not set(REFUSALS) & set(WARNINGS)


def test_a_format_nobody_understands() -> None:
    assert refusal(HEADER + "X1Y1\nM30\n", fmt="furlong").code == "bad-format"
