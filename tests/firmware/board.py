"""A simulated Arduino with the real StandardFirmata, at the end of a pty. Its pins are read from what the AVR does.

Rule: independent of the driver under test: it knows the Arduinos' pins, and nothing of the protocol.
Used by tests/firmware alone; what must be installed for it: install.sh.
"""

import os
import shutil
import subprocess
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

CACHE = Path(os.environ.get("DRILLCTL_TEST_CACHE") or Path.home() / ".cache" / "drillctl-tests")
HEADER = Path("/usr/include/simavr/sim_avr.h")
LIBRARIES = ("-lsimavr", "-lelf", "-lutil", "-lpthread")
SOURCE = Path(__file__).with_name("host.c")
# The pins of one message change within 40 us of each other; the next message takes 520 us on the wire.
SAME_MESSAGE_CYCLES = 3_000
LONGEST_WAIT_S = 5.0


def _pins(first: int, *names: str) -> dict[int, str]:
    return dict(enumerate(names, start=first))


# The AVR's port and bit behind each of the Arduinos' digital pins that Firmata may use.
MEGA_PINS = (
    _pins(2, "E4", "E5", "G5", "E3", "H3", "H4", "H5", "H6", "B4", "B5", "B6", "B7", "J1", "J0", "H1", "H0")
    | _pins(18, "D3", "D2", "D1", "D0", *(f"A{n}" for n in range(8)), *(f"C{n}" for n in reversed(range(8))))
    | _pins(38, "D7", "G2", "G1", "G0", *(f"L{n}" for n in reversed(range(8))), "B3", "B2", "B1", "B0")
    | _pins(54, *(f"F{n}" for n in range(8)), *(f"K{n}" for n in range(8)))
)
UNO_PINS = _pins(2, *(f"D{n}" for n in range(2, 8)), *(f"B{n}" for n in range(6)), *(f"C{n}" for n in range(6)))


@dataclass(frozen=True)
class Kind:
    """One of Arduino's boards: its processor, and its pins."""

    name: str
    mcu: str
    pins: dict[int, str]


MEGA = Kind("mega", "atmega2560", MEGA_PINS)
UNO = Kind("uno", "atmega328p", UNO_PINS)


def missing() -> str:
    """What isn't installed, or nothing."""
    lacking = [] if shutil.which("gcc") else ["gcc"]
    lacking += [str(file) for file in (HEADER, CACHE / "mega.hex", CACHE / "uno.hex") if not file.exists()]
    return f"run tests/firmware/install.sh; missing: {', '.join(lacking)}" if lacking else ""


def build(folder: Path) -> Path:
    """Compiles the host."""
    host = folder / "host"
    command = ["gcc", "-O2", "-Wall", "-Wextra", "-Werror", "-o", str(host), str(SOURCE), *LIBRARIES]
    subprocess.run(command, check=True, timeout=120)
    return host


def wait_until(holds: Callable[[], bool], what: str, longest_s: float = LONGEST_WAIT_S) -> None:
    """Looks again and again, for a few seconds at most."""
    ends = time.monotonic() + longest_s
    while not holds():
        assert time.monotonic() < ends, f"{what}: not within {longest_s} s"
        time.sleep(0.005)


class SimulatedBoard:
    """One running board. ``device`` is its serial line."""

    def __init__(self, host: Path, kind: Kind, folder: Path):
        self.device = str(folder / "tty")
        self._log = folder / "pins.txt"
        self._read = 0  # of it, by new_changes
        self._by_pin = kind.pins
        self._by_name = {name: pin for pin, name in kind.pins.items()}
        command = [str(host), str(CACHE / f"{kind.name}.hex"), kind.mcu, self.device, str(self._log)]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL)
        wait_until(lambda: os.path.exists(self.device), "the board's serial line")

    def set_input(self, pin: int, level: int) -> None:
        """A level from outside, such as a switch's."""
        name = self._by_pin[pin]
        assert self._process.stdin is not None
        self._process.stdin.write(f"{name[0]} {name[1]} {level}\n".encode())
        self._process.stdin.flush()

    def changes(self) -> list[tuple[int, int, int]]:
        """Each change so far of a pin that has a number: (cycle, pin, level)."""
        return self._rows(self._log.read_text())

    def new_changes(self) -> list[tuple[int, int, int]]:
        """Those that came since the last call."""
        with self._log.open() as log:
            log.seek(self._read)
            text = log.read()
        self._read += text.rfind("\n") + 1
        return self._rows(text)

    def _rows(self, text: str) -> list[tuple[int, int, int]]:
        """Of the log's whole lines; the last one may be in the making."""
        rows = []
        for line in text[: text.rfind("\n") + 1].splitlines():
            cycle, letter, bit, level = line.split()
            if (pin := self._by_name.get(letter + bit)) is not None:
                rows.append((int(cycle), pin, int(level)))
        return rows

    def levels(self) -> dict[int, int]:
        """By pin, as they are now; a pin that never changed is low."""
        now = dict.fromkeys(self._by_pin, 0)
        now.update({pin: level for _, pin, level in self.changes()})
        return now

    def wait_for_low(self, pins: Iterable[int]) -> None:
        """Until all of them are: what a program sent last may still be on the wire when it has ended."""
        wait_until(lambda: not any(map(self.levels().get, pins)), "all low")

    def port_updates(self, pins: Iterable[int], since: int) -> list[tuple[int, int]]:
        """(Firmata port, value) after each message that changed some of these pins, from that change on.

        since  how many changes of any pin are left out
        """
        values = dict.fromkeys({pin // 8 for pin in pins}, 0)
        updates: list[tuple[int, int]] = []
        last_port, last_cycle = -1, 0
        for cycle, pin, level in (change for change in self.changes()[since:] if change[1] in pins):
            port, bit = pin // 8, 1 << pin % 8
            values[port] = values[port] | bit if level else values[port] & ~bit
            if port == last_port and cycle - last_cycle < SAME_MESSAGE_CYCLES:
                updates.pop()
            updates.append((port, values[port]))
            last_port, last_cycle = port, cycle
        return updates

    def pull_the_plug(self) -> None:
        """The board and its serial line are gone."""
        self._process.kill()
        self._process.wait(timeout=LONGEST_WAIT_S)

    def close(self) -> None:
        """Ends the host, by its own id."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.kill()
        self._process.wait(timeout=LONGEST_WAIT_S)
