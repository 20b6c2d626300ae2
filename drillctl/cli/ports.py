"""``drillctl ports``: what can be driven from here, and what each port needs."""

import argparse
from typing import TYPE_CHECKING

from drillctl.language import json_text

if TYPE_CHECKING:
    from drillctl.portio.registry import Port


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("ports", help="list the ports, and whether they can be used here", description=__doc__)
    verb.add_argument("--json", action="store_true", help="print one JSON array")
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Prints a paragraph for each port; none is opened."""
    from drillctl.portio.registry import PORTS, added_ports

    rows = [_facts(port) for port in (*PORTS.values(), *added_ports())]
    if arguments.json:
        print(json_text(rows, 2))
    else:
        print("\n\n".join(_paragraph(row) for row in rows))
    return 0


def _facts(port: "Port") -> dict[str, str | bool | None]:
    reason = port.missing()
    return {
        "name": port.name,
        "address": port.address,
        "summary": port.summary,
        "needs": port.needs,
        "real": port.real,
        "usable": not reason,
        "reason": reason or None,
    }


def _paragraph(facts: dict[str, str | bool | None]) -> str:
    named = f"{facts['name']}:{facts['address']}" if facts["address"] else facts["name"]
    here = "can be used here" if facts["usable"] else f"can't be used here: {facts['reason']}"
    return f"{named}\n  {facts['summary']}\n  needs {facts['needs']}\n  {here}"
