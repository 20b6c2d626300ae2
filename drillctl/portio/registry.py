"""The ports that drillctl can drive, as a table: what each is, what it needs, what it can carry, how it is opened.

Rule: everything that can be refused is refused here, before anything moves. A new port is a new row; another
distribution adds one by an entry point, which is looked for only where a name is not in the table.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

from drillctl.language import Counted, Message, known_words
from drillctl.portio.firmata_pins import MEGA, UNO, Board
from drillctl.ports import Driver, PortLayout, PortRefused

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "drillctl.drivers"  # of entry points; each gives a Port that has the entry point's name

Open = Callable[[str, PortLayout, Driver | None], Driver]
Rate = Callable[[str, PortLayout, Iterable[int]], int | None]


def _here() -> None:
    return None


def _any_rate(address: str, layout: PortLayout, moving_axes: Iterable[int]) -> int | None:
    return None


def _of(driver: str, function: str, *first: Any) -> Callable[..., Any]:
    """Returns a function of a driver's module, which is imported when it is called: most runs need none of them."""
    return lambda *others: getattr(import_module(f"drillctl.portio.{driver}"), function)(*first, *others)


def _no_serial_line() -> Message | None:
    return None if _of("firmata", "usb_devices")() else Message("no serial line at USB: plug the board in")


@dataclass(frozen=True)
class Port:
    """One row.

    address      what may follow the colon; [in brackets] where it may be left out
    real         a real machine is connected: paced by the clock, lost steps unknown
    missing      why it can't be used here, or None
    open         (address, layout, the simulated card of a port that is not real); raises PortError
    max_tick_hz  (address, layout, moving axes by index): the most it carries, None for more than any machine asks
    """

    name: str
    summary: Message
    needs: Message
    address: str
    real: bool
    missing: Callable[[], Message | None]
    open: Open
    max_tick_hz: Rate = _any_rate


def _simulated(address: str, layout: PortLayout, card: Driver | None) -> Driver:
    assert card is not None
    if address:
        raise PortRefused("simulated", Message("it has no address, and so not {address!r}", address=address))
    return card


def _mapped(address: str, layout: PortLayout, card: Driver | None) -> Driver:
    assert card is not None
    return _of("mapped", "open_mapped")(address, layout, card)


def _real(opened: Callable[[str, PortLayout], Driver]) -> Open:
    """Returns the ``open`` of a port that has no simulated card behind it."""
    return lambda address, layout, card: opened(address, layout)


def _firmata_row(name: str, board: Board, summary: Message) -> Port:
    return Port(
        name,
        summary,
        needs=Message(
            "an Arduino {board} with StandardFirmata 2.3 or newer, and the right to use its serial line",
            board=board.name,
        ),
        address="[DEVICE][@BAUD]",
        real=True,
        missing=_no_serial_line,
        open=_real(_of("firmata", "open_firmata", board)),
        max_tick_hz=_of("firmata", "max_tick_hz", board),
    )


PORTS = {
    port.name: port
    for port in (
        Port(
            "simulated",
            Message("a card whose wires end in a simulated machine"),
            needs=Message("nothing"),
            address="",
            real=False,
            missing=_here,
            open=_simulated,
        ),
        Port(
            "mapped",
            Message("the simulated card with its image in a file that outlives a crash"),
            needs=Message("a file that may be written"),
            address="FILE",
            real=False,
            missing=_here,
            open=_mapped,
        ),
        _firmata_row("firmata", MEGA, Message("an Arduino Mega on a serial line: 32 outputs, 16 inputs")),
        _firmata_row("firmata-uno", UNO, Message("an Arduino Uno on a serial line: 18 pins, for a CNC shield")),
        Port(
            "pcl720",
            Message("Advantech PCL-720 cards: 32 outputs and 32 inputs each"),
            needs=Message("an ISA bus, /dev/port, root"),
            address="[BASE[,BASE..]], hexadecimal; default: the machine's card_address",
            real=True,
            missing=_of("pcl720", "missing"),
            open=_real(_of("pcl720", "open_pcl720")),
        ),
        Port(
            "gpio",
            Message("GPIO lines of a Linux board such as a Raspberry Pi"),
            needs=Message("the extra gpio (libgpiod 2), a line map, the right to use /dev/gpiochip"),
            address="FILE, the line map",
            real=True,
            missing=_of("gpiod_lines", "missing"),
            open=_real(_of("gpiod_lines", "open_gpio")),
        ),
    )
}


# Cards as machine files name them, and the ports that drive them; a port may stand there by its own name as well.
CARD_PORTS = {"ZAR1": "pcl720", "PCL-720": "pcl720", "MEGA": "firmata", "UNO": "firmata-uno"}


def port_of_card(card: str) -> str:
    """Returns the real port, ``NAME[:ADDRESS]``, that drives a card; empty where none does."""
    spec = CARD_PORTS.get(card, card)
    name = spec.partition(":")[0]
    there = name in PORTS or any(entry.name == name for entry in _entries())
    return spec if there and select(spec)[0].real else ""


def added_ports() -> list[Port]:
    """Returns the ports that other distributions add; one that can't be used says why by its ``missing``."""
    entries = _entries()
    return [_listed(entry, entries) for entry in entries]


def _entries() -> "list[EntryPoint]":
    from importlib.metadata import entry_points

    return list(entry_points(group=GROUP))


def _owner(entry: "EntryPoint") -> str:
    return entry.dist.name if entry.dist else entry.value


def _listed(entry: "EntryPoint", entries: "list[EntryPoint]") -> Port:
    try:
        return _loaded(entry, entries)
    except PortRefused as error:
        reason = error.reason

    def refuse(address: str, layout: PortLayout, card: Driver | None) -> Driver:
        raise PortRefused(entry.name, reason)

    summary = Message("a port of the distribution {owner}", owner=_owner(entry))
    return Port(entry.name, summary, Message("its driver"), "", real=True, missing=lambda: reason, open=refuse)


def _loaded(entry: "EntryPoint", entries: "list[EntryPoint]") -> Port:
    """Returns the port of an entry point. Raises PortRefused, naming the distribution, where its name is taken or it
    can't be loaded.
    """
    name, owner = entry.name, _owner(entry)
    taken_by = ["drillctl"] if name in PORTS else [_owner(e) for e in entries if e.name == name and e is not entry]
    if taken_by:
        raise PortRefused(
            name,
            Message(
                "the distribution {owner} adds a port of this name, which {other} has too; uninstall one of the added",
                owner=owner,
                other=", ".join(taken_by),
            ),
        )
    try:
        port = entry.load()
    except Exception as error:  # whatever a stranger's module raises
        reason = Message(
            "its driver, of the distribution {owner}, can't be loaded: {error}; install it anew",
            owner=owner,
            error=f"{type(error).__name__}: {error}",
        )
        raise PortRefused(name, reason) from error
    if not isinstance(port, Port) or port.name != name:
        why = Message(
            "the distribution {owner} gives {value}, which is no Port of this name", owner=owner, value=entry.value
        )
        raise PortRefused(name, why)
    return port


def rate_of(spec: str, layout: PortLayout) -> int | None:
    """Returns the most ticks a second that a port carries with all axes moving; None for more than any machine asks.

    Raises PortRefused for an unknown name.
    """
    port, address = select(spec)
    return port.max_tick_hz(address, layout, range(len(layout.axis_outputs)))


def select(spec: str) -> tuple[Port, str]:
    """Returns the port and the address in ``NAME[:ADDRESS]``. Raises PortRefused for an unknown name, or an added port
    that can't be loaded.
    """
    name, _, address = spec.partition(":")
    if name in PORTS:
        return PORTS[name], address
    entries = _entries()
    for entry in entries:
        if entry.name == name:
            return _loaded(entry, entries), address
    known = [*PORTS, *(entry.name for entry in entries)]
    raise PortRefused(name, Message("there is no such port; {words}", words=known_words(name, known)))


def check_rate(spec: str, layout: PortLayout) -> None:
    """Raises PortRefused for a tick rate that a port can't carry with all axes moving, or an unknown name."""
    most_hz = rate_of(spec, layout)
    if most_hz is not None and layout.tick_hz > most_hz:
        reason = Counted(
            "{hz} interrupts a second are too many for it with {count} axis moving",
            "{hz} interrupts a second are too many for it with {count} axes moving",
            len(layout.axis_outputs),
            hz=layout.tick_hz,
        )
        raise PortRefused(spec, Message("{reason}; --tick-hz {most} is the most", reason=reason, most=most_hz))


def open_port(spec: str, layout: PortLayout, card: Driver | None = None) -> Driver:
    """Opens ``NAME[:ADDRESS]`` with its outputs safe; ``card`` is the simulated one, for a port that is not real.

    Raises PortRefused, also for a rate that it can't carry with all axes moving; PortLost where it goes away meanwhile.
    Nothing has moved then.
    """
    port, address = select(spec)
    check_rate(spec, layout)
    return port.open(address, layout, card)
