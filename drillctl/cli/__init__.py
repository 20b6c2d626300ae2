"""Verbs and options. Rule: nothing heavy is imported before a verb is called; whatever the operator got wrong is
one line (a line a problem) on standard error, ``drillctl: FILE:LINE: reason``, and exit code 2.

    run.py      drill a file or a queue          resume.py    go on with what was cut off
    ports.py    what can be driven from here     estimate.py  what a job will take
    inspect.py  what a drill file says           convert.py   a clean file, or a queue, from it
    replay.py   traces again                     tables.py    machines, and checking tables
    latency.py  how punctual this computer is    options.py   machine and tables
    jobs.py     the options of a job         operating.py the operator at the terminal while a job runs
    screen.py   work at the machine; what no verb means      scope.py    a trace on the screen
    benches.py  the screens that edit and look             streams.py  standard streams that may be gone
    parsing.py  argparse, and the word that was meant        refusals.py  what was refused, told
    examples.py  two command lines for every verb's help
    sweep.py    thousands of variants of a machine         tune.py  the fastest ramp that loses nothing
    plot.py     what the motors did in a run     drawing.py   a picture in the terminal or in a file
"""

import sys
from collections.abc import Sequence

from drillctl import __version__
from drillctl.cli import (
    convert,
    estimate,
    inspect,
    latency,
    plot,
    ports,
    replay,
    resume,
    run,
    scope,
    screen,
    streams,
    sweep,
    tables,
    tune,
)  # fmt: skip
from drillctl.cli.examples import EXAMPLES
from drillctl.cli.parsing import Parser
from drillctl.cli.refusals import REFUSED, refuse
from drillctl.jobs.interrupts import caught, exit_code, leave

NOBODY_READS = 141  # as a shell has it for SIGPIPE
VERBS = (run, resume, estimate, inspect, convert, replay, tables, ports, latency, screen, scope, plot, sweep, tune)
DESCRIPTION = "Drives and simulates stepper-motor drilling machines."
EPILOG = (
    "exit: 0 done, 1 the machine stopped on a fault (replay: differs), 2 refused before anything moved, "
    "130 or 143 interrupted (Ctrl-C, SIGTERM), outputs off"
)


def parser() -> Parser:
    """The whole command line."""
    top = Parser("drillctl", description=DESCRIPTION, epilog=EPILOG)
    top.examples = EXAMPLES["drillctl"]
    top.add_argument("--version", action="version", version=f"drillctl {__version__}")
    verbs = top.add_subparsers(title="verbs", metavar="VERB", dest="verb", required=True)
    for verb in VERBS:
        verb.add(verbs)
    for name, one in top.verbs().items():
        for inner in (one, *one.verbs().values()):
            inner.examples = EXAMPLES[name]
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one verb; returns the exit code. Interrupted, the outputs are off: 130, or 143 on SIGTERM."""
    if sys.platform not in ("linux", "darwin"):
        print("drillctl: runs on Linux; on macOS and WSL for simulation. Not here.", file=sys.stderr)
        return REFUSED
    streams.prepare()
    words = _with_verb(sys.argv[1:] if argv is None else argv)
    try:
        arguments = parser().parse_args(words)
        with caught(leave):
            return streams.delivered(int(arguments.call(arguments)))
    except KeyboardInterrupt as stop:
        return exit_code(*stop.args)
    except BrokenPipeError:
        streams.silence(sys.stdout)
        return NOBODY_READS
    except Exception as error:
        return _refused(error, as_json="--json" in words)


def _with_verb(argv: Sequence[str]) -> Sequence[str]:
    """Without a verb the screen is meant; options alone are the screen's, but for those that only tell something."""
    alone = not argv or (argv[0].startswith("-") and argv[0] not in ("-h", "--help", "--version"))
    return ["screen", *argv] if alone else argv


def _refused(error: Exception, as_json: bool) -> int:
    try:
        return refuse(error, as_json)
    except BrokenPipeError:
        streams.silence(sys.stdout)
        return NOBODY_READS
