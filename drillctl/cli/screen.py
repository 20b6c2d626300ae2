"""``drillctl screen``, or ``drillctl`` alone: the machine on the screen, with menus, the board and the keys."""

import argparse
import gc
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

from drillctl.cli import options, streams, verbosity
from drillctl.language import Message, Refusal

if TYPE_CHECKING:
    from drillctl.viewmodel.scope import ScopeSource


class ScreenError(Refusal):
    """The screen can't be shown: there is no terminal to draw on."""

    kind = "screen"


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("screen", help="open the screen; the same as drillctl without a verb", description=__doc__)
    add_options(verb)
    verb.set_defaults(call=call)


def add_options(verb: argparse.ArgumentParser) -> None:
    """Adds the options of the verbs that show the screen: machine, port and pace, language, theme."""
    options.add_machine(verb)
    options.add_running(verb)
    options.add_tools(verb, "ask on a real port, and where the machine's file says MANUAL")
    verb.add_argument("--lang", choices=("en", "pl"), help="language; default: that of LANG")
    verb.add_argument(
        "--theme", choices=("blue", "dark", "light", "contrast", "mono"),
        help="colours; default: the one chosen last on the Configuration menu, at first blue; NO_COLOR: mono",
    )  # fmt: skip


def call(arguments: argparse.Namespace) -> int:
    """Shows the screen until the operator leaves; returns the exit code."""
    check_terminal()
    return work(arguments)


def check_terminal() -> None:
    """Raises ScreenError where standard input or output is no terminal."""
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        raise ScreenError(
            Message("the screen needs a terminal; for a pipe or a script there are verbs: drillctl --help")
        )


def work(arguments: argparse.Namespace, run: "ScopeSource | None" = None) -> int:
    """Every way out closes the console: the outputs are safe, and what was started has ended.

    run  is what the scope shows, which then is the screen in front
    """
    from drillctl.jobs.interrupts import remembered

    plain = (sys.stdout.encoding or "").lower() != "utf-8"
    streams.speak(arguments.lang, plain)
    with verbosity.held_back():
        with _uncollected():
            library, console = _machine(arguments)
        try:
            with _uncollected():
                app = _app(arguments, library, console, plain, run)
            with remembered() as interrupts:
                app.run(interrupts)
        finally:
            console.close()
    return 0


@contextmanager
def _uncollected() -> Iterator[None]:
    """Keeps the garbage collector from looking over what is imported and made here, which stays to the end: a tenth of
    the time to the first frame, and of every later collection most.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


def _machine(arguments: argparse.Namespace) -> "tuple[Library, MachineConsole]":
    """The library, and the machine that was asked for, started."""
    from drillctl.console.machine_console import MachineConsole
    from drillctl.machine.library import tell_nobody
    from drillctl.ticker.launch import SIMULATED

    pace = arguments.pace or ("real" if sys.platform.startswith("linux") else None)
    library = replace(options.library(arguments), tell=tell_nobody)  # the second line says it
    running = options.running(arguments, arguments.port or SIMULATED)
    running = replace(running, pace=pace, sliced=not arguments.pace, waits=False)  # the screen's loop waits
    console = MachineConsole(
        library, options.machine(arguments), running, arguments.tools, arguments.tick_hz, bool(arguments.port)
    )
    return library, console


def _app(
    arguments: argparse.Namespace, library: "Library", console: "MachineConsole", plain: bool,
    run: "ScopeSource | None",
) -> "App":  # fmt: skip
    from drillctl.ui import preferences
    from drillctl.ui.app import App

    theme = arguments.theme or preferences.chosen_theme(os.environ)
    makers = EditorScreens(library, console, plain, run).makers()
    app = App(console, theme, plain, makers, keep_theme=preferences.keep_theme)
    if run is not None:
        app.show("scope")
    return app


if TYPE_CHECKING:
    import urwid

    from drillctl.console.machine_console import MachineConsole
    from drillctl.machine import Library
    from drillctl.ui.app import App, Maker
    from drillctl.ui.screens.shell import Shell
    from drillctl.viewmodel.console import Console
    from drillctl.viewmodel.scope import ScopeSource
    from drillctl.viewmodel.tables import TableKind


class EditorScreens:
    """Makers of screens (ui.app.Maker). ``run`` is what the scope shows first; None: the machine's own run."""

    def __init__(self, library: "Library", console: "MachineConsole", plain: bool, run: "ScopeSource | None" = None):
        self._library, self._console, self._plain, self._run = library, console, plain, run

    def makers(self) -> "dict[str, Maker]":
        """The makers of the screens that every machine has, by the names that the menus use."""
        return {
            "phase_editor": self._tables("phase"),
            "ramp_editor": self._tables("ramp"),
            "configuration": self._tables("machines"),
            "queue_editor": self._queue_editor,
            "port": self._port,
            "plant": self._plant,
            "signals": self._signals,
            "scope": self._scope,
        }

    def _tables(self, kind: "TableKind") -> "Maker":
        def made(console: "Console", shell: "Shell") -> "urwid.Widget":
            from drillctl.console.tables import TableFiles
            from drillctl.lab.table_bench import TableBench
            from drillctl.machine.library import user_tables
            from drillctl.ui.screens.table_list import TableList

            files = TableFiles(self._library, user_tables(), lambda: self._console.machine)
            return TableList(console, shell, files, kind, self._plain, TableBench(lambda: self._console.machine))

        return made

    def _queue_editor(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.queues import QueueFiles
        from drillctl.console.signals import MachineSignals
        from drillctl.ui.screens.queue_editor import QueueEditor

        queues, hands = QueueFiles(lambda: self._console.machine), MachineSignals(self._console)
        return QueueEditor(console, shell, queues, hands, self._plain)

    def _port(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.port import MachinePort
        from drillctl.ui.screens.port import PortScreen

        return PortScreen(console, shell, MachinePort(self._console))

    def _plant(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.plant import MachinePlant
        from drillctl.ui.screens.plant import PlantScreen

        return PlantScreen(console, shell, MachinePlant(self._console), self._plain)

    def _signals(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.signals import MachineSignals
        from drillctl.ui.screens.signals import Signals

        return Signals(console, shell, MachineSignals(self._console))

    def _scope(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.scope_runs import ScopeRuns
        from drillctl.ui.screens.scope import Scope

        return Scope(console, shell, ScopeRuns(self._library, self._console), self._plain, self._run)
