"""``drillctl replay TRACE...``: runs recorded traces again and names the first tick that differs."""

import argparse
from pathlib import Path

from drillctl.cli import options
from drillctl.cli.operating import waiting


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("replay", help="run traces again and compare", description=__doc__)
    verb.add_argument("traces", nargs="+", type=Path, metavar="TRACE", help="what run --trace wrote")
    options.add_tables(verb)
    options.add_engine(verb)
    options.add_from_tick(verb, "compare")
    verb.add_argument("--same-tables", action="store_true", help="fail where the tables differ from the recorded ones")
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Replays each; 1 where one differs. A trace that can't be read is an error, as everywhere."""
    from drillctl.replay.compare import replay

    library = options.library(arguments)
    differing = 0
    for file in arguments.traces:
        with waiting() as wait:
            verdict = replay(file, library, arguments.engine, arguments.from_tick, wait)
        failed = verdict.failed(arguments.same_tables)
        differing += failed
        print(f"{file}: {'DIFFERS' if failed else 'same'}, {verdict.remark()}")
        if failed:
            print(verdict.message())
    return 1 if differing else 0
