"""The screens that edit and look, with the benches they work on, by the names that the menus use.

Rule: what a screen needs is loaded when it is opened first, so that the first frame waits for none of it. Used by the
screen verb.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import urwid

    from drillctl.console.machine_console import MachineConsole
    from drillctl.machine import Library
    from drillctl.ui.app import Maker
    from drillctl.ui.screens.shell import Shell
    from drillctl.viewmodel.console import Console
    from drillctl.viewmodel.scope import ScopeSource
    from drillctl.viewmodel.tables import Kind


class ScreenMakers:
    """Makers of screens (ui.app.Maker). ``run`` is what the scope shows first; None: the machine's own run."""

    def __init__(self, library: "Library", station: "MachineConsole", plain: bool, run: "ScopeSource | None" = None):
        self._library, self._station, self._plain, self._run = library, station, plain, run

    def makers(self) -> "dict[str, Maker]":
        """By name."""
        return {
            "phase_editor": self._tables("phase"),
            "ramp_editor": self._tables("ramp"),
            "configuration": self._tables("machines"),
            "queue_editor": self._queue_editor,
            "port": self._port,
            "signals": self._signals,
            "scope": self._scope,
        }

    def _tables(self, kind: "Kind") -> "Maker":
        def made(console: "Console", shell: "Shell") -> "urwid.Widget":
            from drillctl.console.tables import TableFiles
            from drillctl.machine.library import user_tables
            from drillctl.ui.screens.table_list import TableList

            bench = TableFiles(self._library, user_tables(), lambda: self._station.machine)
            return TableList(console, shell, bench, kind, self._plain)

        return made

    def _queue_editor(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.queues import QueueFiles
        from drillctl.console.signals import MachineSignals
        from drillctl.ui.screens.queue_editor import QueueEditor

        return QueueEditor(console, shell, QueueFiles(lambda: self._station.machine), MachineSignals(self._station))

    def _port(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.port import MachinePort
        from drillctl.ui.screens.port import PortScreen

        return PortScreen(console, shell, MachinePort(self._station))

    def _signals(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.signals import MachineSignals
        from drillctl.ui.screens.signals import Signals

        return Signals(console, shell, MachineSignals(self._station))

    def _scope(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.console.scope_runs import ScopeRuns
        from drillctl.ui.screens.scope import Scope

        return Scope(console, shell, ScopeRuns(self._library, self._station), self._plain, self._run)
