"""Verbs and options. Rule: nothing heavy is imported before a verb is called; whatever the operator got wrong is
one line (a line a problem) on standard error, ``drillctl: FILE:LINE: reason``, and exit code 2.

    run.py      drill a file or a queue          estimate.py  what it will take
    inspect.py  what a drill file says           convert.py   a clean file, or a queue, from it
    replay.py   traces again                     tables.py    machines, and checking tables
    jobs.py     the options of a job             options.py   machine and tables
"""

import argparse
import sys
from collections.abc import Sequence

from drillctl import __version__
from drillctl.cli import convert, estimate, inspect, replay, run, tables

DONE, STOPPED, REFUSED = 0, 1, 2
VERBS = (run, estimate, inspect, convert, replay, tables)
DESCRIPTION = "Drives and simulates stepper-motor drilling machines."
EPILOG = "exit: 0 done, 1 the machine stopped on a fault (replay: differs), 2 refused before anything moved"


def parser() -> argparse.ArgumentParser:
    """The whole command line."""
    top = argparse.ArgumentParser("drillctl", description=DESCRIPTION, epilog=EPILOG)
    top.add_argument("--version", action="version", version=f"drillctl {__version__}")
    verbs = top.add_subparsers(title="verbs", metavar="VERB", dest="verb", required=True)
    for verb in VERBS:
        verb.add(verbs)
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one verb; returns the exit code. Interrupted, the outputs are off: 130, or 143 on SIGTERM."""
    if sys.platform not in ("linux", "darwin"):
        print("drillctl: runs on Linux; on macOS and WSL for simulation. Not here.", file=sys.stderr)
        return REFUSED
    arguments = parser().parse_args(argv)
    try:
        return int(arguments.call(arguments))
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        return _quiet_pipe()
    except Exception as error:
        if not _is_refusal(error):
            raise
        for line in str(error).splitlines():
            print(f"drillctl: {line}", file=sys.stderr)
        return REFUSED


def _is_refusal(error: Exception) -> bool:
    from drillctl.generation.alignment import AlignmentError
    from drillctl.generation.drillfile import DrillFileError
    from drillctl.generation.errors import JobError
    from drillctl.generation.placing import PlacingError
    from drillctl.machine import TableError
    from drillctl.outputs import OutputError
    from drillctl.trace import TraceError

    refusals = (JobError, TableError, TraceError, OutputError, DrillFileError, PlacingError, AlignmentError)
    return isinstance(error, refusals)


def _quiet_pipe() -> int:
    """Whoever read our output has gone; say nothing more, not even at exit."""
    sys.stderr.close()
    return 141
