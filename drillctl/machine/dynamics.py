"""What the dynamic plant must know of a motor and its load: windings, supply, torque, inertia, friction.

Rule: SI units, named in the key. Only the plant uses them, so they are no part of a machine's digest. Two kinds of
motors can be described: ``unipolar`` (two phases with centre taps, a magnet) and ``reluctance`` (three or five phases,
no magnet, each winding on a chopper).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Literal

import msgspec

from drillctl.language import Message
from drillctl.machine.motor import Motor
from drillctl.machine.phase import Name, PhaseTable
from drillctl.machine.source import Source

KINDS = ("unipolar", "reluctance")  # in the order of plant/dynamic/law.py
# The half windings of a unipolar motor, by their electrical degrees: the order of the plant's currents.
WINDING_DEGREES = (0, 180, 270, 90)
# The keys that only one kind has, and must have.
OWN_KEYS = {
    "unipolar": ("forcing_volts", "torque_nm_per_a", "detent_nm"),
    "reluctance": ("phases", "current_a", "torque_nm_per_a2"),
}
Amount = Annotated[float, msgspec.Meta(gt=0, le=1e6)]
Torque = Annotated[float, msgspec.Meta(ge=0, le=1e3)]
Volts = Annotated[float, msgspec.Meta(ge=0, le=400)]


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    cycles_per_turn: Annotated[int, msgspec.Meta(ge=1, le=400)]
    normal_volts: Volts
    switch_volts: Volts
    freewheel_volts: Volts
    resistance_ohm: Amount
    inductance_h: Amount
    inertia_kgm2: Amount
    viscous_nms: Torque
    coulomb_nm: Torque
    kind: Literal["unipolar", "reluctance"] = "unipolar"
    forcing_volts: Volts | None = None
    torque_nm_per_a: Amount | None = None
    detent_nm: Torque | None = None
    phases: Literal[3, 5] | None = None
    current_a: Amount | None = None
    torque_nm_per_a2: Amount | None = None
    description: str = ""
    forcing: dict[str, list[str]] = {}


@dataclass(frozen=True, slots=True)
class Dynamics:
    """A motor and what it moves, as seen from its shaft.

    cycles_per_turn   electrical cycles to a turn of the shaft: the rotor's teeth
    switch_volts      voltage lost in switch and diode of a winding that is on
    freewheel_volts   voltage across the diode that drives the current of a winding that is off down
    torque_nm_per_a   of one half winding at its best angle; the back-EMF in V s too
    forcing           pairs: a forcing wire, and the half windings that it feeds while they are on
    kind              one of KINDS; what follows is a reluctance motor's alone, as detent and forcing are a unipolar's
    windings          how many: the phases of a reluctance motor
    current_a         at which the chopper of a winding holds its current
    torque_nm_per_a2  K = teeth x half the inductance's swing; the torque of a winding is K/2 i^2 at its best angle
    """

    name: str
    cycles_per_turn: int
    normal_volts: float
    forcing_volts: float
    switch_volts: float
    freewheel_volts: float
    resistance_ohm: float
    inductance_h: float
    torque_nm_per_a: float
    inertia_kgm2: float
    viscous_nms: float
    coulomb_nm: float
    detent_nm: float
    forcing: tuple[tuple[str, tuple[str, ...]], ...] = ()
    kind: str = "unipolar"
    windings: int = len(WINDING_DEGREES)
    current_a: float = 0.0
    torque_nm_per_a2: float = 0.0

    @property
    def degrees(self) -> tuple[int, ...]:
        """Returns where the windings pull the rotor, in electrical degrees: the order of the plant's currents."""
        if self.kind == "unipolar":
            return WINDING_DEGREES
        return tuple(range(0, 360, 360 // self.windings))


def parse_dynamics(source: Source) -> Dynamics:
    """Reads a motor and its load from a file's text. Raises TableError."""
    raw = source.records(_File)
    fields = msgspec.structs.asdict(raw)
    _check_kind(source, raw.kind, fields)
    if raw.kind == "unipolar":
        if fields["forcing_volts"] < raw.normal_volts:
            raise source.error(Message("forcing_volts is below normal_volts"), "forcing_volts")
        fields.update(phases=len(WINDING_DEGREES), current_a=0.0, torque_nm_per_a2=0.0)
    else:
        fields.update(forcing_volts=raw.normal_volts, torque_nm_per_a=0.0, detent_nm=0.0)
    del fields["description"]
    fields["windings"] = fields.pop("phases")
    fields["forcing"] = tuple((wire, tuple(windings)) for wire, windings in raw.forcing.items())
    return Dynamics(**fields)


def _check_kind(source: Source, kind: str, fields: Mapping[str, object]) -> None:
    """Raises TableError where a key of this kind of motor is missing, or one of another kind is there."""
    for of, keys in OWN_KEYS.items():
        for key in keys:
            if of == kind and fields[key] is None:
                raise source.error(Message("{name} is missing", name=key), key)
            if of != kind and fields[key] is not None:
                raise source.error(Message("{key} belongs to a {kind} motor", key=key, kind=of), key)
    if kind != "unipolar" and fields["forcing"]:
        raise source.error(Message("{key} belongs to a {kind} motor", key="forcing", kind="unipolar"), "forcing")


def misfit(dynamics: Dynamics, motor: Motor, phase: PhaseTable) -> Message | None:
    """Returns why these dynamics can't describe the motor with this phase table, or None where they can."""
    if sorted(angle % 360 for _, angle in motor.windings) != sorted(dynamics.degrees):
        return _wrong_windings(dynamics, motor)
    forcing = {wire.name for wire in phase.wires if wire.forcing}
    if unfed := forcing - {wire for wire, _ in dynamics.forcing}:
        return Message(
            "forcing wire {wire} of table {table} is not under [forcing] of dynamics {dynamics}",
            wire=min(unfed),
            table=phase.name,
            dynamics=dynamics.name,
        )
    named = {winding for wire, windings in dynamics.forcing if wire in forcing for winding in windings}
    if strange := named - motor.wire_names():
        return Message(
            "dynamics {name}: motor {motor} has no winding {winding}",
            name=dynamics.name,
            motor=motor.name,
            winding=min(strange),
        )
    return None


def _wrong_windings(dynamics: Dynamics, motor: Motor) -> Message:
    if dynamics.kind == "unipolar":
        return Message(
            "motor {name} has not the four half windings, a quarter cycle apart, that dynamics are told of",
            name=motor.name,
        )
    return Message(
        "motor {name} has not the {phases} windings at {degrees} degrees that dynamics {dynamics} describes",
        name=motor.name,
        phases=dynamics.windings,
        degrees=", ".join(map(str, dynamics.degrees)),
        dynamics=dynamics.name,
    )
