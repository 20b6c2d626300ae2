"""What a wake of the ticker's process costs: CPU time without the sleep, beside the tick alone.

    python -m benchmarks.paced_cost

The wake takes requests and gate from the mapped file, ticks, and publishes heartbeat and status, as in a paced run:
while all axes move, and in a command that only waits. Hot in the caches; paced_processes.py measures with the sleep.
"""

import os
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from drillctl.generation.job import names_of
from drillctl.kmd import parse_program
from drillctl.kmd.channel import Channel
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.plant import IdealPlant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ticker import ticker_process
from drillctl.ticker.edited_tables import TableSlot
from drillctl.ticker.ticker import Ticker

MACHINES = ("pcb-drill", "eight-axis")
WAKES, RUNS = 5_000, 5
WAITS = "KMD_CZEKAJ 1000000\n"


class NoSleep:
    """A clock whose deadlines have always come; it beats for the desk, which is not there."""

    late = worst_ns = late_ns = begun_ns = 0

    def __init__(self, tick_hz: int):
        self.period_ns = 1_000_000_000 // tick_hz
        self.channel: Channel | None = None
        self.left = WAKES

    def set_rate(self, tick_hz: int) -> None:
        """The rate stays."""

    def wait(self) -> int:
        """Returns at once; after WAKES calls the process is asked to leave."""
        assert self.channel is not None
        self.begun_ns = time.monotonic_ns()
        self.channel["desk_beat_ns"] = self.begun_ns
        self.left -= 1
        if self.left == 0:
            self.channel["leave"] = 1
        return 0


def moves(machine: Machine) -> str:
    """A command that moves all axes for longer than is measured."""
    return "KMD_RUCHd " + " ".join(f"{axis.name}={axis.span_steps // 2}" for axis in machine.axes) + "\n"


def wake_us(machine: Machine, command: str, folder: Path) -> float:
    """CPU microseconds of a wake."""
    plant, clock, ends = IdealPlant(machine), NoSleep(machine.tick_hz), os.pipe()
    clock.channel = channel = Channel(folder / "channel", True)
    body = ticker_process.TickerProcess(
        machine, SimulatedCard(plant), plant, channel, TableSlot(), None, False, ends[1], ends[1], 10**12
    )
    body.desk = os.getppid()
    body.queue.put(parse_program(command, names_of(machine)))
    channel["desk_beat_ns"] = time.monotonic_ns()
    # A stand-in for the class: a clock that never sleeps, made before.
    ticker_process.PacedClock = lambda tick_hz: clock  # type: ignore[assignment,misc]
    before = time.process_time()
    body._tick_on()
    spent = time.process_time() - before
    for end in ends:
        os.close(end)
    return spent / WAKES * 1e6


def tick_us(machine: Machine, command: str) -> float:
    """CPU microseconds of a tick and nothing beside it."""
    ticker = Ticker.simulated(machine)
    ticker.queue.put(parse_program(command, names_of(machine)))
    before = time.process_time()
    for _ in range(WAKES):
        ticker.run(1)
    return (time.process_time() - before) / WAKES * 1e6


def main() -> int:
    """Prints two lines a machine."""
    library = Library((shipped_tables(),))
    with tempfile.TemporaryDirectory() as folder:
        for name in MACHINES:
            machine = library.machine(name)
            for does, command in (("all axes move", moves(machine)), ("it waits", WAITS)):
                wakes = median(wake_us(machine, command, Path(folder)) for _ in range(RUNS))
                ticks = median(tick_us(machine, command) for _ in range(RUNS))
                told = f"{name}, {does}: {wakes:.1f} us a wake, {ticks:.1f} of them the tick"
                print(f"{told}; median of {RUNS}, load {os.getloadavg()[0]:.1f}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
