"""``drillctl convert FILE --to OUT``: writes a drill file as clean Excellon or as a ``.kmd`` queue; a pattern as a part
program; a trace as text or in segments.
"""

import argparse
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import jobs, options, streams
from drillctl.cli.operating import waiting
from drillctl.language import Message, known_words, message_of

if TYPE_CHECKING:
    from drillctl.generation.waits import Waits
    from drillctl.trace import Segments

QUEUE, PART = ".kmd", ".sentences"
PATTERN = ".toml"
TEXT = ".trace"
SEGMENTS = ".seg"
TRACES = (TEXT, SEGMENTS)
GCODE = (".nc", ".ngc", ".gcode")
Writer = Callable[[argparse.Namespace], tuple[str, Sequence[str]]]  # gives the text and its warnings
EXCELLON = (".drl", ".drd", ".xln", ".xnc", ".exc", ".ncd", ".txt")  # as CAD programs name drill files


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("convert", help="write a clean Excellon file or a queue", description=__doc__)
    verb.add_argument("file", type=Path, metavar="FILE", help="a drill file; a trace; a pattern of holes (.toml)")
    to = (
        f"OUT.kmd: a queue; OUT{PART}: a part program; OUT.trace, OUT.seg: a trace as text, in segments; "
        f"{' '.join(GCODE)}: G-code; {' '.join(EXCELLON)}: an Excellon file"
    )
    verb.add_argument("--to", type=Path, required=True, metavar="OUT", help=to)
    verb.add_argument(
        "--style", metavar="F",
        help="of an Excellon file: its format, default mm,decimal; of G-code: grbl (default) or linuxcnc",
    )  # fmt: skip
    speed = "spindle speed in G-code, rev/min; default: %(default)s"
    verb.add_argument("--rev-min", type=options.up_to(1_000_000), default=10_000, metavar="N", help=speed)
    part = "write only the first N ticks of a trace in segments"
    verb.add_argument("--to-tick", type=options.up_to(10**12), metavar="N", help=part)
    options.add_machine(verb)
    jobs.add_job(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Makes the whole content first, then writes the file and says so; on an error nothing is written."""
    ending = _ending(arguments.to)
    if ending in TRACES:
        _trace(arguments)
    else:
        _text(arguments, _WRITERS.get(ending, _excellon))
    streams.note(f"{arguments.to} is written")
    return 0


def _text(arguments: argparse.Namespace, writer: Writer) -> None:
    """Writes what a writer makes, and its warnings."""
    from drillctl.files.outputs import reserved

    text, warnings = writer(arguments)
    with reserved([arguments.to], inputs=[arguments.file]) as (output,):
        for warning in warnings:
            streams.tell(f"warning: {warning}")
        assert output is not None
        output.write(lambda file: print(text, file=file, end=""))


def _ending(out: Path) -> str:
    """Returns the ending, which decides the form. A name without one is an Excellon file: a pipe or a device has none.

    Raises OutputError for the ending of something else.
    """
    from drillctl.files.outputs import OutputError

    ending, endings = out.suffix.lower(), (QUEUE, PART, *TRACES, *GCODE, *EXCELLON)
    if ending and ending not in endings:
        raise OutputError(
            Message(
                "{ending!r} is no ending that convert writes; {words}",
                ending=ending[:20],
                words=known_words(ending, endings),
            ).at(out)
        )
    return ending


def _trace(arguments: argparse.Namespace) -> None:
    """Writes a trace in its other form; segments as small as the tables at hand allow."""
    from drillctl.files.outputs import reserved
    from drillctl.generation.waits import reading
    from drillctl.replay.compare import in_form_of
    from drillctl.replay.header import machine_of
    from drillctl.trace import Segments
    from drillctl.trace.files import is_text, read_record, shortened, write_record

    library = options.library(arguments)
    with waiting() as wait:
        wait(reading(arguments.file.name))
        if arguments.to.suffix.lower() == SEGMENTS and is_text(arguments.file) and _text_as_segments(arguments, wait):
            return
        record = read_record(arguments.file)
        if isinstance(record, Segments) and arguments.to.suffix.lower() == TEXT:
            _segments_as_text(arguments, record)
            return
        trace = shortened(record, arguments.file, arguments.to_tick)
        machine = machine_of(trace, arguments.file, library)
        with reserved([arguments.to], inputs=[arguments.file]) as (output,):
            assert output is not None
            converted = in_form_of(arguments.to, trace, machine, wait)
            wait(Message("writing {name}", name=arguments.to.name))
            write_record(converted, output)


def _text_as_segments(arguments: argparse.Namespace, wait: "Waits") -> bool:
    """Writes a text trace in segments where the tables at hand make the same run of it, without having its changes in
    memory; returns whether it was so.
    """
    from drillctl.files.outputs import reserved
    from drillctl.replay.compare import segments_of_text
    from drillctl.trace.files import write_record

    segments = segments_of_text(arguments.file, arguments.to, options.library(arguments), wait)
    if segments is None:
        return False
    with reserved([arguments.to], inputs=[arguments.file]) as (output,):
        assert output is not None
        write_record(segments, output)
    return True


def _segments_as_text(arguments: argparse.Namespace, segments: "Segments") -> None:
    """Writes segments as text, some changes at a time, however many there are."""
    from drillctl.files.outputs import reserved
    from drillctl.trace.files import write_record

    part = segments if arguments.to_tick is None else segments.up_to(arguments.to_tick)
    with reserved([arguments.to], inputs=[arguments.file]) as (output,):
        assert output is not None
        write_record(part, output)


def _queue(arguments: argparse.Namespace) -> tuple[str, Sequence[str]]:
    from drillctl.generation.queues import queue_text

    job = jobs.load(arguments.file, jobs.job_setup(arguments), options.machine(arguments))
    return queue_text(job), job.warnings


def _part(arguments: argparse.Namespace) -> tuple[str, Sequence[str]]:
    """Returns a part program as text: of a pattern, of another part program, or of a workpiece."""
    from drillctl.generation.boiler_drum.part import part_of
    from drillctl.generation.boiler_drum.pattern import read_pattern
    from drillctl.generation.boiler_drum.text import part_text

    file = arguments.file
    if file.suffix.lower() == PATTERN:
        return part_text(read_pattern(file), file.name), ()
    part = part_of(file, options.machine(arguments), arguments.store)
    return part_text(part.sentences, file.name), ()


def _excellon(arguments: argparse.Namespace) -> tuple[str, Sequence[str]]:
    """Returns the drill file as text in its own coordinates, with its warnings; placing options don't apply."""
    from drillctl.generation.drillfile.errors import Complaint
    from drillctl.generation.drillfile.write import write
    from drillctl.generation.errors import JobError
    from drillctl.generation.pcb_drill.board import file_warnings

    drill_file = jobs.read_drill_file(arguments)
    try:
        data = write(drill_file, arguments.style or "mm,decimal")
    except Complaint as error:
        raise JobError(
            Message("not understood; write for instance mm,decimal").at(f"--style {arguments.style}")
        ) from error
    except ValueError as error:
        raise JobError(message_of(error).at(f"--style {arguments.style}")) from error
    return data.decode("ascii"), file_warnings(arguments.file, drill_file)


def _gcode(arguments: argparse.Namespace) -> tuple[str, Sequence[str]]:
    """Returns the board as G-code, placed and ordered as the options say."""
    from dataclasses import replace

    from drillctl.generation.gcode import DEFAULT_MILL_MM_MIN, gcode

    machine = options.machine(arguments)
    if machine.mill_mm_min is None:  # it is another machine that mills
        machine = replace(machine, mill_mm_min=DEFAULT_MILL_MM_MIN)
    job = jobs.load(arguments.file, jobs.job_setup(arguments), machine)
    lines = gcode(job, arguments.style or "grbl", arguments.rev_min, arguments.peck, arguments.spot)
    return "".join(f"{line}\n" for line in lines), job.warnings


_WRITERS: Mapping[str, Writer] = {QUEUE: _queue, PART: _part, **dict.fromkeys(GCODE, _gcode)}
