"""Wiring: opens the port that was asked for and puts a ticker behind it, in this process or in its own.

Rule: everything that can be refused is refused here, before anything moves. Called by the verbs that run a machine.
"""

import sys
from dataclasses import dataclass
from pathlib import Path

from drillctl.lab.capacity import most_ticks_hz
from drillctl.machine import Machine
from drillctl.plant import IdealPlant
from drillctl.portio.registry import open_port, select
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import PortRefused, Wiring
from drillctl.wiring.link import Link, LocalLink
from drillctl.wiring.ticker import Ticker

FREE, REAL = "free", "real"


@dataclass(frozen=True)
class Running:
    """How a machine is to be run: on which port, at which pace (None: as the port wants), and what is kept of it."""

    port: str = "simulated"
    pace: str | None = None
    traced: bool = False
    derived: bool = False


def pace_of(running: Running) -> str:
    """Free for a simulated card, real for a real one. Raises PortRefused for a real port that nobody paces."""
    port, _ = select(running.port)
    if port.real and running.pace == FREE:
        raise PortRefused(running.port, "a real machine can't run free; leave --pace out, or say --pace real")
    pace = running.pace or (REAL if port.real else FREE)
    if pace == REAL and not sys.platform.startswith("linux"):
        raise PortRefused(running.port, "real pace needs Linux; elsewhere machines are simulated, running free")
    return pace


def start(machine: Machine, running: Running, status_file: Path) -> Link:
    """A running ticker. Raises PortError for a port, a rate or a pace that is not to be had; nothing has moved then.

    status_file  the mapped file between the two processes of a paced run
    """
    pace = pace_of(running)
    if pace == REAL and (most_hz := most_ticks_hz(machine)) < machine.tick_hz:
        reason = f"{machine.tick_hz} ticks a second of {machine.name} are too many for this computer"
        raise PortRefused(running.port, f"{reason}; --tick-hz {most_hz} is the most")
    port, _ = select(running.port)
    plant = None if port.real else IdealPlant(machine)
    driver = open_port(running.port, wiring_of(machine), SimulatedCard(plant) if plant else None)
    if pace == FREE:
        return LocalLink(Ticker(machine, driver, plant, running.traced, running.derived))
    from drillctl.wiring.paced import PacedLink

    return PacedLink(machine, driver, plant, status_file, running.traced, running.derived)


def wiring_of(machine: Machine) -> Wiring:
    """What a driver must know of a machine."""
    return Wiring(
        tick_hz=machine.tick_hz,
        card_address=machine.configuration.card_address,
        axis_outputs=tuple(sum(1 << bit for bit in axis.wire_bits) for axis in machine.axes),
        other_outputs=sum(1 << bit for _, bit in machine.outputs),
        inputs=sum(1 << sensor.bit for sensor in machine.sensors),
    )
