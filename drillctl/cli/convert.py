"""``drillctl convert FILE --to OUT``: a clean Excellon file, or a ``.kmd`` queue, from whatever was read; or a trace in
its other form.
"""

import argparse
import sys
from pathlib import Path

from drillctl.cli import jobs, options
from drillctl.language import known_words

QUEUE = ".kmd"
TRACES = (".trace", ".seg")
EXCELLON = (".drl", ".drd", ".xln", ".xnc", ".exc", ".ncd", ".txt")  # as CAD programs name drill files


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("convert", help="write a clean Excellon file or a queue", description=__doc__)
    verb.add_argument("file", type=Path, metavar="FILE", help="a drill file of any CAD program; a trace")
    to = f"OUT.kmd: a queue; OUT.trace, OUT.seg: a trace as text, in segments; {' '.join(EXCELLON)}: an Excellon file"
    verb.add_argument("--to", type=Path, required=True, metavar="OUT", help=to)
    verb.add_argument("--style", default="mm,decimal", metavar="F", help="of the Excellon file; default: %(default)s")
    part = "of a trace in segments: its first N ticks alone"
    verb.add_argument("--to-tick", type=options.up_to(10**12), metavar="N", help=part)
    options.add_machine(verb)
    jobs.add_job(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """The whole text is made first; then the file is written, or nothing is."""
    from drillctl.files.outputs import reserved

    ending = _ending(arguments.to)
    if ending in TRACES:
        return _trace(arguments)
    text, warnings = _queue(arguments) if ending == QUEUE else _excellon(arguments)
    with reserved([arguments.to], inputs=[arguments.file]) as (output,):
        for warning in warnings:
            print(f"drillctl: warning: {warning}", file=sys.stderr)
        assert output is not None
        output.write(lambda file: print(text, file=file, end=""))
    return 0


def _ending(out: Path) -> str:
    """What says which form is written. A name without an ending is an Excellon file: a pipe or a device has none.

    Raises OutputError for the ending of something else.
    """
    from drillctl.files.outputs import OutputError

    ending, known = out.suffix.lower(), (QUEUE, *TRACES, *EXCELLON)
    if ending and ending not in known:
        raise OutputError(f"{out}: {ending[:20]!r} is no ending that convert writes; {known_words(ending, known)}")
    return ending


def _trace(arguments: argparse.Namespace) -> int:
    """Segments as small as the tables at hand let them be."""
    from drillctl.files.outputs import reserved
    from drillctl.replay.replay import in_form_of
    from drillctl.replay.stimuli import machine_of
    from drillctl.replay.trace_files import read_trace, write_record

    trace = read_trace(arguments.file, arguments.to_tick)
    machine = machine_of(trace, arguments.file, options.library(arguments))
    with reserved([arguments.to], inputs=[arguments.file]) as (output,):
        assert output is not None
        write_record(in_form_of(arguments.to, trace, machine), output)
    return 0


def _queue(arguments: argparse.Namespace) -> tuple[str, list[str]]:
    from drillctl.generation.queues import queue_text

    job = jobs.load(arguments.file, jobs.recipe(arguments), options.machine(arguments))
    return queue_text(job), list(job.warnings)


def _excellon(arguments: argparse.Namespace) -> tuple[str, list[str]]:
    """The file's own coordinates, whatever was asked about placing: that is a machine's matter."""
    from drillctl.generation.drillfile import DrillFileError, read
    from drillctl.generation.drillfile.errors import Refusal
    from drillctl.generation.drillfile.write import write
    from drillctl.generation.errors import JobError
    from drillctl.generation.pcb_drill.board import file_warnings, refusal

    try:
        drill_file = read(arguments.file, fmt=arguments.format, after_end=arguments.after_end)
    except DrillFileError as error:
        raise refusal(arguments.file, error) from error
    try:
        data = write(drill_file, arguments.style)
    except Refusal as error:
        raise JobError([f"--style {arguments.style}: not understood; write for instance mm,decimal"]) from error
    except ValueError as error:
        raise JobError([f"--style {arguments.style}: {error}"]) from error
    return data.decode("ascii"), file_warnings(arguments.file, drill_file)
