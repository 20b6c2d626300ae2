"""A board on a pty that resets once in mid-run, with a machine at its pins: for the whole program, in real pace.

The short job of board_resets.py, drilled by ``drillctl run`` and gone on with by ``drillctl resume`` until it is done.
The board resets as it takes its nth output message; boards count no ticks. Judged is what its plant saw against what
the program said. Used by benchmarks/board_resets.py and its test.
"""

import json
import os
import select
import subprocess
import sys
import threading
import tty
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from drillctl.generation.job import Job
from drillctl.plant import IdealPlant
from tests.portio.firmata_stand_in import Faults, Sketch
from tests.support.wired_board import OUTPUT_PORTS, follow_pins

RUN_S = 60.0
MOST_RESUMES, MOST_TRIES = 4, 3
OF_A_BUSY_COMPUTER = ("LATE_TICK", "PORT_SLOW", "HEARTBEAT_LOST")


class ResettingBoard:
    """A sketch at the end of ``device``, its plant wired to it. A thread keeps it, until ``close``."""

    def __init__(self, plant: IdealPlant):
        self.plant = plant
        self.was_reset = False
        self._reset_at, self._greets = 0, False
        self.messages = 0  # since ``arm``
        self._host, self._line = os.openpty()
        tty.setraw(self._line)
        self.device = os.ttyname(self._line)
        self.sketch = Sketch(Faults(), self._say)
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def arm(self, message: int, greets: bool) -> None:
        """Reset before the nth message to an output port from now on that switches something on."""
        self._reset_at, self._greets, self.messages = message, greets, 0

    def close(self) -> None:
        """Ends the thread and its line."""
        self._over.set()
        self._thread.join(timeout=2)
        for descriptor in (self._host, self._line):
            os.close(descriptor)

    def _say(self, data: bytes) -> None:
        os.write(self._host, data)

    def _run(self) -> None:
        self.sketch.start()
        pending = bytearray()
        while not self._over.is_set():
            follow_pins(self.sketch, self.plant)
            if select.select([self._host], [], [], 0.002)[0]:
                for byte in os.read(self._host, 4096):
                    self._take(byte, pending)

    def _take(self, byte: int, pending: bytearray) -> None:
        """Whole messages to outputs are counted, and the plant follows each."""
        if byte >= 0x80:
            pending.clear()
        pending.append(byte)
        whole = len(pending) == 3 and pending[0] in {0x90 | port for port in OUTPUT_PORTS}
        if whole and any(pending[1:]):
            self.messages += 1
            if self.messages == self._reset_at:
                self.was_reset = True
                self.sketch.reset(self._greets)
                follow_pins(self.sketch, self.plant)
                return
        self.sketch.take(byte)
        if whole:
            follow_pins(self.sketch, self.plant)


@dataclass
class Round:
    """One job with one reset. ``violations`` is what must stay empty."""

    message: int
    greets: bool
    violations: list[str] = field(default_factory=list)
    messages: int = 0  # of the first run
    was_reset: bool = False
    named: bool = False
    busy: bool = False  # the computer cut a run off by itself

    def check(self, holds: bool, otherwise: str) -> None:
        if not holds:
            kind = "greets" if self.greets else "quiet"
            self.violations.append(f"reset at message {self.message}, {kind}: {otherwise}")


def play_round(job: Job, folder: Path, message: int, greets: bool) -> Round:
    """The job of ``board_resets.short_job`` in this folder; message 0 is no reset."""
    r = Round(message, greets)
    board = ResettingBoard(IdealPlant(job.machine))
    try:
        board.arm(message, greets)
        told, said = _drillctl(folder, board.device, "run", "short.drl", "--machine", "short.toml", "--journal", "j")
        made, r.messages, r.was_reset = board.plant.touches, board.messages, board.was_reset
        _judge_run(r, told, made)
        reason = "reported a new start" if greets else "not as it was set"
        r.check(reason in said or r.busy or not r.was_reset, f"the reason is not told: {said}")
        board.arm(0, greets=False)
        for _ in range(MOST_RESUMES):
            if told["holes_done"] == told["holes_total"]:
                break
            done, before = told["holes_done"], board.plant.touches
            told, said = _drillctl(folder, board.device, "resume", "j")
            r.named |= "is drilled again" in said
            fresh = board.plant.touches - before
            r.check(told["holes_done"] - done <= fresh, f"{told['holes_done'] - done} told as done, {fresh} made")
        r.busy |= told["fault"] is not None and told["fault"]["name"] in OF_A_BUSY_COMPUTER
        r.check(r.busy or told["holes_done"] == told["holes_total"], f"not finished: {told}")
    finally:
        board.close()
    return r


def _judge_run(r: Round, told: dict[str, Any], made: int) -> None:
    """The run in which it was reset."""
    fault = told["fault"]["name"] if told["fault"] else None
    r.busy = fault in OF_A_BUSY_COMPUTER
    r.check(told["holes_done"] <= made, f"{told['holes_done']} holes told as done, {made} made")
    if r.was_reset and not r.busy:
        r.check(fault == "PORT_LOST", f"fault {fault}")
    if r.was_reset and fault == "PORT_LOST":
        r.check(not told["position_known"], "the position is told as known")


def _drillctl(folder: Path, device: str, *arguments: str) -> tuple[dict[str, Any], str]:
    """The outcome, and what was said on standard error. A line that was refused changed nothing, and is asked again."""
    call = [sys.executable, "-m", "drillctl", *arguments, "--port", f"firmata:{device}", "--pace", "real"]
    call += ["--tools", "assume", "--json"]
    for _ in range(MOST_TRIES):
        done = subprocess.run(call, cwd=folder, capture_output=True, text=True, timeout=RUN_S, check=False)
        told = json.loads(done.stdout or "{}")
        if "holes_done" in told:
            return told, done.stderr
    raise AssertionError(f"refused: {done.stdout} {done.stderr}")
