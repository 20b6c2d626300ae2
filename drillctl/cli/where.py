"""``drillctl where``: the folders in which drillctl looks for tables and examples, and keeps its settings and
journals.
"""

import argparse
from pathlib import Path

from drillctl.cli import options
from drillctl.language import json_text


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("where", help="say where tables, settings and journals are", description=__doc__)
    options.add_tables(verb)
    verb.add_argument("--json", action="store_true", help="print one JSON object")
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Prints a line for each; a folder that is not there yet is marked, and made when it is first needed."""
    found = _places(arguments)
    if arguments.json:
        print(json_text({name: [str(place) for place in places] for name, places in found.items()}, 2))
        return 0
    for name, places in found.items():
        for place in places:
            print(f"{name:10} {place}{'' if place.exists() else '  (not there yet)'}")
    return 0


def _places(arguments: argparse.Namespace) -> dict[str, list[Path]]:
    from drillctl.files.shipped import shipped
    from drillctl.jobs.session import journals
    from drillctl.ui.preferences import file as settings_file

    return {
        "tables": list(options.library(arguments).folders),
        "examples": [shipped("examples", "examples")],
        "sheets": [shipped("sheets", "docs/lab")],
        "settings": [settings_file()],
        "journals": [journals()],
        "stores": [journals() / "stores"],
    }
