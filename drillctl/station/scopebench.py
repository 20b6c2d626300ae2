"""Wiring: the runs that the screen's scope can look at (panel/scope.py). Created by the screen verb."""

from pathlib import Path

from drillctl.machine import Library, TableError
from drillctl.panel.console import Problems
from drillctl.station.operating import BUSY
from drillctl.station.scope import Recording
from drillctl.station.station import Station
from drillctl.station.tracefile import TraceFile
from drillctl.trace import TraceError


class ScopeBench:
    """A ScopeDesk for a station and the tables of a library."""

    def __init__(self, library: Library, station: Station):
        self._library, self._station = library, station

    def running(self) -> Recording:
        """Another one once another machine was chosen."""
        return self._station.recording

    def open_trace(self, file: str) -> tuple[TraceFile | None, Problems]:
        """Refused while the machine is at work: reading a long file takes longer than a ticker waits for its desk."""
        if self._station.at_work:
            return None, (BUSY,)
        try:
            return TraceFile(Path(file), self._library), ()
        except (TraceError, TableError) as error:
            return None, (str(error),)
