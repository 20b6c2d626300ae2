"""``drillctl resume [JOURNAL]``: goes on with an interrupted job on the port, at the pace and on the plant where it
ran: initialises and drills the holes that are left.
"""

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import operating, options, streams
from drillctl.cli.holes_csv import write_holes
from drillctl.language import Counted, Message

if TYPE_CHECKING:
    from drillctl.generation.job import Job
    from drillctl.jobs.journal import Account
    from drillctl.jobs.session import Session
    from drillctl.ticker.launch import RunSettings


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("resume", help="go on with an interrupted job", description=__doc__)
    newest = "default: the newest unfinished one in the user's state folder"
    verb.add_argument("journal", nargs="?", type=Path, metavar="JOURNAL", help=newest)
    options.add_running(verb, options.AS_IT_RAN)
    there = "go on even where port, pace or plant differ from those that the job ran on"
    verb.add_argument("--elsewhere", action="store_true", help=there)
    options.add_engine(verb)
    options.add_tools(verb)
    options.add_results(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Makes the job again, checks that it is the same, and drills what is left; a hole that was interrupted is named
    and drilled again.
    """
    from drillctl.files.outputs import reserved, unwritten
    from drillctl.jobs.journal import read_journal

    file = arguments.journal or _newest()
    account = read_journal(file)
    session, whole = _session(file, account, arguments)
    with reserved((arguments.holes,), (Path(account.head.job), *session.files)) as (holes,):
        _tell(account, session, whole)
        done = operating.operated(session, arguments)
        problems = unwritten(lambda: write_holes(session.job, done, holes))
    return options.report_outcome(done, arguments.json, problems)


def _session(file: Path, account: "Account", arguments: argparse.Namespace) -> tuple["Session", "Job"]:
    """Returns the session that drills what is left, and the whole job."""
    from drillctl.generation.job_setup import JobSetup
    from drillctl.jobs.session import Session, rest_of

    chosen = JobSetup.of_journal(account.head.options, file)
    tables = chosen.tables and Path(chosen.tables)
    wanted = arguments.converter or account.site.converter or None
    converter = options.converter(argparse.Namespace(converter=wanted, tables=tables))
    machine = options.machine(argparse.Namespace(machine=chosen.machine, tables=tables, tick_hz=chosen.tick_hz))
    with operating.waiting() as wait:
        rest = rest_of(file, account, machine, wait)
    running = replace(_running(file, account, arguments), converter=converter)
    return Session(rest.left, running, file, account).equipped(), rest.whole


def _running(file: Path, account: "Account", arguments: argparse.Namespace) -> "RunSettings":
    """Returns the settings of the first run, changed by the options. Raises JobError where they differ and --elsewhere
    was not given.
    """
    from drillctl.generation.errors import JobError
    from drillctl.jobs.site import SiteOptions, moved, running_at, site_of

    given = SiteOptions(arguments.port, arguments.pace, options.plant(arguments))
    running = running_at(account.site, given)
    if not arguments.elsewhere and (reason := moved(account.site, site_of(running))):
        there = "leave --port, --pace, --plant, --fault and --seed out to go on there"
        raise JobError(Message("{reason}; {there}, or say --elsewhere as well", reason=reason, there=there).at(file))
    return replace(running, engine=arguments.engine)


def _newest() -> Path:
    from drillctl.generation.errors import JobError
    from drillctl.jobs.journal.folder import newest_unfinished
    from drillctl.jobs.session import journals

    found = newest_unfinished(journals())
    if found is None:
        raise JobError(Message("no unfinished journal is kept here; name one").at(journals()))
    return found[0]


def _tell(account: "Account", session: "Session", whole: "Job") -> None:
    """Prints where the job goes on, and what the journal says, before anything moves."""
    from drillctl.jobs.site import site_of

    file, left, here = session.journal, session.job, site_of(session.running)
    where = f"as it ran: {here}" if here == account.site else f"elsewhere: {here}; it ran on {account.site}"
    counted = Counted(
        "{done} of {count} hole is drilled", "{done} of {count} holes are drilled",
        account.head.holes, done=account.holes_done,
    )  # fmt: skip
    streams.tell(f"{file}: {counted}; it goes on {where}")
    if account.torn:
        streams.tell(f"{file}: its last line is torn, and left out")
    for warning in left.warnings:
        streams.tell(f"warning: {warning}")
    if account.head.options.get("spot") is not None and account.holes_begun:
        spotted = "holes of the present tool may have their spot already; they are spotted again, in the same place"
        streams.tell(f"{spotted}")
    for number in account.suspect:
        x_mm, y_mm = whole.file_place(number)
        streams.tell(f"look at hole {number} (X{x_mm:.4f} Y{y_mm:.4f} mm): a bit was found broken after it")
    if account.again is not None:
        x_mm, y_mm = left.file_place(account.again)
        hole = f"hole {account.again} (X{x_mm:.4f} Y{y_mm:.4f} mm)"
        why = "was cut off" if account.open else "may have been begun"
        streams.tell(f"{hole} {why}; it is drilled again")
