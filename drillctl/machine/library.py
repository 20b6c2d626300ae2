"""Where tables are found: ``--tables DIR``, the project's ``tables/``, the user's own, the shipped ones.

Rule: the first folder that has the file wins; a name never leaves its folder. A table that nobody asked for by name and
that is not the shipped one (from ``./tables``, or the user's own folder) is reported to ``tell``.
"""

import logging
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from drillctl.files.inputs import read_bytes, real_path
from drillctl.files.shipped import shipped
from drillctl.language import Message, known_words
from drillctl.machine.config import parse_machine
from drillctl.machine.converter import parse_converter
from drillctl.machine.dynamics import parse_dynamics
from drillctl.machine.errors import TableError
from drillctl.machine.hazards import phase_hazards
from drillctl.machine.model import Machine
from drillctl.machine.motor import parse_motor
from drillctl.machine.parts import Parts, find_table
from drillctl.machine.phase import parse_phase
from drillctl.machine.ramp_figures import axis_figures, machine_figures, ramp_figures
from drillctl.machine.ramp_file import computed_figures, parse_ramp
from drillctl.machine.source import LARGEST_TABLE_BYTES, Source

LOG = logging.getLogger(__name__)


def shipped_tables() -> Path:
    """Returns the folder of the tables that come with the program."""
    return shipped("tables", "tables")


def user_tables() -> Path:
    """Returns the folder of the user's own tables, which win over the shipped ones."""
    from platformdirs import user_config_path

    return user_config_path("drillctl", appauthor=False) / "tables"


def tell_nobody(files: tuple[Path, ...]) -> None:
    """Ignores the local tables: the ``tell`` of callers that look at ``Library.local`` themselves."""


@dataclass(frozen=True)
class Library:
    """The folders that are searched, first to last; each may hold phase/, ramp/, motor/, dynamics/ and machines/.

    unasked  those of them that are searched without the operator naming them, the shipped ones apart
    tell     called with the local tables (``local``) of whatever is read, before it is used
    """

    folders: tuple[Path, ...]
    unasked: tuple[Path, ...] = ()
    tell: Callable[[tuple[Path, ...]], None] = tell_nobody

    @classmethod
    def standard(cls, extra: Path | None = None) -> "Library":
        """Returns the usual library: ``extra`` (``--tables``), ``./tables``, the user's folder, the shipped tables.

        In a checkout ``./tables`` is the shipped folder itself; it is then searched last, not before the user's.
        """
        shipped, project = shipped_tables(), Path("tables")
        own = [] if real_path(project) == shipped else [project]
        named = real_path(extra) if extra else shipped
        unasked = tuple(folder for folder in (*own, user_tables()) if real_path(folder) not in (named, shipped))
        return cls((*([extra] if extra else []), *own, user_tables(), shipped), unasked)

    def local(self, files: Iterable[str | Path]) -> tuple[Path, ...]:
        """Returns those of these table files that are in an ``unasked`` folder and differ from the shipped ones."""
        folders = {real_path(folder) for folder in self.unasked}
        found = [Path(file) for file in files if real_path(Path(file)).parent.parent in folders]
        return tuple(file for file in found if not _is_shipped(file))

    def machine_names(self) -> list[str]:
        """Returns the names of all machines that can be found, sorted."""
        return self.names("machines")

    def names(self, kind: str) -> list[str]:
        """Returns the names of all tables of a kind (phase, ramp, motor, dynamics, machines) that
        can be found, sorted.
        """
        return sorted({file.stem for folder in self.folders for file in (folder / kind).glob("*.toml")})

    def find(self, kind: str, name: str) -> Path | None:
        """Returns the file of a table in the first folder that has it, or None."""
        found = find_table(self.folders, kind, name)
        if found is not None and (local := self.local([found])):
            self.tell(local)
        return found

    def machine(self, name_or_file: str) -> Machine:
        """Returns a machine by its name, or by its file's path (anything with a slash or
        ``.toml``). Raises TableError.
        """
        if "/" in name_or_file or name_or_file.endswith(".toml"):
            return self.machine_of(Source.read(Path(name_or_file)))
        found = find_table(self.folders, "machines", name_or_file)
        if found is None:
            hint = known_words(name_or_file, self.machine_names())
            raise TableError(name_or_file, Message("no machine of this name; {words}", words=hint))
        return self._parse(Source.read(found))

    def check(self, file: Path) -> list[Message]:
        """Reads any table; returns its hazards as sentences. Raises TableError where it can't be used."""
        return self.check_source(Source.read(file))

    def figures(self, source: Source) -> list[Message]:
        """Returns what the ramps of a machine's or a ramp's text ask of their carriages, a sentence each; of other
        tables none. A ramp in rows of ticks is told for each axis that has it. Raises TableError.
        """
        written = source.tree()
        if "axis" in written:
            return list(machine_figures(self.machine_of(source)))
        if not {"state", "computed"} & written.keys():
            return []
        ramp, figures = parse_ramp(source), computed_figures(source)
        if figures is not None:
            return [ramp_figures(ramp, figures.tick_hz, figures.pulse_mm).sentence()]
        return [
            Message(
                "{axis}: {figures}",
                axis=f"{name}.{axis.name}",
                figures=axis_figures(replace(axis, ramp=ramp), machine.tick_hz).sentence(),
            )
            for name, machine in self._readable_machines()
            for axis in machine.axes
            if axis.ramp.name == ramp.name
        ]

    def check_source(self, source: Source) -> list[Message]:
        """Like ``check``, for a text that need not be in its file yet."""
        written = source.tree()
        for key, hazards in _KINDS.items():
            if key in written:
                return hazards(self, source)
        kinds = Message("a phase table has [[wire]], a ramp [[state]], a motor [windings], a machine [[axis]]")
        others = Message("dynamics have inertia_kgm2, a converter protocol")
        raise TableError(
            source.file, Message("no table of this program: {kinds}, {others}", kinds=kinds, others=others)
        )

    def _readable_machines(self) -> Iterator[tuple[str, Machine]]:
        for name in self.machine_names():
            with suppress(TableError):  # a machine that is wrong is told where it is asked for
                yield name, self.machine(name)

    def machine_of(self, source: Source) -> Machine:
        """Returns a machine given by its file, with the tables beside it searched first."""
        beside = tables_beside(source.file)
        unasked = tuple(folder for folder in self.unasked if real_path(folder) != real_path(beside))
        return replace(self, folders=(beside, *self.folders), unasked=unasked)._parse(source)

    def _parse(self, source: Source) -> Machine:
        shipped = shipped_tables() in real_path(source.file).parents
        machine = parse_machine(source, shipped, Parts(self.folders, source.file))
        LOG.info("machine %s is read from %s", machine.name, ", ".join(dict.fromkeys(machine.files)))
        if local := self.local(machine.files):
            self.tell(local)
        return machine if shipped else replace(machine, shipped=_same_as_shipped(machine.files))

    def _phase_hazards(self, source: Source) -> list[Message]:
        table = parse_phase(source)
        return phase_hazards(table, Parts(self.folders, source.file).motor(None, table, source, ("name",)))

    def _machine_hazards(self, source: Source) -> list[Message]:
        return machine_hazards(self.machine_of(source))

    def _ramp_hazards(self, source: Source) -> list[Message]:
        parse_ramp(source)
        return []

    def _motor_hazards(self, source: Source) -> list[Message]:
        parse_motor(source)
        return []

    def _converter_hazards(self, source: Source) -> list[Message]:
        parse_converter(source)
        return []

    def _dynamics_hazards(self, source: Source) -> list[Message]:
        parse_dynamics(source)
        return []


# What a table is, by a key that only its kind has.
_KINDS: Mapping[str, Callable[[Library, Source], list[Message]]] = {
    "wire": Library._phase_hazards,
    "state": Library._ramp_hazards,
    "computed": Library._ramp_hazards,
    "axis": Library._machine_hazards,
    "windings": Library._motor_hazards,
    "pulse": Library._motor_hazards,
    "inertia_kgm2": Library._dynamics_hazards,
    "protocol": Library._converter_hazards,
}


def _same_as_shipped(files: tuple[str, ...]) -> bool:
    """Returns whether all of a machine's files are shipped ones, to the byte: a checkout where the program is installed
    too. Its traces then call the machine by its name, and can be replayed elsewhere.
    """
    return all(map(_is_shipped, map(Path, files)))


def _is_shipped(file: Path) -> bool:
    """Returns whether the file is the shipped table of its kind and name, or equal to it; a text that is not saved yet
    is not.
    """
    return file.is_file() and _same_bytes(file, shipped_tables() / file.parent.name / file.name)


def _same_bytes(file: Path, other: Path) -> bool:
    return file.is_file() and other.is_file() and _bytes(file) == _bytes(other)  # a text need not be in its file yet


def _bytes(file: Path) -> bytes:
    return read_bytes(file, LARGEST_TABLE_BYTES, Message("a table"))


def tables_beside(machine_file: Path) -> Path:
    """Returns the folder whose phase/, ramp/ and motor/ belong to a machine that is given by its file."""
    folder = real_path(machine_file).parent
    return folder.parent if folder.name == "machines" else folder


def machine_hazards(machine: Machine) -> list[Message]:
    """Returns the hazards of all the phase tables of a machine, each table once."""
    tables = {axis.phase: axis.motor for axis in machine.axes}
    return [hazard.at(table.name) for table, motor in tables.items() for hazard in phase_hazards(table, motor)]
