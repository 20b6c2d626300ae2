"""The machine in use: its link and port, the recording of its runs; another one, or the same on a real port.

Rule: the old one's outputs are safe before the new one starts; where that can't be, the machine that was in use is
started anew, simulated. Made by station.
"""

from dataclasses import replace
from pathlib import Path

from drillctl.console.scope import Recording
from drillctl.files.scratch import KEPT_IN_FOLDERS, Folder
from drillctl.jobs.site import site_of
from drillctl.machine import Library, Machine, TableError
from drillctl.machine.bundle import bundle, unbundle
from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ
from drillctl.ports import PortError
from drillctl.ticker.launch import (
    FREE,
    REAL,
    RunSettings,
    card_port,
    check_rate,
    on_port,
    pace_of,
    plant_of,
    simulated,
    start,
)  # fmt: skip
from drillctl.ticker.link import Link
from drillctl.ticker.table_loading import same_but_tables
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.fault_texts import local_tables
from drillctl.viewmodel.jobs import Site
from drillctl.viewmodel.signals import PortView


class MachineInUse:
    """One machine, running.

    running   as the options have it; simulated unless ``--port`` says otherwise
    tick_hz   the rate asked for, for this machine alone; ``machine`` has it already
    port_won  ``--port`` was given: the machine's file is not asked for one
    local     its tables that are neither the shipped ones nor named by the operator
    """

    machine: Machine
    local: tuple[Path, ...]
    running: RunSettings
    link: Link
    recording: Recording

    def __init__(self, library: Library, machine: Machine, running: RunSettings, tick_hz: int | None, port_won: bool):
        self._library, self._asked = library, running
        self._rated, self._tick_hz, self._port_won = machine.name, tick_hz, port_won
        self._folder = Folder()
        try:
            self._take(machine, running)
        except BaseException:
            self._folder.close()
            raise

    def choose(self, name: str) -> Problems:
        """Another machine, or the same with its tables as they are now; refused before the old one is let go."""
        try:
            machine = self._library.machine(name)
            if self._tick_hz is not None and name == self._rated:
                machine = machine.at_rate(self._tick_hz)
            plant_of(machine, self._asked)
            if self._only_edited(machine):
                return self._load(bundle(machine))
        except (TableError, PortError) as error:
            return (str(error),)
        return self._change(machine, self._asked)

    def go_real(self) -> Problems:
        """On the port that its file configures."""
        if not self.port.configured:
            return (f"no port drives the card {self.port.card!r}; name one in its place (drillctl ports)",)
        return self._change(self.machine, on_port(self._asked, self.port.configured))

    def go_simulated(self) -> Problems:
        """Where it started, the position unknown."""
        return self._change(self.machine, simulated(self._asked))

    def set_tick_hz(self, hz: int) -> Problems:
        """Asks for another tick rate (PACE); what counts is the tick that serves it."""
        if not SLOWEST_TICK_HZ <= hz <= FASTEST_TICK_HZ:
            return (f"the tick rate can be {SLOWEST_TICK_HZ} to {FASTEST_TICK_HZ} Hz, not {hz}",)
        try:
            check_rate(self.machine.at_rate(hz), self.running)
        except PortError as error:
            return (str(error),)
        return () if self.link.set_rate(hz) else ("too many requests at once; try again",)

    def follow_rate(self) -> bool:
        """True where the ticker has come to another rate since the last call."""
        hz = int(self.link.status()["tick_hz"])
        if hz in (0, self.machine.tick_hz):
            return False
        self.machine = self.recording.machine = self.machine.at_rate(hz)
        return True

    @property
    def runs_free(self) -> bool:
        """As fast as it is turned, by no clock."""
        return pace_of(self.running) == FREE

    @property
    def site(self) -> Site:
        """Where a job runs that is begun now."""
        return site_of(self.running)

    @property
    def port(self) -> PortView:
        """The one in use, and what the machine's file says."""
        told = self.machine.configuration
        return PortView(
            self.running.port, not self.link.measured, told.mode, told.card, card_port(self.machine), self._port_won
        )

    @property
    def real_wanted(self) -> str:
        """The port that the machine's file asks for while a simulated one is in use; empty where it doesn't."""
        port = self.port
        return port.configured if port.mode == REAL.upper() and not (port.real or port.overridden) else ""

    def notices(self) -> Problems:
        """Which of its tables are local, and what became of ``--tick-hz`` and of the rate of the machine's file."""
        told = (local_tables([str(file) for file in self.local]),) if self.local else ()
        if self.machine.tick_hz != self._first_hz:
            return (*told, f"the tick rate was set to {self.machine.tick_hz} Hz; it was {self._first_hz}")
        if self._tick_hz is None:
            return told
        if self.machine.name == self._rated:
            return (*told, "--tick-hz is in force, not the rate of the machine's file")
        return (*told, "--tick-hz was for another machine: this one runs at its own rate")

    def close(self) -> None:
        """Everything that was started ends."""
        self.link.close()
        self._folder.close()

    def _only_edited(self, machine: Machine) -> bool:
        """The machine in use with other tables: it takes them while it runs. The very same is started anew."""
        same_rate = machine.tick_hz == self._first_hz  # as the file has it; the one in force stays
        edited = machine.digest != self.machine.digest
        tables_alone = same_rate and same_but_tables(machine.at_rate(self.machine.tick_hz), self.machine)
        return edited and tables_alone and not self.link.lost()

    def _load(self, text: str) -> Problems:
        """The port stays open, the carriages stay where they are."""
        if reason := self.link.load(text):
            return (reason,)
        self.machine = unbundle(text).at_rate(self.machine.tick_hz)
        self.local = self._library.local(self.machine.files)
        return ()

    def _change(self, machine: Machine, running: RunSettings) -> Problems:
        self.link.close()
        try:
            self._take(machine, running)
        except PortError as error:
            self._take(self.machine, simulated(self._asked))
            return (str(error),)
        return ()

    def _take(self, machine: Machine, running: RunSettings) -> None:
        """With a recording from its first tick. Raises PortError."""
        ring = Recording.ring_for(machine)
        link = start(machine, replace(running, kept=True), self._folder.path / KEPT_IN_FOLDERS, ring)
        self.machine, self.running, self.link = machine, running, link
        self._first_hz = machine.tick_hz  # before any PACE
        self.local = self._library.local(machine.files)
        self.recording = Recording(machine, link.plant_lanes, ring, lambda: int(link.status()["tick"]))
