"""The command line: verbs and options.

Rule: nothing heavy is imported before a verb is called. Whatever the operator got wrong is one line (a line a problem)
on standard error, ``drillctl: FILE:LINE: reason``, and exit code 2.

    run.py        drill a file or a queue              resume.py    go on with an interrupted job
    estimate.py   how long a job will take             inspect.py   what a drill file holds
    convert.py    a drill file as Excellon or queue    replay.py    traces run again and compared
    tables.py     machines, and checking tables        ports.py     the ports, and which can be used
    latency.py    how punctual ticks are               screen.py    the screen; drillctl without a verb
    scope.py      a trace on the screen                plot.py      pictures of a run
    report.py     a run as a page for a browser        store.py     stores of workpieces by number
    sweep.py      thousands of variants of a machine   tune.py      the fastest ramp that loses no steps
    grade.py      submissions of a lab sheet judged    parameters.py parameters of a machine, listed and set
    example_files.py  examples listed and copied       where.py     folders of tables, settings, journals
    completion.py verbs completed by a shell           table_files.py tables listed, shown and copied
    magazine.py   which tool is where in a machine

and what they share: options.py (machine, port, results), jobs.py (options of a job), operating.py (keys, progress and
tool changes while a job runs), part_programs.py (sentences in words), number_lists.py (440:640:20), board_trials.py
(--board of sweep and tune), drawing.py (a picture to a file or the terminal),
holes_csv.py (the table of holes), parsing.py (argparse with hints), verbosity.py (-q and -v), refusals.py (errors as
lines and JSON), streams.py (stdout and stderr), examples.py (for --help).
"""

import os
import sys
from collections.abc import Sequence

from drillctl import __version__
from drillctl.cli import (
    completion,
    convert,
    estimate,
    example_files,
    grade,
    inspect,
    latency,
    magazine,
    parameters,
    plot,
    ports,
    replay,
    report,
    resume,
    run,
    scope,
    screen,
    store,
    streams,
    sweep,
    tables,
    tune,
    verbosity,
    where,
)  # fmt: skip
from drillctl.cli.examples import EXAMPLES
from drillctl.cli.parsing import Parser
from drillctl.cli.refusals import refuse
from drillctl.jobs.interrupts import caught, exit_code, leave

NOBODY_READS = 141  # as a shell has it for SIGPIPE
VERBS = (
    run, resume, estimate, inspect, convert, store, replay, tables, parameters, magazine, ports, latency, screen, scope,
    plot, report, sweep, tune, grade, example_files, where, completion,
)  # fmt: skip
DESCRIPTION = "Drives and simulates stepper-motor drilling machines."
EPILOG = (
    "exit: 0 done, 1 the machine stopped on a fault (replay: differs), 2 refused before anything moved, "
    "130 or 143 interrupted (Ctrl-C, SIGTERM), outputs off"
)


def parser() -> Parser:
    """Returns the parser of the whole command line."""
    top = Parser("drillctl", description=DESCRIPTION, epilog=EPILOG)
    top.examples = EXAMPLES["drillctl"]
    top.add_argument("-V", "--version", action="version", version=f"drillctl {__version__}")
    verbs = top.add_subparsers(title="verbs", metavar="VERB", dest="verb", required=True)
    for verb in VERBS:
        verb.add(verbs)
    for name, one in top.verbs().items():
        for inner in (one, *one.verbs().values()):
            inner.examples = EXAMPLES[name]
            if not inner.verbs():
                verbosity.add(inner)
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one verb; returns the exit code. Interrupted, it leaves the outputs off: 130, or 143 on SIGTERM."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # numpy starts a thread a core for matrices, and none is here
    streams.prepare()
    words = _with_verb(sys.argv[1:] if argv is None else argv)
    try:
        with caught(leave):
            return streams.delivered(_called(words))
    except KeyboardInterrupt as stop:
        return exit_code(*stop.args)
    except BrokenPipeError:
        streams.silence(sys.stdout)
        return NOBODY_READS
    except Exception as error:
        return _refused(error, as_json="--json" in words)


def _called(words: Sequence[str]) -> int:
    """Calls the verb that the words name; returns its exit code. Raises SystemExit for --help and --version."""
    try:
        arguments = parser().parse_args(words)
    except SystemExit:
        streams.delivered(0)  # a reader that has gone is found out here, and not while the interpreter ends
        raise
    verbosity.set_from(arguments)
    return int(arguments.call(arguments))


def _with_verb(argv: Sequence[str]) -> Sequence[str]:
    """Adds the verb ``screen`` where there is none; options alone belong to it, except -h and -V."""
    alone = not argv or (argv[0].startswith("-") and argv[0] not in ("-h", "--help", "-V", "--version"))
    return ["screen", *argv] if alone else argv


def _refused(error: Exception, as_json: bool) -> int:
    try:
        return refuse(error, as_json)
    except BrokenPipeError:
        streams.silence(sys.stdout)
        return NOBODY_READS
