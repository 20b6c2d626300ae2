"""``drillctl estimate FILE``: how long a job will take, exact on the ideal plant, tool by tool."""

import argparse
from pathlib import Path

from drillctl.cli import jobs, options, streams
from drillctl.cli.operating import waiting
from drillctl.language import json_text


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("estimate", help="say how long a job will take", description=__doc__)
    verb.add_argument("job", type=Path, metavar="FILE", help=jobs.JOB_HELP)
    options.add_machine(verb)
    options.add_engine(verb)
    verb.add_argument("--json", action="store_true", help="print one JSON object")
    jobs.add_job(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Refuses whatever ``run`` would refuse; reports a job that would end in a fault (exit 1)."""
    from drillctl.jobs.estimate import estimate
    from drillctl.ui.terminal.reports import estimate_lines

    machine = options.machine(arguments)
    job = jobs.load(arguments.job, jobs.job_setup(arguments), machine)
    for warning in job.warnings:
        streams.tell(f"warning: {warning}")
    with waiting() as wait:
        estimated = estimate(job, arguments.engine, wait)
    print(json_text(estimated.as_dict(), 2) if arguments.json else "\n".join(estimate_lines(estimated)))
    return 1 if estimated.fault else 0
