"""Wiring: looks at a port before anything is driven on it: who answers, what it can carry, what its inputs say.

Rule: the outputs are safe from the first to the last moment, and nothing moves. Called by the screens' station.
"""

import time

from drillctl.machine import Machine
from drillctl.panel.ports import PortReport
from drillctl.portio.registry import open_port, rate_of, select
from drillctl.ports import Driver, PortError, Telling
from drillctl.wiring.machinery import wiring_of

LISTEN_S = 0.3  # a board reports its inputs when it comes round to them
LOOK_EVERY_S = 0.01


def look_at_port(machine: Machine, spec: str) -> PortReport:
    """Opens a real port ``NAME[:ADDRESS]``, asks it and gives it back. What went wrong stands in the report."""
    try:
        port, address = select(spec)
        if not address and (reason := port.missing()):
            return PortReport(spec, problem=f"{reason}; it needs {port.needs}")
        driver = open_port(spec, wiring_of(machine))
        try:
            facts = (port.summary, *(driver.facts() if isinstance(driver, Telling) else ()), _rate(machine, spec))
            return PortReport(spec, facts, sensors_of(machine, _listened(driver)))
        finally:
            driver.close()
    except PortError as error:
        return PortReport(spec, problem=str(error))
    except OSError as error:
        return PortReport(spec, problem=f"{spec}: {error.strerror or error}; check cable, power and rights")


def sensors_of(machine: Machine, inputs: int) -> tuple[tuple[str, bool], ...]:
    """Each sensor by name, True where it is reached, from an input image."""
    return tuple((s.name, inputs >> s.bit & 1 == s.active_level) for s in machine.sensors)


def _listened(driver: Driver) -> int:
    """The inputs, once there was time for all of them to be told."""
    until_s = time.monotonic() + LISTEN_S
    while time.monotonic() < until_s:
        driver.latch()
        time.sleep(LOOK_EVERY_S)
    return driver.latch()


def _rate(machine: Machine, spec: str) -> str:
    most_hz = rate_of(spec, wiring_of(machine))
    carries = "any rate of this program" if most_hz is None else f"up to {most_hz} Hz with all axes moving"
    return f"carries {carries}; the machine wants {machine.tick_hz} Hz"
