"""What can be wrong with a simulated machine, written as ``NAME=VALUE`` or ``NAME.PART=VALUE``.

Rule: a fault is one number, of a sensor, an axis or the drill; only the dynamic plant has faults.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from drillctl.language import Message, Refusal, nearest
from drillctl.machine import Machine
from drillctl.machine.head_lines import CHUCK, answering_inputs, head_output


class PlantRefused(Refusal):
    """A plant that this machine can't have. ``str()`` says why, and what to do."""

    kind = "plant"


@dataclass(frozen=True, slots=True)
class FaultKind:
    """What a fault's value means, and its bounds; ``part`` is what it belongs to: a sensor, the wire of a sensor, of an
    encoder's index or of an input that answers to outputs, an axis, a head with a chuck of its own, or nothing.
    """

    part: str
    least: float
    most: float
    meaning: Message


FAULT_KINDS = {
    "stuck": FaultKind("wire", 0, 1, Message("answers never (0) or always (1)")),
    "dirty": FaultKind("sensor", -20, 20, Message("answers N mm too late")),
    "bouncing": FaultKind("sensor", 1, 1000, Message("flutters for N ticks after each change")),
    "loose": FaultKind("axis", 0, 20, Message("mm of play in the belt")),
    "jammed": FaultKind("axis", 1, 1000, Message("friction of the guide, N times the table's")),
    "blunt": FaultKind("", 0, 1000, Message("metres of board that the drill has cut already")),
    "worn": FaultKind("head", 0, 1000, Message("metres of board that its bit has cut already, instead of blunt")),
    "broken": FaultKind("", 1, 1, Message("the drill is off and meets no board")),
    "breaks": FaultKind("head", 1, 1_000_000, Message("its bit breaks when it meets the board for the N-th time")),
    "missing": FaultKind("head", 1, 999, Message("place N of the magazine has no bit for its spindle")),
    "dropped": FaultKind("head", 1, 1_000_000, Message("the N-th bit that its chuck takes falls out on the way up")),
}
_FORM = re.compile(r"([a-z]+)(?:\.([A-Za-z0-9_-]+))?=(-?\d+(?:\.\d+)?)")


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault: ``part`` is the name of a sensor or an axis, or empty."""

    name: str
    part: str
    value: float

    def __str__(self) -> str:
        return f"{self.name}.{self.part}" if self.part else self.name


class Faults:
    """All faults of a machine. Raises PlantRefused for a fault that this machine can't have."""

    def __init__(self, texts: Iterable[str], machine: Machine):
        sensors = [sensor.name for sensor in machine.sensors]
        wires = [*sensors, *(index.name for index in machine.indexes)]
        wires += [name for name, *_ in answering_inputs(machine)]
        parts = {"sensor": sensors, "wire": wires, "axis": machine.axis_names, "": [""]}
        parts["head"] = [machine.axes[head].name for head in machine.drill_axes if head_output(machine, CHUCK, head)]
        self._values: dict[tuple[str, str], float] = {}
        for fault in [parse_fault(text) for text in texts]:
            kind = FAULT_KINDS[fault.name].part
            if fault.part not in parts[kind]:
                has, meant = ", ".join(parts[kind]), nearest(fault.part, parts[kind])
                hint = Message("; did you mean {usage}?", usage=f"{fault.name}.{meant}=N") if meant else ""
                raise PlantRefused(
                    Message(
                        "fault {name}: {machine} has no {kind} {part!r}; it has {has}{hint}",
                        name=fault.name,
                        machine=machine.name,
                        kind=kind,
                        part=fault.part,
                        has=has,
                        hint=hint,
                    )
                )
            if (fault.name, fault.part) in self._values:
                raise PlantRefused(Message("fault {fault}: given twice", fault=fault))
            self._values[fault.name, fault.part] = fault.value

    def of(self, name: str, part: str = "") -> float | None:
        """Returns the value of a fault, or None where the machine doesn't have it."""
        return self._values.get((name, part))


def parse_fault(text: str) -> Fault:
    """Reads a fault from its text. Raises PlantRefused."""
    found = _FORM.fullmatch(text)
    kind = FAULT_KINDS.get(found[1]) if found else None
    if found is None or kind is None:
        word = re.split("[.=]", text, maxsplit=1)[0]
        meant = nearest(word, FAULT_KINDS)
        hint = _meant(meant) if meant else ""
        raise PlantRefused(
            Message(
                "fault {text!r}: not known; there are {names}{hint}",
                text=text[:60],
                names=", ".join(map(usage, FAULT_KINDS)),
                hint=hint,
            )
        )
    if bool(found[2]) != bool(kind.part):
        raise PlantRefused(Message("fault {text!r}: it is written {usage}", text=text[:60], usage=usage(found[1])))
    if not kind.least <= float(found[3]) <= kind.most:
        raise PlantRefused(
            Message(
                "fault {text!r}: {meaning}: from {least:g} to {most:g}",
                text=text[:60],
                meaning=kind.meaning,
                least=kind.least,
                most=kind.most,
            )
        )
    return Fault(found[1], found[2] or "", float(found[3]))


def fault_lines() -> list[str]:
    """Returns a line for each kind of fault: how it is written and what it means."""
    return [f"{usage(name):20} {kind.meaning}" for name, kind in FAULT_KINDS.items()]


def _meant(name: str) -> Message:
    kind = FAULT_KINDS[name]
    return Message(
        "; did you mean {usage}, N from {least:g} to {most:g}?", usage=usage(name), least=kind.least, most=kind.most
    )


def usage(name: str) -> str:
    """Returns how a kind of fault is written: ``blunt=N``, ``loose.AXIS=N``."""
    part = FAULT_KINDS[name].part
    return f"{name}.{part.upper()}=N" if part else f"{name}=N"
