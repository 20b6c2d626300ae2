"""``drillctl run JOB``: drills a drill file or a ``.kmd`` queue on the simulated machine."""

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from drillctl.cli import jobs, options

if TYPE_CHECKING:
    from drillctl.desk import Run
    from drillctl.generation.job import Job
    from drillctl.outputs import Output


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("run", help="drill a file or run a queue", description=__doc__)
    verb.add_argument("job", type=Path, metavar="JOB", help="a drill file, or a queue of KMD commands (.kmd)")
    options.add_machine(verb)
    verb.add_argument("--trace", type=Path, metavar="F", help="write the run as a trace, for replay")
    verb.add_argument("--vcd", type=Path, metavar="F", help="write the run as VCD, for GTKWave or PulseView")
    verb.add_argument("--holes", type=Path, metavar="F", help="write the holes as the plant made them (CSV)")
    verb.add_argument("--json", action="store_true", help="print the outcome as one JSON object")
    jobs.add_job(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Everything is checked and every output reserved before the first tick."""
    from drillctl import desk
    from drillctl.generation.job import load_job
    from drillctl.interrupts import exit_code
    from drillctl.machine import machine_hazards
    from drillctl.outputs import reserved
    from drillctl.ui.progress import ProgressView

    machine = options.machine(arguments)
    job = load_job(arguments.job, machine, jobs.wishes(arguments), arguments.format)
    wanted = (arguments.trace, arguments.vcd, arguments.holes)
    inputs = (arguments.job, arguments.align, arguments.drills, *map(Path, machine.files))
    with reserved(wanted, inputs) as (trace, vcd, holes):
        for warning in (*machine_hazards(machine), *job.warnings):
            print(f"drillctl: warning: {warning}", file=sys.stderr)
        with ProgressView(sys.stderr) as view:
            done = desk.run(job, view.show, traced=bool(trace or vcd), derived=bool(vcd))
        _write(job, done, trace, vcd, holes)
    _print(done, arguments.json)
    if done.signal is not None:
        return exit_code(done.signal)
    return 1 if done.outcome.fault else 0


def _write(job: "Job", done: "Run", trace: "Output | None", vcd: "Output | None", holes: "Output | None") -> None:
    from dataclasses import replace

    from drillctl.sampler import vcd_layout
    from drillctl.trace import write_text, write_vcd

    kept = done.trace
    if trace is not None and kept is not None:
        named = job.machine.reference_from(trace.path.parent)
        header = [("machine", named), *kept.header[1:]]
        trace.write(lambda file: write_text(replace(kept, header=tuple(header)), file))
    if vcd is not None and kept is not None:
        vcd.write(lambda file: write_vcd(kept, file, vcd_layout(job.machine, with_plant=True)))
    if holes is not None:
        holes.write(lambda file: _holes_csv(done, file))


def _holes_csv(done: "Run", file: TextIO) -> None:
    print("tool,diameter_mm,x_mm,y_mm", file=file)
    for hole in done.holes:
        diameter = "" if hole.diameter_mm is None else f"{hole.diameter_mm:.4f}"
        print(f"{hole.tool},{diameter},{hole.x_mm:.4f},{hole.y_mm:.4f}", file=file)


def _print(done: "Run", as_json: bool) -> None:
    from drillctl.ui.summary import summary_lines

    if as_json:
        print(json.dumps(done.outcome.as_dict(), indent=2))
    else:
        print("\n".join(summary_lines(done.outcome)))
