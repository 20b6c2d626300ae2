"""Frequency converters: which registers of one start, stop and tell (``tables/converter/NAME.toml``).

Rule: a converter is data. Those that speak Modbus RTU differ in registers and scales only; the classic Huanyang frames
its bytes in its own way and has no registers to be named.
"""

from dataclasses import dataclass
from typing import Annotated, Literal

import msgspec

from drillctl.language import Message
from drillctl.machine.phase import Name
from drillctl.machine.source import Source

MODBUS, HUANYANG = "modbus", "huanyang"
Register = Annotated[int, msgspec.Meta(ge=0, le=0xFFFF)]
PerHz = Annotated[float, msgspec.Meta(gt=0, le=10_000)]


class Write(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """A value that is written: to a register (function 6) or a coil (5)."""

    register: Register
    value: Register
    function: Literal[5, 6] = 6


class Frequency(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """A register that holds a frequency, ``per_hz`` to one Hz; read by ``function``, 3 or 4."""

    register: Register
    per_hz: PerHz
    function: Literal[3, 4] = 3


class Tripped(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """A register whose bits ``mask`` are not 0 once the converter has tripped."""

    register: Register
    mask: Register = 0xFFFF
    function: Literal[3, 4] = 3


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    description: str = ""
    protocol: Literal["modbus", "huanyang"] = "modbus"
    baud: Annotated[int, msgspec.Meta(ge=1200, le=1_000_000)] = 9600
    parity: Literal["N", "E", "O"] = "N"
    stop_bits: Literal[1, 2] = 1
    address: Annotated[int, msgspec.Meta(ge=1, le=247)] = 1
    greatest_hz: Annotated[float, msgspec.Meta(gt=0, le=4000)] = 400
    run: list[Write] = []
    stop: list[Write] = []
    speed: Frequency | None = None  # where the wanted frequency is written
    set: Frequency | None = None  # where it can be read back
    output: Frequency | None = None  # the frequency that it puts out
    tripped: Tripped | None = None


@dataclass(frozen=True, slots=True)
class Converter:
    """A kind of converter, with the settings of its serial line.

    greatest_hz  what it is set to allow; more is not asked of it
    run, stop    what is written to start and to stop it, in this order
    speed, set, output, tripped  registers; ``set`` and ``tripped`` are None where it has none
    """

    name: str
    protocol: str
    baud: int
    parity: str
    stop_bits: int
    address: int
    greatest_hz: float
    run: tuple[Write, ...] = ()
    stop: tuple[Write, ...] = ()
    speed: Frequency | None = None
    set: Frequency | None = None
    output: Frequency | None = None
    tripped: Tripped | None = None


def parse_converter(source: Source) -> Converter:
    """Reads a converter's table. Raises TableError."""
    raw = source.records(_File)
    needed = ("run", "stop", "speed", "output")
    given = [key for key in (*needed, "set", "tripped") if getattr(raw, key)]
    if raw.protocol == HUANYANG and given:
        reason = Message("protocol huanyang has frames of its own, and no {key}", key=given[0])
        raise source.error(reason, given[0])
    if raw.protocol == MODBUS and (missing := [key for key in needed if key not in given]):
        raise source.error(Message("{name} is missing", name=missing[0]), "protocol")
    return Converter(
        raw.name, raw.protocol, raw.baud, raw.parity, raw.stop_bits, raw.address, raw.greatest_hz,
        tuple(raw.run), tuple(raw.stop), raw.speed, raw.set, raw.output, raw.tripped,
    )  # fmt: skip
