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
    sweep.py    thousands of variants of a machine         tune.py  the fastest ramp that loses nothing
    plot.py     what the motors did in a run     drawing.py   a picture in the terminal or in a file
"""

import argparse
import sys
from collections.abc import Sequence
from typing import NoReturn

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
from drillctl.wiring.interrupts import caught, exit_code, leave

REFUSED = 2
NOBODY_READS = 141  # as a shell has it for SIGPIPE
VERBS = (run, resume, estimate, inspect, convert, replay, tables, ports, latency, screen, scope, plot, sweep, tune)
DESCRIPTION = "Drives and simulates stepper-motor drilling machines."
EPILOG = (
    "exit: 0 done, 1 the machine stopped on a fault (replay: differs), 2 refused before anything moved, "
    "130 or 143 interrupted (Ctrl-C, SIGTERM), outputs off"
)


class Parser(argparse.ArgumentParser):
    """Complains as the rest of the program does; takes a module's docstring for its description."""

    def format_help(self) -> str:
        """The help text, without the docstring's marks."""
        return super().format_help().replace("``", "")

    def error(self, message: str) -> NoReturn:
        """One line on standard error, exit code 2."""
        self.exit(REFUSED, f"drillctl: {message} (see {self.prog} --help)\n")


def parser() -> Parser:
    """The whole command line."""
    top = Parser("drillctl", description=DESCRIPTION, epilog=EPILOG)
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
    streams.prepare()
    arguments = parser().parse_args(_with_verb(sys.argv[1:] if argv is None else argv))
    try:
        with caught(leave):
            return streams.delivered(int(arguments.call(arguments)))
    except KeyboardInterrupt as stop:
        return exit_code(*stop.args)
    except BrokenPipeError:
        streams.silence(sys.stdout)
        return NOBODY_READS
    except Exception as error:
        return _refuse(error)


def _with_verb(argv: Sequence[str]) -> Sequence[str]:
    """Without a verb the screen is meant; options alone are the screen's, but for those that only tell something."""
    alone = not argv or (argv[0].startswith("-") and argv[0] not in ("-h", "--help", "--version"))
    return ["screen", *argv] if alone else argv


def _refuse(error: Exception) -> int:
    """Tells what the operator got wrong; whatever else it is goes on up, as a fault of ours."""
    if _is_refusal(error):
        reason = str(error)
    elif isinstance(error, OSError) and error.filename is None:
        return streams.untold(error)
    elif isinstance(error, OSError):
        reason = f"{error.filename}: {error.strerror}"
    else:
        raise error
    for line in reason.splitlines():
        print(f"drillctl: {line}", file=sys.stderr)
    return REFUSED


def _is_refusal(error: Exception) -> bool:
    from drillctl.generation.drillfile import DrillFileError
    from drillctl.generation.errors import JobError
    from drillctl.generation.journal import JournalError
    from drillctl.generation.measured import AlignmentError
    from drillctl.generation.placing import PlacingError
    from drillctl.lab.errors import LabError
    from drillctl.lab.latency import LatencyError
    from drillctl.machine import TableError
    from drillctl.ports import PortError
    from drillctl.trace import TraceError
    from drillctl.ui.plotted import PictureRefused
    from drillctl.wiring.outputs import OutputError

    refusals = (
        JobError, TableError, TraceError, OutputError, DrillFileError, PlacingError, AlignmentError, PortError,
        JournalError, LatencyError, LabError, PictureRefused, screen.ScreenError,
    )  # fmt: skip
    return isinstance(error, refusals)
