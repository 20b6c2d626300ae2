"""What the dynamic plant must know of a motor and its load: windings, supply, torque, inertia, friction.

Rule: SI units, named in the key. Only the plant uses them, so they are no part of a machine's digest. Three
kinds of motors can be described: ``unipolar`` (two phases with centre taps, a magnet), ``reluctance`` (three or five
phases, no magnet, each winding on a chopper) and ``drive`` (a servo motor in a drive that takes pulse and direction).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Literal

import msgspec

from drillctl.language import Message
from drillctl.machine.motor import Motor
from drillctl.machine.phase import Name, PhaseTable
from drillctl.machine.source import Source

KINDS = ("unipolar", "reluctance", "drive")  # in the order of plant/dynamic/motors.py
# The half windings of a unipolar motor, by their electrical degrees: the order of the plant's currents.
WINDING_DEGREES = (0, 180, 270, 90)
# The keys that a kind must have, and that no kind without them may have.
OWN_KEYS = {
    "unipolar": ("forcing_volts", "torque_nm_per_a", "detent_nm"),
    "reluctance": ("phases", "current_a", "torque_nm_per_a2"),
    "drive": ("torque_nm_per_a", "current_a", "bandwidth_hz", "error_pulses"),
}
Amount = Annotated[float, msgspec.Meta(gt=0, le=1e6)]
Torque = Annotated[float, msgspec.Meta(ge=0, le=1e3)]
Volts = Annotated[float, msgspec.Meta(ge=0, le=400)]


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    cycles_per_turn: Annotated[int, msgspec.Meta(ge=1, le=100_000)]
    normal_volts: Volts
    switch_volts: Volts
    freewheel_volts: Volts
    resistance_ohm: Amount
    inductance_h: Amount
    inertia_kgm2: Amount
    viscous_nms: Torque
    coulomb_nm: Torque
    kind: Literal["unipolar", "reluctance", "drive"] = "unipolar"
    forcing_volts: Volts | None = None
    torque_nm_per_a: Amount | None = None
    detent_nm: Torque | None = None
    phases: Literal[3, 5] | None = None
    current_a: Amount | None = None
    torque_nm_per_a2: Amount | None = None
    bandwidth_hz: Annotated[float, msgspec.Meta(gt=0, le=500)] | None = None
    error_pulses: Annotated[int, msgspec.Meta(ge=1, le=1_000_000)] | None = None
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
    bandwidth_hz      of a drive: its motor follows its pulses like a critically damped swing of this frequency; a drive
                      has one winding, ``cycles_per_turn`` are its pulses, ``current_a`` is the most that it gives
    error_pulses      the following error at which it trips
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
    bandwidth_hz: float = 0.0
    error_pulses: int = 0

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
        fields["phases"] = len(WINDING_DEGREES)
    else:
        fields["forcing_volts"] = raw.normal_volts
    if raw.kind == "drive":
        fields["phases"] = 1
    fields.update({key: 0.0 for key in fields if fields[key] is None})  # what is of another kind
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
            if key not in OWN_KEYS[kind] and fields[key] is not None:
                raise source.error(Message("{key} belongs to a {kind} motor", key=key, kind=of), key)
    if kind != "unipolar" and fields["forcing"]:
        raise source.error(Message("{key} belongs to a {kind} motor", key="forcing", kind="unipolar"), "forcing")


def misfit(dynamics: Dynamics, motor: Motor, phase: PhaseTable) -> Message | None:
    """Returns why these dynamics can't describe the motor with this phase table, or None where they can."""
    if dynamics.kind == "drive":
        fits = motor.pulse is not None
        reason = Message("motor {name} takes no pulses, as a drive of dynamics {dynamics} does", name=motor.name,
                         dynamics=dynamics.name)  # fmt: skip
        return None if fits else reason
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
