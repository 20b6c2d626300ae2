"""``drillctl resume [JOURNAL]``: goes on with a job that was cut off: initialises anew and drills what is left."""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import operating, options

if TYPE_CHECKING:
    from drillctl.generation.job import Job
    from drillctl.generation.journal import Account
    from drillctl.wiring.session import Session


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("resume", help="go on with a job that was cut off", description=__doc__)
    newest = "default: the newest unfinished one in the user's state folder"
    verb.add_argument("journal", nargs="?", type=Path, metavar="JOURNAL", help=newest)
    options.add_running(verb)
    options.add_engine(verb)
    options.add_tools(verb)
    options.add_results(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """The job is made again and must be the same; holes cut off in the middle are drilled again, and named."""
    from drillctl.generation.journal import read_journal
    from drillctl.wiring.outputs import reserved, unwritten

    file = arguments.journal or _newest()
    account = read_journal(file)
    session = _session(file, account, arguments)
    with reserved((arguments.holes,), (Path(account.head.job), *session.files)) as (holes,):
        _tell(file, account, session.job)
        done = operating.operated(session, arguments)
        problems = unwritten(lambda: options.write_holes(done, holes))
    return options.told(done, arguments.json, problems)


def _session(file: Path, account: "Account", arguments: argparse.Namespace) -> "Session":
    from drillctl.generation.recipe import Recipe
    from drillctl.wiring.session import Session, rest_of

    recipe = Recipe.of_options(account.head.options, file)
    tables = recipe.tables and Path(recipe.tables)
    machine = options.machine(argparse.Namespace(machine=recipe.machine, tables=tables, tick_hz=recipe.tick_hz))
    running = replace(options.running(arguments, options.port(arguments, machine)), engine=arguments.engine)
    return Session(rest_of(file, account, machine).left, running, file, account)


def _newest() -> Path:
    from drillctl.generation.errors import JobError
    from drillctl.generation.journals import unfinished
    from drillctl.wiring.session import journals

    found = unfinished(journals())
    if not found:
        raise JobError([f"{journals()}: no unfinished journal is kept here; name one"])
    return found[0][0]


def _tell(file: Path, account: "Account", left: "Job") -> None:
    """What the journal says, before anything moves."""
    print(f"drillctl: {file}: {len(account.done)} of {account.head.holes} holes are drilled", file=sys.stderr)
    if account.torn:
        print(f"drillctl: {file}: its last line is torn, and left out", file=sys.stderr)
    for warning in left.warnings:
        print(f"drillctl: warning: {warning}", file=sys.stderr)
    if account.head.options.get("spot") is not None and account.begun:
        spotted = "holes of the tool in hand may bear their spot already; they are marked again, in the same place"
        print(f"drillctl: {spotted}", file=sys.stderr)
    for number in account.open:
        x_mm, y_mm = left.file_place(number)
        print(f"drillctl: hole {number} (X{x_mm:.4f} Y{y_mm:.4f} mm) was cut off; it is drilled again", file=sys.stderr)
