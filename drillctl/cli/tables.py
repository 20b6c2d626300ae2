"""``drillctl machines`` and ``drillctl tables check FILE...``: what can be driven, and whether a table is sound."""

import argparse
import json
import sys
from pathlib import Path

from drillctl.cli import options


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds both verbs to the command line."""
    machines = verbs.add_parser("machines", help="list the machines that can be driven")
    options.add_tables(machines)
    machines.add_argument("--json", action="store_true", help="print one JSON array")
    machines.set_defaults(call=list_machines)
    tables = verbs.add_parser("tables", help="check phase tables, ramps, motors and machines")
    actions = tables.add_subparsers(metavar="ACTION", required=True)
    check = actions.add_parser("check", help="check table files; a dangerous one is warned about")
    check.add_argument("files", nargs="+", type=Path, metavar="FILE")
    options.add_tables(check)
    check.set_defaults(call=check_tables)


def list_machines(arguments: argparse.Namespace) -> int:
    """One line a machine; those that can't be loaded are named, and make the exit code 2."""
    from drillctl.machine import TableError

    library = options.library(arguments)
    rows, refused = [], 0
    for name in library.machine_names():
        try:
            machine = library.machine(name)
        except TableError as error:
            refused = 2
            print(f"drillctl: {error}", file=sys.stderr)
            continue
        rows.append({
            "name": machine.name, "axes": list(machine.axis_names), "tick_hz": machine.tick_hz,
            "description": machine.description, "digest": machine.digest,
        })  # fmt: skip
    if arguments.json:
        print(json.dumps(rows, indent=2))
    else:
        for row in rows:
            print(f"{row['name']:<20} {row['tick_hz']:>5} Hz  {' '.join(row['axes']):<26} {row['description']}")
    return refused


def check_tables(arguments: argparse.Namespace) -> int:
    """All files are looked at; 2 where one can't be used."""
    from drillctl.machine import TableError

    library = options.library(arguments)
    refused = 0
    for file in arguments.files:
        try:
            hazards = library.check(file)
        except TableError as error:
            refused = 2
            print(f"drillctl: {error}", file=sys.stderr)
            continue
        print(f"{file}: {'ok' if not hazards else 'usable, but'}")
        for hazard in hazards:
            print(f"  warning: {hazard}")
    return refused
