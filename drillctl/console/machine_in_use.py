"""The machine in use: its link and port, the recording of its runs; changes to another machine or port.

Rule: the old one's outputs are safe before the new one starts; where that can't start, the machine that was in use is
started anew, simulated.
"""

from dataclasses import replace
from pathlib import Path

from drillctl.console.scope import RunRecording
from drillctl.files.scratch import KEPT_IN_FOLDERS, Folder
from drillctl.jobs.site import site_of
from drillctl.language import Message
from drillctl.machine import Library, Machine, TableError
from drillctl.machine.bundle import bundle, unbundle
from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ
from drillctl.plant import PlantChoice
from drillctl.ports import PortError
from drillctl.ticker.edited_tables import differs_in_tables_alone
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
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.fault_texts import local_tables
from drillctl.viewmodel.jobs import Site
from drillctl.viewmodel.signals import PortView


class MachineInUse:
    """One machine, running.

    running   by the options: simulated unless ``--port`` says otherwise
    tick_hz   the rate of ``--tick-hz``, for this machine alone; ``machine`` has it already
    port_won  ``--port`` was given, which wins over the port in the machine's file
    local     its tables that are neither the shipped ones nor named by the operator
    """

    machine: Machine
    local: tuple[Path, ...]
    running: RunSettings
    link: Link
    recording: RunRecording

    def __init__(self, library: Library, machine: Machine, running: RunSettings, tick_hz: int | None, port_won: bool):
        self._library, self._settings = library, running
        self._rate_is_for, self._tick_hz, self._port_won = machine.name, tick_hz, port_won
        self._folder = Folder()
        try:
            self._take(machine, running)
        except BaseException:
            self._folder.close()
            raise

    def choose(self, name: str) -> Problems:
        """Changes to a machine of the library. The one in use takes edited tables while it runs, or is started anew."""
        try:
            machine = self._library.machine(name)
            if self._tick_hz is not None and name == self._rate_is_for:
                machine = machine.at_rate(self._tick_hz)
            plant_of(machine, self._settings)
            if self._only_edited(machine):
                return self._load(bundle(machine))
        except (TableError, PortError) as error:
            return error.messages
        return self._change(machine, self._settings)

    def go_real(self) -> Problems:
        """Changes to the port that the machine's file configures; the position is unknown afterwards."""
        if not self.port.configured:
            return (
                Message(
                    "no port drives the card {card!r}; name one in its place (drillctl ports)", card=self.port.card
                ),
            )
        return self._change(self.machine, on_port(self._settings, self.port.configured))

    def go_simulated(self) -> Problems:
        """Changes to a simulated card; the position is unknown afterwards."""
        return self._change(self.machine, simulated(self._settings))

    def choose_plant(self, plant: PlantChoice) -> Problems:
        """Starts the simulated machine anew on another plant, which the machines chosen later have too."""
        if self.port.real:
            return (
                Message(
                    "a real machine is connected to {port} and has no plant; go back to the simulated one first (Port)",
                    port=self.running.port,
                ),
            )
        settings = replace(simulated(self._settings), plant=plant)
        try:
            plant_of(self.machine, settings)
        except PortError as error:
            return error.messages
        problems = self._change(self.machine, replace(self.running, plant=plant))
        if not problems:
            self._settings = settings
        return problems

    def set_tick_hz(self, hz: int) -> Problems:
        """Asks for another tick rate (PACE); it is in force from the tick that serves it."""
        if not SLOWEST_TICK_HZ <= hz <= FASTEST_TICK_HZ:
            return (
                Message(
                    "the tick rate can be {least} to {most} Hz, not {hz}",
                    least=SLOWEST_TICK_HZ,
                    most=FASTEST_TICK_HZ,
                    hz=hz,
                ),
            )
        try:
            check_rate(self.machine.at_rate(hz), self.running)
        except PortError as error:
            return error.messages
        return () if self.link.set_rate(hz) else (Message("too many requests at once; try again"),)

    def follow_rate(self) -> bool:
        """Takes over the tick rate in force; whether it is another one than at the last call."""
        hz = int(self.link.status()["tick_hz"])
        if hz in (0, self.machine.tick_hz):
            return False
        self.machine = self.recording.machine = self.machine.at_rate(hz)
        return True

    @property
    def runs_free(self) -> bool:
        """Whether no clock paces it: it runs as fast as it is called."""
        return pace_of(self.running) == FREE

    @property
    def site(self) -> Site:
        """The site of a job that is begun now."""
        return site_of(self.running)

    @property
    def port(self) -> PortView:
        """The port in use, and what the machine's file configures."""
        configured = self.machine.configuration
        return PortView(
            self.running.port,
            not self.link.measured,
            configured.mode,
            configured.card,
            card_port(self.machine),
            self._port_won,
        )

    @property
    def real_wanted(self) -> str:
        """The port that the machine's file asks for while a simulated one is in use; empty where it doesn't."""
        port = self.port
        return port.configured if port.mode == REAL.upper() and not (port.real or port.overridden) else ""

    def notices(self) -> Problems:
        """Sentences: which tables are local; why the tick rate is not that of the file or of ``--tick-hz``."""
        found = (local_tables([str(file) for file in self.local]),) if self.local else ()
        if self.machine.tick_hz != self._first_hz:
            return (
                *found,
                Message(
                    "the tick rate was set to {now} Hz; it was {before}",
                    now=self.machine.tick_hz,
                    before=self._first_hz,
                ),
            )
        if self._tick_hz is None:
            return found
        if self.machine.name == self._rate_is_for:
            return (*found, Message("--tick-hz is in force, not the rate of the machine's file"))
        return (*found, Message("--tick-hz was for another machine: this one runs at its own rate"))

    def close(self) -> None:
        """Ends the ticker, the outputs safe, and deletes the folder of its status file."""
        self.link.close()
        self._folder.close()

    def _only_edited(self, machine: Machine) -> bool:
        """Whether it is the machine in use with other phase tables or ramps, which it can take while it runs."""
        same_rate = machine.tick_hz == self._first_hz  # as the file has it; the one in force stays
        edited = machine.digest != self.machine.digest
        tables_alone = same_rate and differs_in_tables_alone(machine.at_rate(self.machine.tick_hz), self.machine)
        return edited and tables_alone and not self.link.lost()

    def _load(self, text: str) -> Problems:
        """Edited tables into the running ticker: the port stays open, the position known."""
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
            self._take(self.machine, simulated(self._settings))
            return error.messages
        return ()

    def _take(self, machine: Machine, running: RunSettings) -> None:
        """Starts a ticker and a recording of it from its first tick. Raises PortError."""
        ring = RunRecording.ring_for(machine)
        link = start(machine, replace(running, kept=True), self._folder.path / KEPT_IN_FOLDERS, ring)
        self.machine, self.running, self.link = machine, running, link
        self._first_hz = machine.tick_hz  # before any PACE
        self.local = self._library.local(machine.files)
        self.recording = RunRecording(machine, link.plant_lanes, ring, lambda: int(link.status()["tick"]))
