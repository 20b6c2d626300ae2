"""A board drilled in real pace on the real firmware, the loop closed: initialised and drilled by what its pins read.

The whole program runs in a process of its own, on the serial line of a simulated Mega with unmodified StandardFirmata.
What its AVR puts out drives an ideal plant, whose sensors are levels at the AVR's pins (loop.py).
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

import pytest

from drillctl.machine import Library, shipped_tables
from drillctl.plant import IdealPlant
from drillctl.replay.compare import replay
from drillctl.trace import Trace, dense, read_text
from tests.firmware import board as boards
from tests.firmware.board import SimulatedBoard
from tests.firmware.job import HOLES_MM, SPINDLE_PIN, STEPS_PER_MM, drillctl, write_job
from tests.firmware.loop import OUTPUT_PINS, WiredPlant
from tests.firmware.updates import Update, check_seen, updates_of
from tests.support.decoder import Watch, decoders

pytestmark = [pytest.mark.paced, pytest.mark.skipif(bool(boards.missing()), reason=boards.missing())]

REST_STEPS = 3  # of a rotor: columns 1 to 3 of the phase table are one place
CREEP_TICKS = 4  # a step of the way off a sensor
TICK_HZ = 500


@dataclass(frozen=True)
class Drilled:
    """What is known of the run when it is over."""

    told: dict[str, Any]
    machine_file: Path
    trace_file: Path
    wired: WiredPlant
    seen: list[Update]  # from power-up on
    spindle: list[int]  # the levels of its pin, one after the other

    @property
    def trace(self) -> Trace:
        return read_text(self.trace_file)


@pytest.fixture(scope="module")
def drilled(host: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Drilled]:
    folder = tmp_path_factory.mktemp("loop")
    machine_file = write_job(folder)
    plant = IdealPlant(Library.standard().machine(str(machine_file)))
    arduino = SimulatedBoard(host, boards.MEGA, folder)
    try:
        with WiredPlant(arduino, plant) as wired:
            job = ("run", "board.drl", "--machine", "near.toml", "--journal", "j", "--trace", "t.trace")
            run = drillctl(folder, arduino.device, *job)
            out, err = run.communicate(timeout=90)
        assert run.returncode == 0, err + out
        arduino.wait_for_low(OUTPUT_PINS)
        seen = arduino.port_updates(OUTPUT_PINS, since=0)
        spindle = [level for _, pin, level in arduino.changes() if pin == SPINDLE_PIN]
        yield Drilled(json.loads(out), machine_file, folder / "t.trace", wired, seen, spindle)
    finally:
        arduino.close()


def test_all_holes_are_drilled_and_nothing_is_amiss(drilled: Drilled) -> None:
    told = drilled.told
    assert (told["holes_done"], told["holes_total"], told["fault"]) == (4, 4, None)
    assert told["position_known"] and told["tick_hz"] == TICK_HZ


def test_the_pins_have_the_traces_images_each_once_and_in_order(drilled: Drilled) -> None:
    sent = updates_of(drilled.trace)
    assert len(sent) > 900
    check_seen(sent, drilled.seen)


def test_the_plants_holes_are_the_files(drilled: Drilled) -> None:
    """To the step but for where zero was found: a sensor answers a few ticks late, and each is a piece of a step."""
    assert len(drilled.wired.touches) == len(HOLES_MM)
    for axis in (0, 1):
        off = [place[axis] - mm[axis] * STEPS_PER_MM for place, mm in zip(drilled.wired.touches, HOLES_MM, strict=True)]
        assert max(off) - min(off) <= REST_STEPS
        assert abs(min(off, key=abs)) <= REST_STEPS + max(answer_ticks(drilled)) / CREEP_TICKS


def test_the_spindle_turns_while_the_board_is_drilled_and_stands_at_a_tool_change(drilled: Drilled) -> None:
    assert drilled.wired.turning == [True] * len(HOLES_MM)
    assert [level for level, _ in groupby([0, *drilled.spindle])] == [0, 1, 0, 1, 0]


def test_no_step_is_lost(drilled: Drilled) -> None:
    """The rotors stand where the words sent have sent them, and the controller's position says so."""
    words = dense(drilled.trace, "out.0").tolist()
    for axis, decoder in enumerate(decoders(drilled.machine_file, shipped_tables())):
        recount = decoder.recount(words, Watch())
        rotor = drilled.wired.plant.rotors[axis]
        assert [rotor.columns_lost(count) for count in (recount.least[-1], recount.most[-1])] == [0.0, 0.0]
    end_steps = [drilled.wired.plant.position_steps(axis) for axis in (0, 1)]
    last_mm, last_steps = HOLES_MM[-1], drilled.wired.touches[-1]
    for axis, name in enumerate("xy"):
        since_last_hole = drilled.told["position"][name] - last_mm[axis] * STEPS_PER_MM
        assert abs(end_steps[axis] - last_steps[axis] - since_last_hole) <= REST_STEPS


def test_the_run_replays(drilled: Drilled) -> None:
    assert not replay(drilled.trace_file, Library.standard()).failed(same_tables_wanted=True)


def test_sensors_answer_soon_enough_for_the_shipped_machine(drilled: Drilled) -> None:
    """Half of the answers at least: within the 10 steps that its head has from braking to the end of its range."""
    found = sorted(answer_ticks(drilled))
    assert len(found) > 10 and found[0] >= 1
    assert found[len(found) // 2] <= 10


def answer_ticks(drilled: Drilled) -> list[int]:
    """For each change of a sensor: ticks from the image that made it to the tick that latched it. Without a line, 1."""
    plant = IdealPlant(Library.standard().machine(str(drilled.machine_file)))
    bits = [1 << bit for bit in range(6)]
    made: dict[int, list[int]] = {bit: [] for bit in bits}
    latched: dict[int, list[int]] = {bit: [] for bit in bits}
    levels, read = plant.inputs, plant.inputs
    images, inputs = (dense(drilled.trace, name).tolist() for name in ("out.0", "in.0"))
    for tick, (image, word) in enumerate(zip(images, inputs, strict=True)):
        plant.drive(image)
        for bit in bits:
            if (levels ^ plant.inputs) & bit:
                made[bit].append(tick)
            if (read ^ word) & bit:
                latched[bit].append(tick)
        levels, read = plant.inputs, word
    return [late - soon for bit in bits for soon, late in zip(made[bit], latched[bit], strict=True)]
