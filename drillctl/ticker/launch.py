"""Starts a machine: checks the settings of the run, opens the port and starts a ticker on it, here or in a process.

Rule: everything that can be refused is refused here, before anything moves.
"""

import logging
import sys
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from drillctl.kmd import Queue
from drillctl.language import Message, message_of
from drillctl.machine import Machine
from drillctl.machine.levels import Word
from drillctl.plant import IDEAL_PLANT, IdealPlant, Plant, PlantChoice, PlantRefused
from drillctl.portio.registry import check_rate as check_port_rate
from drillctl.portio.registry import open_port, port_of_card, select
from drillctl.portio.simulated import SimulatedCard, SwitchedCard
from drillctl.ports import Driver, PortLayout, PortRefused
from drillctl.ticker.converter.card import ConverterCard, ConverterChoice, layout_without_words
from drillctl.ticker.link import Link, LocalLink
from drillctl.ticker.realtime import most_ticks_hz
from drillctl.ticker.ticker import FAST, TICK, Ticker
from drillctl.trace.ring import RingRecorder

LOG = logging.getLogger(__name__)
FREE, REAL = "free", "real"
SIMULATED = "simulated"
FILE = "FILE"  # how an address that is one begins in the registry


@dataclass(frozen=True)
class RunSettings:
    """How a machine is to be run.

    port    ``NAME[:ADDRESS]``
    pace    ``free`` or ``real``; None: as the port wants
    traced  a trace is recorded; ``derived``: with derived signals, where it is ticked (a rerun finds those of the fast
            engine as quickly); ``taped``: in the segment form, where it runs fast
    plant   what stands behind a simulated card
    engine  ``tick`` or ``fast``; None: fast where possible
    kept    by a screen, from job to job: its desk may be silent for longer between jobs
    converter  the spindle's frequency converter; None: its speed is the simulated machine's, or wires of the card
    sliced  a simulated card at real pace runs by the simulated clock (sliced_clock.py), which is never late
    waits   a turn of the link to a ticker of its own waits a moment; False: the caller waits between two turns itself
    """

    port: str = SIMULATED
    pace: str | None = None
    traced: bool = False
    derived: bool = False
    plant: PlantChoice = IDEAL_PLANT
    engine: str | None = None
    taped: bool = False
    kept: bool = False
    sliced: bool = False
    waits: bool = True
    converter: ConverterChoice | None = None


def port_of_mode(machine: Machine) -> str:
    """The port that a machine's file asks for by its ``mode``. Raises PortRefused for a card that no port drives."""
    if machine.configuration.mode == "SIMULATED":
        return SIMULATED
    port = port_of_card(machine.configuration.card)
    if not port:
        reason = Message("mode REAL, and no port drives the card {card!r}", card=machine.configuration.card)
        raise PortRefused(
            machine.name, Message("{reason}; name a port as card (drillctl ports), or say --port", reason=reason)
        )
    return port


def card_port(machine: Machine) -> str:
    """The port that drives a machine's card, whatever its mode; empty where none does."""
    return port_of_card(machine.configuration.card)


def on_port(running: RunSettings, port: str) -> RunSettings:
    """The same settings on another, real port, which has no plant behind it."""
    return replace(running, port=port, pace=REAL, plant=IDEAL_PLANT)


def simulated(running: RunSettings) -> RunSettings:
    """The same settings on a simulated card."""
    return running if not select(running.port)[0].real else replace(running, port=SIMULATED, converter=None)


def files_of(spec: str) -> tuple[Path, ...]:
    """Files that a port ``NAME[:ADDRESS]`` reads or writes by its address. Raises PortRefused."""
    port, address = select(spec)
    return (Path(address),) if address and port.address.startswith(FILE) else ()


def pace_of(running: RunSettings) -> str:
    """The pace of a run: by default free on a simulated card, real on a real one. Raises PortRefused for one that can't
    be had.
    """
    port, _ = select(running.port)
    if port.real and running.pace == FREE:
        raise PortRefused(running.port, Message("a real machine can't run free; leave --pace out, or say --pace real"))
    pace = running.pace or (REAL if port.real else FREE)
    if pace == REAL and not sys.platform.startswith("linux"):
        raise PortRefused(
            running.port, Message("real pace needs Linux; elsewhere machines are simulated, running free")
        )
    return pace


def is_soon_over(running: RunSettings) -> bool:
    """Whether a run takes no longer than its forecast would, so that the time left isn't worth working out."""
    return in_batches(running) and pace_of(running) == FREE


def in_batches(running: RunSettings) -> bool:
    """Whether whole commands can be run at once, where nothing else keeps the run to single ticks."""
    return running.plant == IDEAL_PLANT and running.engine != TICK


def start(machine: Machine, running: RunSettings, status_file: Path, keeper: RingRecorder | None = None) -> Link:
    """Starts a ticker and returns the link to it. Raises PortError for a port, a rate, a pace or a plant that can't be
    had; nothing has moved then.

    status_file  the mapped file between the two processes of a paced run
    keeper       a ring that takes all signals, derived ones too, in place of a trace; whoever made it empties it
    """
    pace = pace_of(running)
    check_rate(machine, running)
    plant = plant_of(machine, running)
    LOG.info("%s on port %s, pace %s, plant %s", machine.name, running.port, pace, running.plant)
    driver = _opened(machine, running, _card(plant, running, pace) if plant else None, pace)
    if _goes_fast(running, pace, driver, plant, keeper):
        from drillctl.ticker.fast_ticker import FAR_SIGHT, FastTicker

        return LocalLink(
            FastTicker(machine, driver, plant, running.traced, queue=Queue(FAR_SIGHT), taped=running.taped)
        )
    if _goes_in_stretches(running, pace, driver, plant, keeper):
        from drillctl.ticker.stretch_ticker import StretchTicker

        return LocalLink(StretchTicker(machine, driver, plant, running.traced))
    if pace == FREE:
        traced, derived = running.traced or keeper is not None, running.derived or keeper is not None
        return LocalLink(Ticker(machine, driver, plant, traced, derived, keeper=keeper))
    from drillctl.ticker.paced_link import PacedLink
    from drillctl.ticker.ticker_process import DESK_IDLE_NS, DESK_SAFE_NS

    idle_ns = DESK_IDLE_NS if running.kept else DESK_SAFE_NS
    try:
        return PacedLink(
            machine, driver, plant, status_file, running.traced, running.derived, keeper, idle_ns, _is_sliced(running),
            running.waits,
        )
    except OSError as error:
        why = message_of(error).at(error.filename) if error.filename else message_of(error)
        raise PortRefused(
            running.port,
            Message("the ticks have no process of their own: {why}", why=why),
        ) from error


def check_site(machine: Machine, running: RunSettings) -> None:
    """Raises PortError for a rate or a plant that can't be had, without opening the port."""
    check_rate(machine, running)
    plant_of(machine, running)


def _opened(machine: Machine, running: RunSettings, card: SimulatedCard | None, pace: str) -> Driver:
    """The port's driver, with the converter's card around it where there is one."""
    layout = port_layout(machine)
    if running.converter is None:
        return open_port(running.port, layout, card)
    if pace == FREE:
        reason = Message("a converter needs real time; say --pace real, or leave --converter out")
        raise PortRefused(running.port, reason)
    layout = layout_without_words(layout, machine, running.converter)
    driver = open_port(running.port, layout, card)
    try:
        return ConverterCard(driver, machine, running.converter)
    except PortRefused:
        driver.close()
        raise


def _card(plant: Plant, running: RunSettings, pace: str) -> SimulatedCard:
    """The card of a simulated machine; one whose inputs can be pressed where a screen keeps the machine."""
    return SwitchedCard(plant) if running.kept and pace == REAL else SimulatedCard(plant)


def check_rate(machine: Machine, running: RunSettings) -> None:
    """Raises PortRefused for a machine at a tick rate that its port, or this computer, does not carry."""
    check_port_rate(running.port, port_layout(machine))
    if _is_sliced(running) or pace_of(running) != REAL:
        return
    if (most_hz := most_ticks_hz(machine)) < machine.tick_hz:
        reason = Message(
            "{hz} ticks a second of {machine} are too many for this computer", hz=machine.tick_hz, machine=machine.name
        )
        raise PortRefused(running.port, Message("{reason}; --tick-hz {most} is the most", reason=reason, most=most_hz))


def _is_sliced(running: RunSettings) -> bool:
    """Whether it runs by the simulated clock, which stretches time where the computer can't carry the rate."""
    return running.sliced and not select(running.port)[0].real and pace_of(running) == REAL


def _goes_fast(
    running: RunSettings, pace: str, driver: Driver, plant: Plant | None, keeper: RingRecorder | None
) -> bool:
    """Whether the fast engine may run it. Raises PortRefused where it was asked for and may not."""
    predictable = type(driver) is SimulatedCard and isinstance(plant, IdealPlant)
    may = predictable and pace == FREE and keeper is None
    if running.engine == FAST and not (may or _goes_in_stretches(running, pace, driver, plant, keeper)):
        reason = Message("--engine fast needs a simulated card that runs free; on the dynamic plant it writes no --vcd")
        raise PortRefused(running.port, Message("{reason}; leave --engine out, or say --engine tick", reason=reason))
    return may and running.engine != TICK


def _goes_in_stretches(
    running: RunSettings, pace: str, driver: Driver, plant: Plant | None, keeper: RingRecorder | None
) -> bool:
    """Whether stretches of ticks may be run at once on a plant that has time."""
    has_time = type(driver) is SimulatedCard and plant is not None and not isinstance(plant, IdealPlant)
    return has_time and pace == FREE and keeper is None and not running.derived and running.engine != TICK


def plant_of(machine: Machine, running: RunSettings) -> Plant | None:
    """The plant behind a simulated card; None on a real port. Raises PortRefused."""
    port, _ = select(running.port)
    if not port.real:
        try:
            return running.plant.build(machine)
        except PlantRefused as error:
            raise PortRefused(running.port, error.message) from error
    if running.plant != IDEAL_PLANT:
        raise PortRefused(running.port, Message("a real machine is no plant; leave --plant, --fault and --seed out"))
    return None


def port_layout(machine: Machine) -> PortLayout:
    """What a driver must know of a machine: its rate, card address, and which bits are used for what."""
    return PortLayout(
        tick_hz=machine.tick_hz,
        card_address=machine.configuration.card_address,
        axis_outputs=tuple(sum(1 << bit for bit in axis.wire_bits) for axis in machine.axes),
        other_outputs=_image([bit for _, bit in machine.outputs], machine.output_words),
        inputs=_image([line.bit for line in machine.input_lines], machine.input_words),
    )


def _image(bits: Iterable[int], words: Iterable[Word]) -> int:
    return sum(1 << bit for bit in bits) | sum(word.mask for word in words)
