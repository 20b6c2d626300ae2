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
    """One port a paragraph; looking at them opens none."""
    from drillctl.portio.registry import PORTS

    told = [_told(port) for port in PORTS.values()]
    if arguments.json:
        print(json_text(told, 2))
    else:
        print("\n\n".join(_paragraph(row) for row in told))
    return 0


def _told(port: "Port") -> dict[str, str | bool | None]:
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


def _paragraph(told: dict[str, str | bool | None]) -> str:
    named = f"{told['name']}:{told['address']}" if told["address"] else told["name"]
    here = "can be used here" if told["usable"] else f"can't be used here: {told['reason']}"
    return f"{named}\n  {told['summary']}\n  needs {told['needs']}\n  {here}"
