"""``drillctl ports``: what can be driven from here, and what each port needs. Also the option ``--port``."""

import argparse
import json
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drillctl.machine import Machine
    from drillctl.portio.registry import Port
    from drillctl.ports import Wiring

DEFAULT_PORT = "simulated"


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("ports", help="list the ports, and whether they can be used here", description=__doc__)
    verb.add_argument("--json", action="store_true", help="print one JSON array")
    verb.set_defaults(call=call)


def add_port(verb: argparse.ArgumentParser) -> None:
    """``--port``."""
    verb.add_argument("--port", default=DEFAULT_PORT, metavar="NAME[:ADDRESS]", help="default: %(default)s")


def call(arguments: argparse.Namespace) -> int:
    """One port a paragraph; looking at them opens none."""
    from drillctl.portio.registry import PORTS

    told = [_told(port) for port in PORTS.values()]
    if arguments.json:
        print(json.dumps(told, indent=2))
    else:
        print("\n\n".join(_paragraph(row) for row in told))
    return 0


def wiring_of(machine: "Machine") -> "Wiring":
    """What a driver must know of a machine."""
    from drillctl.ports import Wiring

    return Wiring(
        tick_hz=machine.tick_hz,
        card_address=machine.configuration.card_address,
        axis_outputs=tuple(_image(axis.wire_bits) for axis in machine.axes),
        other_outputs=_image(bit for _, bit in machine.outputs),
        inputs=_image(sensor.bit for sensor in machine.sensors),
    )


def _image(bits: Iterable[int]) -> int:
    return sum(1 << bit for bit in bits)


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
