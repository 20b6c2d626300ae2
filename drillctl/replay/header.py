"""What the header of a trace says of its run: machine, tables, plant and program; written and read here.

Rule: a header says enough to run the trace again. What it names and can't be found, or is no such thing, is refused.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.files.outputs import OutputError
from drillctl.generation.job import Job, names_of
from drillctl.kmd import KmdError, parse_program, program_texts
from drillctl.language import Message
from drillctl.machine import Library, Machine
from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ
from drillctl.plant import PlantChoice
from drillctl.ticker.link import Header
from drillctl.trace import Trace, TraceError
from drillctl.trace.text import COMMAND
from drillctl.trace.values import is_plain


def trace_header(job: Job, plant: Header) -> Iterator[tuple[str, str]]:
    """The header lines of a job's trace, made one by one, as most runs keep no trace. Its first line names the machine
    plainly; who writes the file replaces that by ``machine_named``.
    """
    yield from [("machine", job.machine.name), ("digest", job.machine.digest), ("tick_hz", str(job.machine.tick_hz))]
    yield from plant
    names = names_of(job.machine)
    for sequence, text in zip(job.program["sequence"].tolist(), program_texts(job.program, names), strict=True):
        yield "command", f"{sequence} {text}"


def machine_named(machine: Machine, file: Path) -> str:
    """How a trace in ``file`` names its machine: by name, or its file from there. Raises OutputError where it can't."""
    named = machine.reference_from(file.parent)
    if not is_plain(named):
        reason = Message(
            "a trace can't name {file}; give the machine's file and its folders plain names", file=machine.file
        )
        raise OutputError(reason.at(file))
    return named


def header_value(trace: Trace, key: str, file: Path) -> str:
    """The first value of a header key. Raises TraceError where there is none."""
    values = trace.header_values(key)
    if not values:
        raise TraceError(str(file), None, Message("the header has no {key!r} line", key=key))
    return values[0]


def machine_of(trace: Trace, file: Path, library: Library) -> Machine:
    """The machine that a trace names: one of the library's, or a file relative to the trace. Raises TraceError for the
    trace, TableError for the machine.
    """
    named = header_value(trace, "machine", file)
    beside = file.parent / named
    found = library.machine(str(beside) if named.endswith(".toml") else named)
    rate = header_value(trace, "tick_hz", file)
    if not rate.isdecimal() or not SLOWEST_TICK_HZ <= int(rate) <= FASTEST_TICK_HZ:
        raise TraceError(str(file), None, Message("tick_hz {rate!r} is no tick rate", rate=rate))
    return found.at_rate(int(rate))


def same_tables(trace: Trace, machine: Machine, file: Path) -> bool:
    """Whether a trace was recorded with the tables that ``machine`` has now."""
    return header_value(trace, "digest", file) == machine.digest


def choice_of(trace: Trace) -> PlantChoice:
    """The plant that a run was made on; ideal where the header names none. Raises PlantRefused."""
    described, seed = ("".join(trace.header_values(key)[:1]) for key in ("plant", "seed"))
    return PlantChoice.of_header(described, seed)


def check_tick(recorded: Trace, file: Path, tick: int) -> None:
    """Raises TraceError where a run has no such tick to begin at; every run has tick 0, even an empty one."""
    if tick and tick >= recorded.end:
        raise TraceError(
            str(file),
            None,
            Message("no tick {tick}: it has {end} ticks, counted from 0 (--from-tick)", tick=tick, end=recorded.end),
        )


def program_of(trace: Trace, machine: Machine, file: Path) -> NDArray[np.void]:
    """The program in a trace's header, dtype kmd.RECORD. Raises TraceError."""
    lines = trace.header_values(COMMAND)
    text = "\n".join(line.partition(" ")[2] for line in lines)
    try:
        program = parse_program(text, names_of(machine), str(file))
    except KmdError as error:
        raise TraceError(
            str(file), None, Message("command {line}: {reason}", line=error.line, reason=error.reason)
        ) from error
    counted = all(line.partition(" ")[0] == str(number) for number, line in enumerate(lines, 1))
    if len(program) != len(lines) or not counted:
        raise TraceError(str(file), None, Message("the commands are not numbered from 1 to a KMD_KONIEC"))
    return program
