"""``drillctl run JOB``: drills a drill file, a ``.kmd`` queue, a part program, or a workpiece of a store."""

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import jobs, operating, options, streams
from drillctl.cli.holes_csv import write_holes
from drillctl.language import Message

if TYPE_CHECKING:
    from drillctl.files.outputs import Output
    from drillctl.generation.job import Job
    from drillctl.jobs.outcome import JobResult
    from drillctl.jobs.session import Session


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("run", help="drill a file or run a queue", description=__doc__)
    verb.add_argument("job", type=Path, metavar="JOB", help=jobs.JOB_HELP)
    options.add_machine(verb)
    options.add_running(verb)
    options.add_engine(verb)
    options.add_tools(verb)
    where = "write the job's journal here; default for paced runs: the user's state folder"
    verb.add_argument("--journal", type=Path, metavar="F", help=where)
    verb.add_argument("--trace", type=Path, metavar="F", help="write the run as a trace, for replay; F.seg: segments")
    verb.add_argument("--vcd", type=Path, metavar="F", help="write the run as VCD, for GTKWave or PulseView")
    options.add_results(verb)
    jobs.add_job(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Checks everything and reserves every output before the first tick; then runs the job and writes the results."""
    from drillctl.files.outputs import reserved, unwritten
    from drillctl.generation.errors import JobError
    from drillctl.jobs.session import Session
    from drillctl.machine import machine_hazards
    from drillctl.replay.header import machine_named
    from drillctl.ticker.launch import in_batches, pace_of
    from drillctl.trace.files import MOST_CARDS, takes_segments

    machine = options.machine(arguments)
    port = options.port(arguments, machine)
    running = options.running(arguments, port, bool(arguments.trace or arguments.vcd), bool(arguments.vcd))
    running = replace(running, engine=arguments.engine)
    if arguments.trace is not None:
        machine_named(machine, arguments.trace)  # raises where it could not be written afterwards
        taped = takes_segments(arguments.trace, machine.cards) or (in_batches(running) and machine.cards <= MOST_CARDS)
    else:
        taped = bool(arguments.vcd) and machine.cards <= MOST_CARDS  # for the VCD file: the smaller record
    running = replace(running, taped=taped)
    paced = pace_of(running) == "real"
    chosen = jobs.job_setup(arguments)
    job = jobs.load(arguments.job, chosen, machine)
    session = Session(job, running)
    if arguments.journal and not job.work:
        raise JobError(Message("only a drill file has a journal: of another job nobody knows where it may go on").at(
            arguments.job))  # fmt: skip
    if job.work and (paced or arguments.journal):
        session = session.journalled(arguments.job, arguments.journal, chosen)
    wanted = (arguments.trace, arguments.vcd, arguments.holes)
    read = (arguments.job, arguments.align, arguments.drills, arguments.store)
    inputs = (*read, *map(Path, machine.files), *session.files)
    with reserved(wanted, inputs) as (trace, vcd, holes):
        if paced or session.journal:
            _tell(session)
        for warning in (*machine_hazards(machine), *job.warnings):
            streams.tell(f"warning: {warning}")
        done = operating.operated(session, arguments)
        problems = unwritten(
            lambda: _write_trace(job, done, trace),
            lambda: _write_vcd(job, done, vcd),
            lambda: write_holes(job, done, holes),
        )
    return options.report_outcome(done, arguments.json, problems)


def _tell(session: "Session") -> None:
    """Prints where the job runs and where its journal is: the first line on standard error."""
    from drillctl.jobs.site import site_of

    journal = f"; journal {session.journal}" if session.journal else ""
    streams.note(f"{site_of(session.running)}{journal}")


def _write_trace(job: "Job", done: "JobResult", trace: "Output | None") -> None:
    from drillctl.replay.compare import in_form_of
    from drillctl.replay.header import machine_named
    from drillctl.trace import Trace
    from drillctl.trace.files import write_record

    record = done.trace
    if trace is not None and record is not None:
        if isinstance(record, Trace):  # of a run that was ticked; what can be derived is left out of both forms
            record = in_form_of(trace.path, record.only(lambda signal: not signal.derived), job.machine)
        named = machine_named(job.machine, trace.path)
        write_record(record.with_header([("machine", named), *record.header[1:]]), trace)


def _write_vcd(job: "Job", done: "JobResult", vcd: "Output | None") -> None:
    from drillctl.replay.recorded_vcd import write_recorded_vcd

    record = done.trace
    if vcd is not None and record is not None:
        vcd.write(lambda file: write_recorded_vcd(record, job.machine, file))
