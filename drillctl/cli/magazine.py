"""``drillctl magazine ACTION``: a machine's magazine record: which tool each chuck holds, what stands in the places.

``list`` shows it; ``set`` says what somebody has seen: ``spindle.3=tool.2``, ``spindle.3=empty``, ``place.2=full``,
``place.2.3=empty`` (the bit of spindle 3), ``tool.2=new`` (new bits were put in); ``fill`` says that the chucks are
empty, every tool is in its place and every bit new.
"""

import argparse
import re
from typing import TYPE_CHECKING

from drillctl.cli import options
from drillctl.language import Message

if TYPE_CHECKING:
    from drillctl.generation.eight_axis.magazine import Magazine
    from drillctl.jobs.magazine import MagazineFile
    from drillctl.machine import Machine

MACHINE = "eight-axis"
SETTING = re.compile(
    r"(spindle|place|tool)\.(\d{1,4})(?:\.(\d{1,2}))?=(?:(empty|full|unknown|new)|tool\.(\d{1,4}))", re.ASCII
)


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("magazine", help="show and correct a machine's magazine record", description=__doc__)
    actions = verb.add_subparsers(metavar="ACTION", required=True)
    rows = (("list", _list, "show the record"), ("fill", _fill, "everything is in its place, and new"),
            ("set", _set, "say what somebody has seen"))  # fmt: skip
    for name, call, what in rows:
        action = actions.add_parser(name, help=what, description=f"{what[:1].upper()}{what[1:]}.")
        action.add_argument("--machine", default=MACHINE, metavar="NAME|FILE", help="machine; default: %(default)s")
        options.add_tables(action)
        action.set_defaults(call=call)
    example = "e.g. spindle.3=empty place.2.3=full tool.2=new"
    action.add_argument("settings", nargs="+", metavar="WHAT=SEEN", help=example)


def _list(arguments: argparse.Namespace) -> int:
    from drillctl.generation.eight_axis.magazine import place_of
    from drillctl.jobs.magazine import WORDS

    machine, kept = _opened(arguments)
    magazine = kept.magazine
    print(f"{kept.file}{': not written yet; this is how it will begin' if kept.is_new else ''}")
    for spindle, tool in sorted(magazine.chucks.items()):
        print(f"spindle.{spindle} = {'unknown' if tool is None else f'tool.{tool}' if tool else 'empty'}")
    assert machine.parameters is not None
    tools = [int(row.number("number") or 0) for row in machine.parameters.tools]
    kept_at = {place_of(machine, tool): tool for tool in tools}
    for place in sorted({place for place, _ in magazine.bits}):
        bits = {there for (at, _), there in magazine.bits.items() if at == place}
        words = [f"{place}.{at}: {WORDS[there]}" for (p, at), there in sorted(magazine.bits.items()) if p == place]
        shown = WORDS[bits.pop()] if len(bits) == 1 else ", ".join(words)
        print(f"place.{place} = {shown}{f' (tool.{kept_at[place]})' if place in kept_at else ''}")
    for tool in tools:
        print(f"tool.{tool}: {magazine.hits_left(machine, tool)} holes left")
    return 0


def _fill(arguments: argparse.Namespace) -> int:
    from drillctl.generation.eight_axis.magazine import full_magazine

    machine, kept = _opened(arguments)
    magazine = full_magazine(machine)
    assert machine.parameters is not None
    for row in machine.parameters.tools:
        magazine = magazine.renew(int(row.number("number") or 0))
    kept.keep(magazine)
    return 0


def _set(arguments: argparse.Namespace) -> int:
    machine, kept = _opened(arguments)
    magazine = kept.magazine
    for setting in arguments.settings:
        magazine = _seen(magazine, setting, machine)
    kept.keep(magazine)
    return 0


def _seen(magazine: "Magazine", setting: str, machine: "Machine") -> "Magazine":
    """Returns the record after one setting. Raises MagazineError for one that can't be meant."""
    from drillctl.jobs.magazine import THERE, MagazineError

    found = SETTING.fullmatch(setting)
    if found is None:
        raise MagazineError(Message("{text!r} is no WHAT=SEEN, such as spindle.3=empty or place.2=full", text=setting))
    what, number, spindle = found[1], int(found[2]), int(found[3]) if found[3] else None
    seen, tool = found[4], int(found[5]) if found[5] else None
    assert machine.parameters is not None
    if what == "spindle" and number in magazine.chucks and spindle is None and seen in ("empty", "unknown", None):
        if tool is None or machine.parameters.tool(tool) is not None:
            return magazine.with_chucks([number], 0 if seen == "empty" else tool)
    elif what == "place" and seen in THERE:
        bits = [at for place, at in magazine.bits if place == number and spindle in (None, at)]
        if bits:
            return magazine.with_bits(number, bits, THERE[seen])
    elif what == "tool" and seen == "new" and spindle is None and machine.parameters.tool(number) is not None:
        return magazine.renew(number)
    raise MagazineError(Message("{machine} has nothing that {text!r} could mean", machine=machine.name, text=setting))


def _opened(arguments: argparse.Namespace) -> tuple["Machine", "MagazineFile"]:
    """Returns the machine and its record. Raises MagazineError for a machine without a magazine."""
    from drillctl.jobs.magazine import MagazineError, MagazineFile, default_file
    from drillctl.jobs.session import journals

    machine = options.machine(argparse.Namespace(machine=arguments.machine, tables=arguments.tables, tick_hz=None))
    if machine.parameters is None:
        raise MagazineError(Message("{machine} has no magazine", machine=machine.name))
    return machine, MagazineFile(default_file(journals(), machine), machine)
