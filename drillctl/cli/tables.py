"""``drillctl machines`` and ``drillctl tables``: which machines there are, and whether a table is valid; the other
actions of tables are in table_files.py.
"""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import options, streams, table_files
from drillctl.language import json_text

MACHINES = "Lists the machines that can be driven: name, interrupt frequency, axes, description."
TABLES = "Lists, shows and copies tables (phase tables, ramps, motors, dynamics, machines), and checks them."
CHECK = "Checks table files. One that can't be used is refused with its line, a dangerous one is warned about."

if TYPE_CHECKING:
    from drillctl.machine import Machine


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds both verbs to the command line."""
    machines = verbs.add_parser("machines", help="list the machines that can be driven", description=MACHINES)
    options.add_tables(machines)
    machines.add_argument("--json", action="store_true", help="print one JSON array")
    machines.set_defaults(call=list_machines)
    tables = verbs.add_parser("tables", help="list, show, copy and check tables", description=TABLES)
    actions = tables.add_subparsers(metavar="ACTION", required=True)
    check = actions.add_parser("check", help="check table files", description=CHECK)
    check.add_argument("files", nargs="+", type=Path, metavar="FILE", help="a phase table, ramp, motor or machine")
    options.add_tables(check)
    check.set_defaults(call=check_tables)
    table_files.add(actions)


def list_machines(arguments: argparse.Namespace) -> int:
    """Prints one line for each machine; those that can't be loaded are named, and make the exit code 2."""
    from drillctl.machine import TableError

    library = options.library(arguments)
    machines, refused = [], 0
    for name in library.machine_names():
        try:
            machines.append(library.machine(name))
        except TableError as error:
            refused = 2
            streams.tell(str(error))
    if arguments.json:
        print(json_text([_as_dict(machine) for machine in machines], 2))
    else:
        for m in machines:
            print(f"{m.name:<20} {m.tick_hz:>5} Hz  {' '.join(m.axis_names):<26} {m.description}")
    return refused


def _as_dict(machine: "Machine") -> dict[str, object]:
    return {
        "name": machine.name,
        "axes": list(machine.axis_names),
        "tick_hz": machine.tick_hz,
        "description": machine.description,
        "digest": machine.digest,
    }


def check_tables(arguments: argparse.Namespace) -> int:
    """Checks all files and prints what their ramps ask of the carriages; returns 2 where one can't be used."""
    from drillctl.machine import TableError
    from drillctl.machine.source import Source

    library = options.library(arguments)
    refused = 0
    for file in arguments.files:
        try:
            hazards = library.check(file)
            figures = library.figures(Source.read(file))
        except TableError as error:
            refused = 2
            streams.tell(str(error))
            continue
        print(f"{file}: {'ok' if not hazards else 'usable, but'}")
        for hazard in hazards:
            print(f"  warning: {hazard}")
        for line in figures:
            print(f"  {line}")
    return refused
