"""What comes up to a person: how far a job is, and how it ended. Plain records; ``as_dict`` is the JSON form."""

from collections.abc import Mapping
from typing import Any

import msgspec


class Progress(msgspec.Struct, frozen=True):
    """A job on its way. ``seconds_left`` is machine time (a bar makes of it the wait), None while nobody can tell."""

    holes_done: int
    holes_total: int
    tool: int
    ticks: int
    machine_seconds: float
    seconds_left: float | None
    held: bool = False  # by the operator


class FaultReport(msgspec.Struct, frozen=True):
    """A fault in words: what it is called, why, what to do, whether the position was kept or lost, and the axes that it
    is about, as far as that is known.
    """

    code: int
    name: str
    cause: str
    remedy: str
    position: str  # "kept" or "lost"
    axes: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """Its name, with the axes that it is about."""
        return f"{self.name} ({', '.join(self.axes)})" if self.axes else self.name

    def as_dict(self) -> dict[str, Any]:
        """The fault as an object of the JSON output."""
        return msgspec.structs.asdict(self)


class Outcome(msgspec.Struct, frozen=True):
    """How a job ended (docs/SPEC.md, section 4). By axis: steps made, position, lost steps (None on a real port).
    ``suspect`` are the numbers of holes that are done and may be bad: the last before a bit was found broken.
    """

    machine: str
    holes_done: int
    holes_total: int
    ticks: int
    tick_hz: int
    steps: Mapping[str, int]
    position: Mapping[str, int]
    position_known: bool
    lost_steps: Mapping[str, int] | None
    underruns: int
    fault: FaultReport | None
    late_count: int = 0
    late_greatest_ms: float = 0.0
    interrupted: bool = False
    suspect: tuple[int, ...] = ()

    @property
    def machine_seconds(self) -> float:
        """The machine time of the ticks that were run, in seconds."""
        return self.ticks / self.tick_hz

    def as_dict(self) -> dict[str, Any]:
        """The object that ``run --json`` prints."""
        fault = self.fault
        return {
            "machine": self.machine,
            "holes_done": self.holes_done,
            "holes_total": self.holes_total,
            "ticks": self.ticks,
            "tick_hz": self.tick_hz,
            "machine_seconds": self.machine_seconds,
            "steps": dict(self.steps),
            "position": dict(self.position),
            "position_known": self.position_known,
            "lost_steps": None if self.lost_steps is None else dict(self.lost_steps),
            "late": {"count": self.late_count, "greatest_ms": self.late_greatest_ms},
            "starved": self.underruns,
            "interrupted": self.interrupted,
            "suspect": list(self.suspect),
            "fault": fault and fault.as_dict(),
        }


class ToolEstimate(msgspec.Struct, frozen=True):
    """One tool's share of a job: its holes, the ticks from its change to the next, the drill that serves it."""

    number: int
    diameter_mm: float | None
    holes: int
    ticks: int
    drill_mm: float | None = None
    hits_left: int | None = None  # of the drill's life


class Estimate(msgspec.Struct, frozen=True):
    """What a job will take. Exact on the ideal plant from the machine file's start; the operator's waits apart."""

    machine: str
    holes_total: int
    ticks: int
    tick_hz: int
    tools: tuple[ToolEstimate, ...]
    exact: bool
    fault: FaultReport | None

    def as_dict(self) -> dict[str, Any]:
        """The object that ``estimate --json`` prints."""
        return {
            "machine": self.machine,
            "holes_total": self.holes_total,
            "ticks": self.ticks,
            "tick_hz": self.tick_hz,
            "machine_seconds": self.ticks / self.tick_hz,
            "exact": self.exact,
            "tools": [
                {
                    "number": tool.number,
                    "diameter_mm": tool.diameter_mm,
                    "holes": tool.holes,
                    "ticks": tool.ticks,
                    "machine_seconds": tool.ticks / self.tick_hz,
                    "drill_mm": tool.drill_mm,
                    "hits_left": tool.hits_left,
                }
                for tool in self.tools
            ],
            "fault": self.fault and self.fault.as_dict(),
        }
