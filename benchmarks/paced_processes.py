"""What a paced machine costs a period of its clock, by process: CPU time of desk, ticker and guard, sleeps included.

    python -m benchmarks.paced_processes [HZ ...]

At each rate (5,000 and 8,000 Hz), of the eight-axis machine on the ideal plant: idle, in a command that only waits, and
with all axes moving there and back. A desk that draws nothing stands for the screen. On Linux.
"""

import os
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from drillctl.generation.job import names_of
from drillctl.kmd import parse_program
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.plant import IdealPlant
from drillctl.portio.simulated import SimulatedCard
from drillctl.ticker.paced_link import PacedLink

WARM_UP_S, MEASURED_S = 0.5, 4.0
STEPS, TIMES = 4000, 30  # there and back: longer than is measured


def jobs(machine: Machine) -> dict[str, str]:
    """By what the machine does, a queue; an empty one leaves it idle."""
    ways = (" ".join(f"{axis}={steps}" for axis in machine.axis_names) for steps in (STEPS, -STEPS))
    there_and_back = "".join(f"KMD_RUCHd {way}\n" for way in ways)
    return {"idle": "", "waiting": "KMD_CZEKAJ 1000000\n", "moving": there_and_back * TIMES}


def processor_s(pid: int) -> float:
    """Seconds of the processor that a process has taken so far."""
    spent = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(spent[11]) + int(spent[12])) / os.sysconf("SC_CLK_TCK")


def costs_us(machine: Machine, queue: str, file: Path) -> tuple[list[float], int]:
    """Microseconds a period of the desk, the ticker and the guard, and how many ticks were late."""
    plant = IdealPlant(machine)
    link = PacedLink(machine, SimulatedCard(plant), plant, file, False, False)
    try:
        if queue:
            link.queue.put(parse_program(queue, names_of(machine)))
        _turn(link, WARM_UP_S)
        pids = os.getpid(), link._ticker.pid, link._guard.pid
        before, from_s = [processor_s(pid) for pid in pids], time.monotonic()
        _turn(link, MEASURED_S)
        periods = (time.monotonic() - from_s) * machine.tick_hz
        spent = [processor_s(pid) - earlier for pid, earlier in zip(pids, before, strict=True)]
        return [seconds / periods * 1e6 for seconds in spent], int(link.status()["late"])
    finally:
        link.close()


def _turn(link: PacedLink, seconds: float) -> None:
    until_s = time.monotonic() + seconds
    while time.monotonic() < until_s:
        link.turn()
        link.status()


def main() -> None:
    """Prints a line for each rate and each thing that the machine does."""
    plain = Library((shipped_tables(),)).machine("eight-axis")
    for hz in [int(text) for text in sys.argv[1:]] or [5000, 8000]:
        for does, queue in jobs(plain).items():
            with TemporaryDirectory() as folder:
                (desk, ticker, guard), late = costs_us(plain.at_rate(hz), queue, Path(folder) / "channel")
            told = f"desk {desk:.1f}, ticker {ticker:.1f}, guard {guard:.1f} us a period, {late} late"
            print(f"{hz} Hz, {does}: {told}; load {os.getloadavg()[0]:.1f}", flush=True)


if __name__ == "__main__":
    main()
