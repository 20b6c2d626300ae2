"""``drillctl run JOB``: drills a drill file or a ``.kmd`` queue."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import jobs, options

if TYPE_CHECKING:
    from drillctl.generation.job import Job
    from drillctl.wiring.desk import Run
    from drillctl.wiring.outputs import Output


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("run", help="drill a file or run a queue", description=__doc__)
    verb.add_argument("job", type=Path, metavar="JOB", help="a drill file, or a queue of KMD commands (.kmd)")
    options.add_machine(verb)
    options.add_running(verb)
    options.add_tools(verb)
    where = "keep the job's journal here; default for paced runs: the user's state folder"
    verb.add_argument("--journal", type=Path, metavar="F", help=where)
    verb.add_argument("--trace", type=Path, metavar="F", help="write the run as a trace, for replay")
    verb.add_argument("--vcd", type=Path, metavar="F", help="write the run as VCD, for GTKWave or PulseView")
    options.add_results(verb)
    jobs.add_job(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Everything is checked and every output reserved before the first tick."""
    from drillctl.generation.job import load_job
    from drillctl.machine import machine_hazards
    from drillctl.wiring.machinery import Running, pace_of
    from drillctl.wiring.outputs import reserved
    from drillctl.wiring.session import Session

    machine = options.machine(arguments)
    running = Running(arguments.port, arguments.pace, bool(arguments.trace or arguments.vcd), bool(arguments.vcd))
    paced = pace_of(running) == "real"
    job = load_job(arguments.job, machine, jobs.wishes(arguments), arguments.format)
    wanted = (arguments.trace, arguments.vcd, arguments.holes)
    inputs = (arguments.job, arguments.align, arguments.drills, *map(Path, machine.files))
    with reserved(wanted, inputs) as (trace, vcd, holes):
        for warning in (*machine_hazards(machine), *job.warnings):
            print(f"drillctl: warning: {warning}", file=sys.stderr)
        session = Session(job, running, tool_change=options.tool_change(arguments))
        if job.work and (paced or arguments.journal):
            session = session.journalled(arguments.job, arguments.journal, jobs.as_given(arguments))
        done = options.shown(session.run)
        _write(job, done, trace, vcd)
        options.write_holes(done, holes)
    return options.told(done, arguments.json)


def _write(job: "Job", done: "Run", trace: "Output | None", vcd: "Output | None") -> None:
    from dataclasses import replace

    from drillctl.trace import write_text, write_vcd
    from drillctl.wiring.sampler import vcd_layout

    kept = done.trace
    if trace is not None and kept is not None:
        named = job.machine.reference_from(trace.path.parent)
        header = [("machine", named), *kept.header[1:]]
        trace.write(lambda file: write_text(replace(kept, header=tuple(header)), file))
    if vcd is not None and kept is not None:
        with_plant = any(signal.name.startswith("plant.") for signal in kept.signals)
        vcd.write(lambda file: write_vcd(kept, file, vcd_layout(job.machine, with_plant)))
