"""Finds and reads the phase, ramp, motor and dynamics tables that a machine's file names, and remembers the files read.

Rule: the first folder that has the file wins; a name never leaves its folder.
"""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from drillctl.language import Message, known_words
from drillctl.machine.dynamics import Dynamics, misfit, parse_dynamics
from drillctl.machine.motor import Motor, parse_motor
from drillctl.machine.phase import PhaseTable, parse_phase
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_file import parse_ramp, scale_misfit
from drillctl.machine.source import Source

Place = tuple[str | int, ...]


def find_table(folders: Sequence[Path], kind: str, name: str) -> Path | None:
    """Returns the file of a table in the first folder that has it, or None; ``kind`` is the folder's name."""
    if Path(name).name != name:
        return None
    files = (folder / kind / f"{name}.toml" for folder in folders)
    return next((file for file in files if os.path.isfile(file)), None)  # False also for a name too long


class Parts:
    """The tables of one machine's file. ``files`` are all files that were read for it, the machine's own first.

    Each method raises TableError, at ``place`` in the machine's ``source`` where there is no such table.
    """

    def __init__(self, folders: Sequence[Path], machine_file: Path):
        self._folders = folders
        self.files = [machine_file]

    def phase(self, name: str, source: Source, place: Place) -> PhaseTable:
        """Returns the phase table of this name."""
        return parse_phase(self._open("phase", name, source, place))

    def ramp(self, name: str, scale: tuple[int, float], source: Source, place: Place) -> RampTable:
        """Returns the ramp of this name. One that is computed must be computed for the machine's own scale."""
        found = self._open("ramp", name, source, place)
        ramp = parse_ramp(found)
        if reason := scale_misfit(found, *scale):
            raise source.error(reason, *place)
        return ramp

    def motor(self, name: str | None, table: PhaseTable, source: Source, place: Place) -> Motor:
        """Returns the motor of this name; without a name the one whose windings are just the wires of the phase table,
        forcing wires apart.
        """
        wires = {wire.name for wire in table.wires if not wire.forcing}
        if name is None:
            return self._motor_for(wires, source, place)
        motor = parse_motor(self._open("motor", name, source, place))
        if missing := motor.wire_names() - wires:
            needs = ", ".join(sorted(missing))
            raise source.error(
                Message(
                    "motor {motor} needs wires {wires}; table {table} has none",
                    motor=name,
                    wires=needs,
                    table=table.name,
                ),
                *place,
            )
        return motor

    def dynamics(
        self, name: str | None, motor: Motor, table: PhaseTable, source: Source, place: Place
    ) -> Dynamics | None:
        """Returns the dynamics of this name, which must fit the motor and its wires; None without a name."""
        if name is None:
            return None
        dynamics = parse_dynamics(self._open("dynamics", name, source, place))
        if reason := misfit(dynamics, motor, table):
            raise source.error(reason, *place)
        return dynamics

    def _motor_for(self, wires: set[str], source: Source, place: Place) -> Motor:
        for found in self._motors():
            motor = parse_motor(found)
            if motor.wire_names() == wires:
                self.files.append(found.file)
                return motor
        raise source.error(
            Message("no motor has just the wires {wires}; name one", wires=", ".join(sorted(wires))), *place
        )

    def _open(self, kind: str, name: str, source: Source, place: Place) -> Source:
        found = self._find(kind, name)
        if found is None:
            names = sorted({file.stem for folder in self._folders for file in (folder / kind).glob("*.toml")})
            raise source.error(
                Message(
                    "no {kind} table is named {name!r}; {words}",
                    kind=kind,
                    name=name[:60],
                    words=known_words(name, names),
                ),
                *place,
            )
        self.files.append(found.file)
        return found

    def _find(self, kind: str, name: str) -> Source | None:
        file = find_table(self._folders, kind, name)
        return Source.read(file) if file else None

    def _motors(self) -> Iterator[Source]:
        files = (file for folder in self._folders for file in sorted((folder / "motor").glob("*.toml")))
        return map(Source.read, files)
