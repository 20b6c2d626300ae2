"""Where tables are found: ``--tables DIR``, the project's ``tables/``, the user's own, the shipped ones.

Rule: the first that has the file wins; a name never leaves its folder. Called by the wiring and the CLI.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from drillctl.machine.config import parse_machine
from drillctl.machine.errors import TableError
from drillctl.machine.hazards import phase_hazards
from drillctl.machine.model import Machine
from drillctl.machine.motor import Motor, read_motor
from drillctl.machine.phase import PhaseTable, parse_phase
from drillctl.machine.ramp import RampTable, parse_ramp
from drillctl.machine.source import Source

_PACKAGE = Path(__file__).resolve().parent.parent
Place = tuple[str | int, ...]


def shipped_tables() -> Path:
    """The tables that come with the program: inside an installed wheel, or beside the package in a checkout."""
    inside = _PACKAGE / "tables"
    return inside if inside.is_dir() else _PACKAGE.parent / "tables"


def user_tables() -> Path:
    """The folder of the user's own copies, which win over the shipped ones."""
    from platformdirs import user_config_path

    return user_config_path("drillctl", appauthor=False) / "tables"


@dataclass(frozen=True)
class Library:
    """The folders that are searched, first to last; each may hold phase/, ramp/, motor/ and machines/."""

    folders: tuple[Path, ...]

    @classmethod
    def standard(cls, extra: Path | None = None) -> "Library":
        """The usual search: ``extra`` (``--tables``), ``./tables``, the user's, the shipped."""
        usual = (Path("tables"), user_tables(), shipped_tables())
        return cls((*([extra] if extra else []), *usual))

    def machine_names(self) -> list[str]:
        """The names of all machines that can be found, sorted."""
        return sorted({file.stem for folder in self.folders for file in (folder / "machines").glob("*.toml")})

    def machine(self, name_or_file: str) -> Machine:
        """A machine by its name, or by its file's path (anything with a slash or ``.toml``). Raises TableError."""
        if "/" in name_or_file or name_or_file.endswith(".toml"):
            file = Path(name_or_file)
            return Library((_tables_beside(file), *self.folders))._parse(file)
        found = self._find("machines", name_or_file)
        if found is None:
            known = ", ".join(self.machine_names())
            raise TableError(name_or_file, f"no machine of this name; there are {known}")
        return self._parse(found)

    def check(self, file: Path) -> list[str]:
        """Reads any table; returns its hazards as sentences. Raises TableError where it can't be used."""
        source = Source.read(file)
        if "[[wire]]" in source.text:
            table = parse_phase(source)
            return phase_hazards(table, self._motor(None, table, source, ("name",)))
        if "[[state]]" in source.text:
            parse_ramp(source)
            return []
        if "[[axis]]" in source.text:
            return machine_hazards(self.machine(str(file.absolute())))
        if "[windings]" in source.text or "columns_per_pulse" in source.text:
            read_motor(file)
            return []
        reason = "neither a phase table, a ramp, a motor nor a machine: no [[wire]], [[state]] or [[axis]]"
        raise TableError(file, reason)

    def _parse(self, file: Path) -> Machine:
        shipped = shipped_tables() in file.resolve().parents
        return parse_machine(Source.read(file), shipped, self._phase, self._ramp, self._motor)

    def _find(self, kind: str, name: str) -> Path | None:
        if Path(name).name != name:
            return None
        files: Iterator[Path] = (folder / kind / f"{name}.toml" for folder in self.folders)
        return next((file for file in files if file.is_file()), None)

    def _found(self, kind: str, name: str, source: Source, place: Place) -> Path:
        file = self._find(kind, name)
        if file is None:
            raise source.error(f"no {kind} table is named {name!r}", *place)
        return file

    def _phase(self, name: str, source: Source, place: Place) -> PhaseTable:
        return parse_phase(Source.read(self._found("phase", name, source, place)))

    def _ramp(self, name: str, source: Source, place: Place) -> RampTable:
        return parse_ramp(Source.read(self._found("ramp", name, source, place)))

    def _motor(self, name: str | None, table: PhaseTable, source: Source, place: Place) -> Motor:
        """The motor named, or the one whose windings are just the wires of the table, forcing wires apart."""
        wires = {wire.name for wire in table.wires if not wire.forcing}
        if name is not None:
            motor = read_motor(self._found("motor", name, source, place))
            if not motor.wire_names() <= wires:
                missing = ", ".join(sorted(motor.wire_names() - wires))
                raise source.error(f"motor {name} needs wires {missing}; table {table.name} has none", *place)
            return motor
        for folder in self.folders:
            for file in sorted((folder / "motor").glob("*.toml")):
                if (motor := read_motor(file)).wire_names() == wires:
                    return motor
        raise source.error(f"no motor has just the wires {', '.join(sorted(wires))}; name one", *place)


def _tables_beside(machine_file: Path) -> Path:
    """The folder whose phase/, ramp/ and motor/ belong to a machine that is given by its file."""
    folder = machine_file.resolve().parent
    return folder.parent if folder.name == "machines" else folder


def machine_hazards(machine: Machine) -> list[str]:
    """The hazards of all the phase tables of a machine, each table once."""
    tables = {axis.phase: axis.motor for axis in machine.axes}
    return [f"{table.name}: {hazard}" for table, motor in tables.items() for hazard in phase_hazards(table, motor)]
