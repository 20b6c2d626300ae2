"""What the dynamic plant must know of a motor and its load: windings, supply, torque, inertia, friction.

Rule: SI units, named in the key. Only the plant uses them, so they are no part of a machine's digest. Only motors of
two phases with centre taps can be described.
"""

from dataclasses import dataclass
from typing import Annotated

import msgspec

from drillctl.language import Message
from drillctl.machine.motor import Motor
from drillctl.machine.phase import Name, PhaseTable
from drillctl.machine.source import Source

# The half windings of a motor that can be described, by their electrical degrees: the order of the plant's currents.
WINDING_DEGREES = (0, 180, 270, 90)
Amount = Annotated[float, msgspec.Meta(gt=0, le=1e6)]
Torque = Annotated[float, msgspec.Meta(ge=0, le=1e3)]
Volts = Annotated[float, msgspec.Meta(ge=0, le=60)]


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    cycles_per_turn: Annotated[int, msgspec.Meta(ge=1, le=400)]
    normal_volts: Volts
    forcing_volts: Volts
    switch_volts: Volts
    freewheel_volts: Volts
    resistance_ohm: Amount
    inductance_h: Amount
    torque_nm_per_a: Amount
    inertia_kgm2: Amount
    viscous_nms: Torque
    coulomb_nm: Torque
    detent_nm: Torque
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


def parse_dynamics(source: Source) -> Dynamics:
    """Reads a motor and its load from a file's text. Raises TableError."""
    raw = source.records(_File)
    if raw.forcing_volts < raw.normal_volts:
        raise source.error(Message("forcing_volts is below normal_volts"), "forcing_volts")
    fields = msgspec.structs.asdict(raw)
    del fields["description"]
    fields["forcing"] = tuple((wire, tuple(windings)) for wire, windings in raw.forcing.items())
    return Dynamics(**fields)


def misfit(dynamics: Dynamics, motor: Motor, phase: PhaseTable) -> Message | None:
    """Returns why these dynamics can't describe the motor with this phase table, or None where they can."""
    if sorted(angle % 360 for _, angle in motor.windings) != sorted(WINDING_DEGREES):
        return Message(
            "motor {name} has not the four half windings, a quarter cycle apart, that dynamics are told of",
            name=motor.name,
        )
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
