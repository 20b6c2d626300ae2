"""GPIO lines of a Linux board (a Raspberry Pi has 26) through libgpiod 2, as the bits of a card.

Rule: a small file, the line map, says which line is which bit; one request holds all lines, so that each latch and each
flush is one call to the kernel. A latch reads the outputs back too: a chip that was reset (an expander on I2C with a
supply of its own) no longer drives them. Needs the extra ``gpio``.

    chip = "/dev/gpiochip0"
    outputs = { 0 = 17, 1 = 27 }     # output bit = line
    inputs = { 0 = 5 }               # input bit = line; with pull-up, so a switch closes to ground
"""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Protocol

from drillctl.files.inputs import read_bytes, toml_of
from drillctl.language import Message, message_of
from drillctl.ports import SAFE_IMAGE, PortLayout, PortLost, PortRefused, bits_of

MOST_LINES = 64  # of one request
LARGEST_MAP_BYTES = 64 * 1024
CONSUMER = "drillctl"


class Request(Protocol):
    """The part of gpiod.LineRequest that is used; values are members of gpiod.line.Value."""

    def get_values(self, lines: list[int]) -> list[Any]:
        """Returns the levels of some lines, in their order."""

    def set_values(self, values: dict[int, Any]) -> None:
        """Sets some lines in one call."""

    def release(self) -> None:
        """Gives all lines back to the kernel."""


@dataclass(frozen=True)
class LineMap:
    """The chip, and for each bit of the card the number of its line there."""

    chip: str
    outputs: Mapping[int, int]
    inputs: Mapping[int, int]


class GpioLines:
    """A driver (ports.Driver) over a request that holds the lines of a map.

    levels  the request's values for low and for high
    """

    def __init__(self, request: Request, lines: LineMap, levels: tuple[Any, Any]):
        self._request = request
        self._outputs, self._levels = lines.outputs, levels
        self._input_bits = [1 << bit for bit in lines.inputs]
        self._lines = [*lines.inputs.values(), *lines.outputs.values()]
        self._put = dict.fromkeys(lines.outputs.values(), levels[0])
        self._followed: set[int] = set()  # outputs that have read high: some chips read all outputs as low
        self.safe()

    def latch(self) -> int:
        """Returns all inputs. Raises OSError, and PortLost where an output does not have the level that was put out
        last.
        """
        levels = self._request.get_values(self._lines)
        count = len(self._input_bits)
        self._read_back(levels[count:])
        return sum(bit for bit, level in zip(self._input_bits, levels[:count], strict=True) if level == self._levels[1])

    def _read_back(self, levels: list[Any]) -> None:
        for (line, put), level in zip(self._put.items(), levels, strict=True):
            if level == put == self._levels[1]:
                self._followed.add(line)
            elif level != put and line in self._followed:
                reason = Message(
                    "line {line} does not hold what was put out: its chip was reset, or it is shorted", line=line
                )
                raise PortLost(
                    "gpio", Message("{reason}; check supply and wiring, then initialise again", reason=reason)
                )

    def flush(self, image: int) -> None:
        """Sets all outputs in one call. Raises OSError."""
        self._put = {line: self._levels[image >> bit & 1] for bit, line in self._outputs.items()}
        self._request.set_values(self._put)

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Puts the safe image out. Raises OSError."""
        self.flush(image)

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Puts the safe image out and gives the lines back."""
        with suppress(OSError):
            self.safe(image)
        self._request.release()


def open_gpio(address: str, layout: PortLayout) -> GpioLines:
    """Requests the lines of the map in file ``ADDRESS``, outputs low from the first moment. Raises PortRefused."""
    lines = read_line_map(address, layout)
    if reason := missing():
        raise PortRefused("gpio", reason)
    import gpiod
    from gpiod.line import Bias, Direction, Value

    output = gpiod.LineSettings(direction=Direction.OUTPUT, output_value=Value.INACTIVE)
    switch = gpiod.LineSettings(direction=Direction.INPUT, bias=Bias.PULL_UP)
    config = dict.fromkeys(lines.outputs.values(), output) | dict.fromkeys(lines.inputs.values(), switch)
    try:
        request = gpiod.request_lines(lines.chip, config, CONSUMER)
    except OSError as error:
        why = Message("{why}; see that it is there, that no line is taken, and your rights", why=message_of(error))
        raise PortRefused("gpio", why.at(lines.chip)) from error
    return GpioLines(request, lines, (Value.INACTIVE, Value.ACTIVE))


def read_line_map(file: str, layout: PortLayout) -> LineMap:
    """Reads a line map, which must have all bits of the machine; other bits are ignored. Raises PortRefused."""
    raw = _read(file)
    chip = raw.pop("chip", None)
    tables = {key: raw.pop(key, {}) for key in ("outputs", "inputs")}
    if not isinstance(chip, str) or raw:
        raise PortRefused("gpio", Message("a line map has chip, outputs and inputs, and nothing else").at(file))
    outputs, inputs = (
        _picked(file, key, tables[key], image)
        for key, image in (("outputs", layout.outputs), ("inputs", layout.inputs))
    )
    lines = [*outputs.values(), *inputs.values()]
    if len(set(lines)) < len(lines):
        raise PortRefused("gpio", Message("two bits have the same line").at(file))
    if len(lines) > MOST_LINES:
        raise PortRefused(
            "gpio",
            Message(
                "the machine uses {count} lines; {most} can be had at once",
                count=len(lines),
                most=MOST_LINES,
            ).at(file),
        )
    return LineMap(chip, outputs, inputs)


def missing() -> Message | None:
    """Returns why there are no GPIO lines here; None where there may be some."""
    if find_spec("gpiod") is None:
        return Message("the package gpiod is not installed: pip install gpiod")
    found = list(Path("/dev").glob("gpiochip*"))
    return None if found else Message("no /dev/gpiochip: this computer has no GPIO lines")


def _read(file: str) -> dict[str, Any]:
    if not file:
        raise PortRefused("gpio", Message("which bit is which line? Name a line map: gpio:FILE"))
    try:
        return toml_of(read_bytes(file, LARGEST_MAP_BYTES, Message("a line map")).decode())
    except OSError as error:
        raise PortRefused("gpio", Message("can't be read: {why}", why=message_of(error)).at(file)) from error
    except ValueError as error:
        raise PortRefused("gpio", Message("no line map: {why}", why=message_of(error)).at(file)) from error


def _picked(file: str, key: str, table: Any, image: int) -> dict[int, int]:
    """Returns the lines of the bits that an image has."""
    picked: dict[int, int] = {}
    for bit in bits_of(image):
        line = table.get(str(bit)) if isinstance(table, dict) else None
        if type(line) is not int or line < 0:
            raise PortRefused(
                "gpio", Message("{key} has no line for bit {bit}, which the machine uses", key=key, bit=bit).at(file)
            )
        picked[bit] = line
    return picked
