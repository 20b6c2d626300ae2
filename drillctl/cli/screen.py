"""``drillctl screen``, or ``drillctl`` alone: the machine on the screen, with menus, the board and the keys."""

import argparse
import sys
from typing import TYPE_CHECKING

from drillctl.cli import options

if TYPE_CHECKING:
    from drillctl.machine import Library
    from drillctl.station.station import Station
    from drillctl.ui.app import Maker


class ScreenError(Exception):
    """There is no terminal to draw on."""


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("screen", help="work on the screen; no verb means this", description=__doc__)
    options.add_machine(verb)
    options.add_running(verb)
    verb.add_argument("--lang", choices=("en", "pl"), help="default: as LANG says")
    verb.add_argument("--theme", choices=("colour", "light", "mono"), default="colour", help="default: %(default)s")
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Every way out closes the console: the outputs are safe, and what was started has ended."""
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        raise ScreenError("the screen needs a terminal; for a pipe or a script there are verbs: drillctl --help")
    from drillctl.station.station import Station
    from drillctl.ui import words
    from drillctl.ui.app import App
    from drillctl.wiring.machinery import Running

    plain = (sys.stdout.encoding or "").lower() != "utf-8"
    words.use(arguments.lang or words.language_of(), plain)
    pace = arguments.pace or ("real" if sys.platform.startswith("linux") else None)
    library = options.library(arguments)
    station = Station(library, options.machine(arguments), Running(arguments.port, pace))
    try:
        App(station, arguments.theme, plain, _benches(library, station, plain)).run()
    finally:
        station.close()
    return 0


def _benches(library: "Library", station: "Station", plain: bool) -> "dict[str, Maker]":
    """The screens that edit, by their names in the menus."""
    from drillctl.machine.library import user_tables
    from drillctl.station.queuebench import QueueBench
    from drillctl.station.workbench import Workbench
    from drillctl.ui.screens.queue_editor import QueueEditor
    from drillctl.ui.screens.table_list import TableList

    tables = Workbench(library, user_tables())
    queues = QueueBench(lambda: station.machine)
    return {
        "phase_editor": lambda console, shell: TableList(console, shell, tables, "phase", plain),
        "ramp_editor": lambda console, shell: TableList(console, shell, tables, "ramp", plain),
        "configuration": lambda console, shell: TableList(console, shell, tables, "machines", plain),
        "queue_editor": lambda console, shell: QueueEditor(console, shell, queues),
    }
