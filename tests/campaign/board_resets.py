"""A board that resets in mid-run, at any tick of a short job on a machine that is fed by distance. No line, no clock.

What the driver sends moves an ideal plant through the pins of a stand-in's sketch; answers are a few ticks under way.
Judged is what the plant saw against what the desk counts as done. Used by tests/campaign and by benchmarks.
"""

from collections import deque
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np

from drillctl.execution.conditions import raise_fault
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.jobs.runner import JobRunner
from drillctl.kmd import Fault
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.plant import IdealPlant
from drillctl.portio.firmata import FirmataCard
from drillctl.portio.firmata_line import FirmataLine
from drillctl.portio.firmata_pins import MEGA, Pins
from drillctl.portio.firmata_protocol import BoardMessage, Decoder, Firmware
from drillctl.portio.firmata_watch import Watch
from drillctl.ports import PortLost
from drillctl.ticker.confirmed_status import ConfirmedStatus
from drillctl.ticker.launch import port_layout
from drillctl.ticker.link import LocalLink
from drillctl.ticker.ticker import Ticker
from drillctl.viewmodel.records import Outcome
from tests.portio.firmata_stand_in import Faults, Sketch
from tests.support.wired_board import follow_pins

BOARD = "M48\nMETRIC\nT1C0.800\n%\nG90\nG05\nT1\nX0.02Y0.02\nX0.06Y0.02\nX0.06Y0.05\nM30\n"
CHANGES = {  # of mega-28byj48: near to its sensors, and short strokes
    "start = 10190": "start = 6",
    "start = 7642": "start = 6",
    "start = 0": "start = 18",
    "edge = -100\nhysteresis = 100": "edge = -4\nhysteresis = 2",
    "edge = 25\nhysteresis = 100": "edge = 8\nhysteresis = 8",  # a board answers some ticks late
    "down = 4076": "down = 30",
    "z = 2547": "z = 24",
    "spin_up_s = 2 ": "spin_up_s = 0.02 ",
}
BYTE_S = 10 / 57_600
ANSWER_TICKS = 2
MOST_TICKS = 5_000


@dataclass(frozen=True)
class Reset:
    """Before which wake it happens, and whether the board's greeting comes through; as if nothing, where ``wake`` < 0.

    silent  it does not come back at all
    """

    wake: int = -1
    greets: bool = False
    silent: bool = False


@dataclass(frozen=True)
class Played:
    """How the desk says it ended, the holes that the board made, and after how many wakes the loss was told."""

    outcome: Outcome
    made: int
    wakes: int
    told_after: int

    def violations(self, reset: Reset) -> list[str]:
        """What must not be, in words."""
        fault = self.outcome.fault
        wrong = []
        if self.outcome.holes_done > self.made:
            wrong.append(f"{self.outcome.holes_done} holes told as done, {self.made} made")
        name = fault.name if fault else "nothing"
        others = ("LIMIT",) if reset.silent else ()  # of a sensor that stays as it was
        settled = self.wakes - 1 - ANSWER_TICKS  # from then on the last answer, of before the reset, is under way
        if 0 <= reset.wake < settled and name not in ("PORT_LOST", *others):
            wrong.append(f"no PORT_LOST but {name}")
        if fault is not None and (self.outcome.position_known or fault.position != "lost"):
            wrong.append("the position is told as known")
        return [f"{reset}: {what}" for what in wrong]


class BoardLine:
    """In place of a FirmataLine: the board's pins drive the plant, its answers come ANSWER_TICKS later."""

    name = "firmata:stand-in"

    def __init__(self, plant: IdealPlant):
        self.plant, self.wakes, self.silent = plant, 0, False
        self.sketch = Sketch(Faults(), self._answer)
        self._decoder = Decoder()
        self._on_its_way: deque[tuple[int, bytes]] = deque()

    def send(self, data: bytes) -> None:
        for byte in b"" if self.silent else data:
            self.sketch.take(byte)
        follow_pins(self.sketch, self.plant)

    send_first = send

    def received(self) -> list[BoardMessage]:
        messages: list[BoardMessage] = []
        while self._on_its_way and self._on_its_way[0][0] <= self.wakes:
            messages += self._decoder.feed(self._on_its_way.popleft()[1])
        return messages

    def answer(self, question: bytes, kind: type[BoardMessage]) -> BoardMessage:
        self.send(question)
        self.wakes += ANSWER_TICKS
        return next(message for message in self.received() if isinstance(message, kind))

    def forget_greetings(self) -> None:
        """There is none."""

    def close(self) -> None:
        """Nothing to give back."""

    def now_s(self) -> float:
        """A clock that goes by wakes."""
        return self.wakes / 500

    def pass_a_wake(self, reset: Reset, wake: int) -> None:
        """Time goes on; the board's round."""
        self.wakes += 1
        if wake == reset.wake:
            self.silent = reset.silent
            self.sketch.reset(reset.greets)
        follow_pins(self.sketch, self.plant)

    def _answer(self, data: bytes) -> None:
        if not self.silent:
            self._on_its_way.append((self.wakes + ANSWER_TICKS, data))


class ResettingLink(LocalLink):
    """As a paced link, a wake a turn, without processes: what may go up goes up, and a lost port ends it."""

    def __init__(self, machine: Machine, reset: Reset):
        self.line, self.reset, self.woken, self.told_after = BoardLine(IdealPlant(machine)), reset, 0, 0
        line, wiring = cast(FirmataLine, self.line), port_layout(machine)
        pins = Pins(MEGA, wiring, self.line.name)
        pins.prepare(line)
        watch = Watch(self.line.name, pins.witnesses(), BYTE_S, 1 / machine.tick_hz, self.line.now_s)
        card = FirmataCard(line, pins, Firmware((2, 5), "StandIn"), watch)
        super().__init__(Ticker(machine, card))
        self._vouched = ConfirmedStatus(card)
        self._status = self.ticker.report().copy()

    def turn(self) -> None:
        self.line.pass_a_wake(self.reset, self.woken)
        self.woken += 1
        try:
            self.ticker.advance(1)
            newest = self._vouched.newest(self.ticker.report())
        except PortLost:
            raise_fault(self.ticker.controller, Fault.PORT_LOST)
            self.told_after = self.woken - self.reset.wake
            newest = self._vouched.last(self.ticker.report())
        if self.woken > MOST_TICKS:
            raise AssertionError(f"{self.reset}: it does not end")
        if newest is not None:
            self._status = newest.copy()

    def status(self) -> np.void:
        return self._status


def short_job(folder: Path) -> Job:
    """Three holes on the machine with CHANGES."""
    text = (shipped_tables() / "machines" / "mega-28byj48.toml").read_text()
    for old, new in CHANGES.items():
        assert old in text, old
        text = text.replace(old, new)
    (folder / "short.toml").write_text(text)
    (folder / "short.drl").write_text(BOARD)
    machine = Library.standard().machine(str(folder / "short.toml"))
    return load_job(folder / "short.drl", machine, JobSetup("pcb-drill"))


def play(job: Job, reset: Reset) -> Played:
    """Drills the job, with this reset, to its end."""
    link = ResettingLink(job.machine, reset)
    outcome = JobRunner(job, link, lambda progress: None).run().outcome
    return Played(outcome, link.line.plant.touches, link.woken, link.told_after)
