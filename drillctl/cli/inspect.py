"""``drillctl inspect FILE``: what a drill file says, and which format it was taken for."""

import argparse
import json
from pathlib import Path


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("inspect", help="say what a drill file holds", description=__doc__)
    verb.add_argument("file", type=Path, metavar="FILE")
    verb.add_argument("--format", metavar="F", help="settle the format, e.g. inch,2:4,leading")
    verb.add_argument("--json", action="store_true", help="print one JSON object, also for a refused file")
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Prints the summary; a refused file is an error (exit 2), with --json told as an object too."""
    from drillctl.generation.drillfile import DrillFileError, read, summary
    from drillctl.ui.drilling import inspect_lines

    try:
        told = summary(read(arguments.file, fmt=arguments.format))
    except DrillFileError as error:
        if arguments.json:
            print(json.dumps(error.as_dict()))
        raise
    print(json.dumps(told, indent=2) if arguments.json else "\n".join(inspect_lines(arguments.file.name, told)))
    return 0
