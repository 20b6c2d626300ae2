"""``drillctl scope TRACE``: a recorded run on the screen, as a logic analyser shows it: wires, columns, commands."""

import argparse
from pathlib import Path

from drillctl.cli import options, screen
from drillctl.cli.operating import waiting


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("scope", help="look at a trace on the screen", description=__doc__)
    verb.add_argument("trace", type=Path, metavar="TRACE", help="what run --trace wrote")
    options.add_from_tick(verb, "show the run")
    screen.add_options(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """A trace that can't be read is refused before anything is drawn or started."""
    screen.check_terminal()
    from drillctl.console.scope_runs import TraceFile

    with waiting() as wait:
        run = TraceFile(arguments.trace, options.library(arguments), arguments.from_tick, wait)
    return screen.work(arguments, run)
