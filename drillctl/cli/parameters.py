"""``drillctl parameters ACTION``: the parameters of a machine that has any (axes, system, magazine, machining, tools).

``list`` shows them; ``help`` what each means and does; ``set`` enters some, by name: ``system.parking_x_mm=20``,
``axis.z6.enabled=false``, ``tool.3.life_hits=unset``; ``add`` and ``remove`` a tool or a place of the magazine.
"""

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING

from drillctl.cli import options
from drillctl.language import Message, json_text

if TYPE_CHECKING:
    from drillctl.console.parameters import Change
    from drillctl.machine import Machine, Parameters
    from drillctl.machine.parameter_edit import Entry

MACHINE = "eight-axis"
ROWS = ("tool", "magazine")


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("parameters", help="list, explain and set a machine's parameters", description=__doc__)
    actions = verb.add_subparsers(metavar="ACTION", required=True)
    shown = _action(actions, "list", _list, "list parameters with their values")
    shown.add_argument("names", nargs="*", metavar="NAME", help="a parameter or the beginning of some: axis.x, tool")
    shown.add_argument("--unset", action="store_true", help="only those that must still be entered")
    shown.add_argument("--json", action="store_true", help="print one JSON object of names and values")
    explained = _action(actions, "help", _help, "tell what parameters mean, what they may be, and what they do")
    explained.add_argument("names", nargs="*", metavar="NAME", help="a parameter or the beginning of some")
    entered = _action(actions, "set", _set, "set parameters and save the machine's file")
    entered.add_argument("settings", nargs="+", metavar="NAME=VALUE", help="a value, or unset")
    for name, call, what in (("add", _add, "add a tool or a place"), ("remove", _remove, "take one away")):
        action = _action(actions, name, call, what)
        action.add_argument("group", choices=ROWS, help="a tool, or a place of the magazine")
        action.add_argument("number", type=int, metavar="N", help="its number")


def _action(
    actions: "argparse._SubParsersAction[argparse.ArgumentParser]",
    name: str,
    call: Callable[[argparse.Namespace], int],
    what: str,
) -> argparse.ArgumentParser:
    action = options.add_action(actions, name, call, what)
    action.add_argument("--machine", default=MACHINE, metavar="NAME|FILE", help="machine; default: %(default)s")
    options.add_tables(action)
    return action


def _list(arguments: argparse.Namespace) -> int:
    from drillctl.machine.parameter_entry import range_of, shown

    wanted = _wanted(arguments)
    if arguments.unset:
        missing = _parameters(_machine(arguments)).missing()
        wanted = [one for one in wanted if one.name in missing]
    if arguments.json:
        print(json_text({one.name: one.value for one in wanted}, 2))
        return 0
    width = max((len(one.name) for one in wanted), default=0)
    for one in wanted:
        print(f"{one.name:{width}} = {shown(one.value):<10} ({range_of(one.parameter)})")
    return 0


def _help(arguments: argparse.Namespace) -> int:
    from drillctl.machine.parameter_entry import range_of, shown

    for one in _wanted(arguments):
        row = one.parameter
        print(f"{one.name} = {shown(one.value)}\n  is: {row.meaning}\n  may be: {range_of(row)}\n  does: {row.effect}")
    return 0


def _set(arguments: argparse.Namespace) -> int:
    from drillctl.machine.parameter_edit import ParameterError, with_parameters

    typed = {}
    for setting in arguments.settings:
        name, equals, value = setting.partition("=")
        if not equals:
            raise ParameterError(Message("NAME=VALUE is wanted, not {text!r}", text=setting))
        if not value.strip():
            raise ParameterError(Message("{name}= has no value; say unset where there shall be none", name=name))
        if name in typed:
            raise ParameterError(Message("{name} is set twice", name=name))
        typed[name] = value
    return _save(arguments, lambda source: with_parameters(source, typed))


def _add(arguments: argparse.Namespace) -> int:
    from drillctl.machine.parameter_edit import with_row

    return _save(arguments, lambda source: with_row(source, arguments.group, arguments.number))


def _remove(arguments: argparse.Namespace) -> int:
    from drillctl.machine.parameter_edit import without_row

    return _save(arguments, lambda source: without_row(source, arguments.group, arguments.number))


def _save(arguments: argparse.Namespace, change: "Change") -> int:
    """Saves what was changed, tells where, and what is still to be entered."""
    from drillctl.console.parameters import save, saved_in
    from drillctl.machine.library import user_tables
    from drillctl.machine.parameter_edit import ParameterError

    machine = _machine(arguments)
    if problems := save(options.library(arguments), machine, user_tables(), change):
        raise ParameterError(*problems)
    saved = saved_in(machine, user_tables())
    missing = _parameters(options.library(arguments).machine(str(saved))).missing()
    print(f"saved in {saved}" + (f"; unset: {', '.join(missing)}" if missing else ""))
    return 0


def _wanted(arguments: argparse.Namespace) -> "list[Entry]":
    """Returns the parameters that were named, whole or by the beginning of their names; all where none was."""
    from drillctl.machine.parameter_edit import entries, entry

    parameters = _parameters(_machine(arguments))
    known = entries(parameters)
    if not arguments.names:
        return known
    for name in arguments.names:
        if not any(_begins(one.name, name) for one in known):
            entry(parameters, name)  # refuses it, with the names that are near
    return [one for one in known if any(_begins(one.name, name) for name in arguments.names)]


def _begins(name: str, beginning: str) -> bool:
    return name == beginning or name.startswith(f"{beginning}.")


def _machine(arguments: argparse.Namespace) -> "Machine":
    return options.library(arguments).machine(arguments.machine)


def _parameters(machine: "Machine") -> "Parameters":
    from drillctl.machine.parameter_edit import ParameterError

    if machine.parameters is None:
        raise ParameterError(Message("machine {name} has no parameters", name=machine.name).at(machine.file))
    return machine.parameters
