"""A paced machine under a person's hands: sensors seen at rest, outputs set, single ticks of real motors."""

import mmap
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from drillctl.generation.job import names_of
from drillctl.kmd import Condition, Fault, Request, parse_program, to_text
from drillctl.language import Message
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.ports import PortSlow
from drillctl.replay.compare import replay
from drillctl.ticker.paced_link import PacedLink
from drillctl.ticker.ticker_process import DESK_IDLE_NS, DESK_SAFE_NS
from drillctl.trace import Trace, write_text

pytestmark = [
    pytest.mark.paced,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux"),
]

LIBRARY = Library((shipped_tables(),))
MACHINE = LIBRARY.machine("pcb-drill").at_rate(100)  # a gap of less than 70 ms is no news to a motor then
X_MIN = 1 << next(sensor.bit for sensor in MACHINE.sensors if sensor.name == "x_min")
COIL = MACHINE.axes[0].wire_bits[0]
FORCING = sum(
    1 << bit
    for axis in MACHINE.axes
    for wire, bit in zip(axis.phase.wires, axis.wire_bits, strict=True)
    if wire.forcing
)
AT_SPEED = 20  # ticks after which a long move is in state 3, its forcing on
PATIENCE_S = 10.0
INPUTS, OUTPUTS, LATCHES, GONE, SLOW = range(5)


class Wires:
    """A real port whose wires end in memory that the test shares with the ticker's process."""

    def __init__(self) -> None:
        self.words = np.frombuffer(mmap.mmap(-1, 40), "<u8")

    def latch(self) -> int:
        self.words[LATCHES] += 1
        if self.words[GONE]:
            raise OSError("unplugged")
        return int(self.words[INPUTS])

    def flush(self, image: int) -> None:
        if self.words[SLOW]:
            raise PortSlow("wires", Message("bytes wait"))
        self.words[OUTPUTS] = image

    def safe(self) -> None:
        self.words[OUTPUTS] = 0

    def close(self) -> None:
        self.safe()


@pytest.fixture
def wires() -> Wires:
    return Wires()


@pytest.fixture
def link(wires: Wires, tmp_path: Path) -> Iterator[PacedLink]:
    made = PacedLink(MACHINE, wires, None, tmp_path / "status", traced=True, derived=False)
    until(made, lambda: wires.words[LATCHES] > 0)
    yield made
    made.close()


def until(link: PacedLink, holds: Callable[[], object]) -> None:
    deadline_s = time.monotonic() + PATIENCE_S
    while not holds():
        assert time.monotonic() < deadline_s, "never came"
        link.turn()


def rest(link: PacedLink, seconds: float) -> None:
    until_s = time.monotonic() + seconds
    while time.monotonic() < until_s:
        link.turn()


def test_at_rest_a_sensor_is_seen_without_a_tick_and_at_little_cost(link: PacedLink, wires: Wires) -> None:
    assert not link.status()["sensors"] & X_MIN
    wires.words[INPUTS] = X_MIN
    until(link, lambda: link.status()["sensors"] & X_MIN)
    before = int(wires.words[LATCHES])
    rest(link, 0.5)
    assert link.status()["tick"] == 0
    assert int(wires.words[LATCHES]) - before <= 26, "some fifty looks a second"


def test_a_port_that_goes_at_rest_is_a_fault_then(link: PacedLink, wires: Wires) -> None:
    wires.words[GONE] = 1
    until(link, lambda: link.status()["fault"] == Fault.PORT_LOST)
    assert wires.words[OUTPUTS] == 0
    assert link.notices()[-1:] == ["unplugged"]
    assert link.notices()[-1:] == ["unplugged"], "it stays told"


def test_a_port_too_slow_for_a_moving_machine_is_a_fault_of_its_own(link: PacedLink, wires: Wires) -> None:
    link.queue.put(parse_program("KMD_RUCHd x=2000", names_of(MACHINE)))
    until(link, lambda: link.status()["tick"] > AT_SPEED)
    wires.words[SLOW] = 1
    until(link, lambda: link.status()["fault"] == Fault.PORT_SLOW)
    until(link, lambda: wires.words[OUTPUTS] == 0)
    assert not link.status()["position_known"]


@pytest.mark.parametrize(("idle_ns", "held"), [(DESK_SAFE_NS, False), (DESK_IDLE_NS, True)], ids=["run", "screen"])
def test_a_desk_silent_after_its_job_finds_the_coils_off_unless_a_screen_keeps_them(
    idle_ns: int, held: bool, wires: Wires, tmp_path: Path
) -> None:
    made = PacedLink(MACHINE, wires, None, tmp_path / "status", traced=False, derived=False, idle_ns=idle_ns)
    made.queue.put(parse_program("KMD_RUCHd x=3", names_of(MACHINE)))
    until(made, lambda: made.status()["done"] == 2)
    assert wires.words[OUTPUTS]
    time.sleep(DESK_SAFE_NS / 1e9 + 0.2)
    assert bool(wires.words[OUTPUTS]) == held
    made.close()


def test_an_output_set_by_hand_is_one_tick_and_stays(link: PacedLink, wires: Wires) -> None:
    for value in (1, 0, 1):
        assert link.set_output(COIL, value)
    until(link, lambda: link.status()["tick"] == 3)
    assert link.status()["image"] == wires.words[OUTPUTS] == 1 << COIL
    rest(link, 0.1)
    assert link.status()["tick"] == 3 and wires.words[OUTPUTS] == 1 << COIL


def test_forcing_set_by_hand_goes_off_at_rest_and_the_trace_replays(
    link: PacedLink, wires: Wires, tmp_path: Path
) -> None:
    """Nothing else is to be done meanwhile: the ticks that it takes are counted all the same."""
    forced, program = FORCING & -FORCING, parse_program("KMD_KONIEC", names_of(MACHINE))
    link.queue.put(program)
    until(link, lambda: link.status()["done"] == 1)
    assert link.set_output(forced.bit_length() - 1, 1)
    until(link, lambda: link.status()["hot_ticks"])
    assert wires.words[OUTPUTS] == forced
    until(link, lambda: link.status()["cut_off"])
    assert wires.words[OUTPUTS] == 0
    ticks = 1 + MACHINE.tick_hz + 1
    assert link.status()["tick"] == ticks
    rest(link, 0.1)
    assert link.status()["tick"] == ticks, "and no further ones"
    trace = link.trace(header(MACHINE, program))
    assert trace is not None
    write_text(trace, tmp_path / "t.trace")
    assert not replay(tmp_path / "t.trace", LIBRARY).failed(same_tables_wanted=True)


def test_single_ticks_spare_the_windings_and_replay(link: PacedLink, wires: Wires, tmp_path: Path) -> None:
    """The gate is shut at speed: that costs the position. Then tick by tick each step starts from rest."""
    program = parse_program("KMD_RUCHd x=30", names_of(MACHINE))
    link.gate.grant(0)
    link.queue.put(program)
    link.gate.grant(AT_SPEED)
    until(link, lambda: link.status()["tick"] == AT_SPEED)
    assert abs(int(link.status()["state"][0])) > 1 and int(link.status()["image"]) & FORCING
    until(link, lambda: not int(wires.words[OUTPUTS]) & FORCING)
    for tick in range(AT_SPEED + 1, AT_SPEED + 20):
        rest(link, 0.03)  # ticks granted as fast as they are run would be no pause
        link.gate.grant(1)
        until(link, lambda: link.status()["tick"] == tick)  # noqa: B023  # called at once
        assert abs(int(link.status()["state"][0])) <= 1
    link.gate.open()
    until(link, lambda: link.status()["done"] == len(program))
    assert int(link.status()["position"][0]) == 30
    trace = link.trace(header(MACHINE, program))
    assert trace is not None and words(trace) >= {"PAUSE"}
    write_text(trace, tmp_path / "t.trace")
    assert not replay(tmp_path / "t.trace", LIBRARY).failed(same_tables_wanted=True)


def test_an_emergency_stop_passes_a_shut_gate(link: PacedLink, wires: Wires) -> None:
    link.queue.put(parse_program("KMD_RUCHd x=30", names_of(MACHINE)))
    link.gate.grant(9)
    until(link, lambda: link.gate.left == 0)
    link.post(Request.ESTOP)
    until(link, lambda: link.status()["condition"] == Condition.LATCHED)
    assert wires.words[OUTPUTS] == 0


def header(machine: Machine, program: np.ndarray) -> list[tuple[str, str]]:
    names = names_of(machine)
    commands = [("command", f"{record['sequence']} {to_text(record, names)}") for record in program]
    return [("machine", machine.name), ("digest", machine.digest), ("tick_hz", str(machine.tick_hz)), *commands]


def words(trace: Trace) -> set[str]:
    _ticks, values = trace.changes_of("request")
    signal = trace.signals[trace.index_of("request")]
    return {word for value in values.tolist() for word in signal.show(value).split("+")}
