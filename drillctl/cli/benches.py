"""The screens that edit and look, with the benches they work on, by the names that the menus use.

Rule: what a screen needs is loaded when it is opened first, so that the first frame waits for none of it. Used by the
screen verb.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import urwid

    from drillctl.machine import Library
    from drillctl.panel.console import Console
    from drillctl.panel.scope import ScopeSource
    from drillctl.panel.tables import Kind
    from drillctl.station.station import Station
    from drillctl.ui.app import Maker
    from drillctl.ui.shell import Shell


class Benches:
    """Makers of screens (ui.app.Maker). ``run`` is what the scope shows first; None: the machine's own run."""

    def __init__(self, library: "Library", station: "Station", plain: bool, run: "ScopeSource | None" = None):
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
            from drillctl.machine.library import user_tables
            from drillctl.station.workbench import Workbench
            from drillctl.ui.screens.table_list import TableList

            bench = Workbench(self._library, user_tables(), lambda: self._station.machine)
            return TableList(console, shell, bench, kind, self._plain)

        return made

    def _queue_editor(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.station.handbench import HandBench
        from drillctl.station.queuebench import QueueBench
        from drillctl.ui.screens.queue_editor import QueueEditor

        return QueueEditor(console, shell, QueueBench(lambda: self._station.machine), HandBench(self._station))

    def _port(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.station.portbench import PortBench
        from drillctl.ui.screens.port import PortScreen

        return PortScreen(console, shell, PortBench(self._station))

    def _signals(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.station.handbench import HandBench
        from drillctl.ui.screens.signals import Signals

        return Signals(console, shell, HandBench(self._station))

    def _scope(self, console: "Console", shell: "Shell") -> "urwid.Widget":
        from drillctl.station.scopebench import ScopeBench
        from drillctl.ui.screens.scope import Scope

        return Scope(console, shell, ScopeBench(self._library, self._station), self._plain, self._run)
