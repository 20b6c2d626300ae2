"""Every pair of the state table, against the running controller (docs/STATES.md; docs/SPEC.md, 1.6 to 1.8 and 1.17)."""

from dataclasses import replace
from itertools import pairwise

import pytest

from drillctl.execution.conditions import TABLE, Event, raise_fault
from drillctl.execution.controller import CONDITIONS, Stage
from drillctl.execution.motion import AxisMotion
from drillctl.kmd import Fault, Request
from tests.support.bench import Bench, shipped
from tests.support.invariants import Invariants

NEW_HZ = 300

# By event, the stage that comes next from each stage; "." is the same one, and nothing is done.
EXPECTED = """
                IDLE            ZERO_ONLY       RUNNING         HOLDING         STOPPING        FAULT_STOPPING  RETURN_STOPPING RETURNING       LATCHED
COMMAND         RUNNING         RUNNING         .               .               .               .               .               .               .
JOB_END         .               .               IDLE            .               .               .               .               .               .
REST            .               .               .               .               IDLE            LATCHED         RETURNING       RETURNING       .
HOME            .               .               .               .               .               .               .               LATCHED         .
PAUSE           IDLE            ZERO_ONLY       RUNNING         HOLDING         STOPPING        FAULT_STOPPING  RETURN_STOPPING RETURNING       LATCHED
STOP            STOPPING        STOPPING        STOPPING        STOPPING        STOPPING        FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING  .
HOLD            .               .               HOLDING         .               .               .               .               .               .
RESUME          .               .               .               RUNNING         .               .               .               .               .
ACK             .               .               .               .               .               .               .               .               IDLE
OUTPUT          IDLE            .               .               .               .               .               .               .               .
PACE            IDLE            ZERO_ONLY       RUNNING         HOLDING         STOPPING        FAULT_STOPPING  RETURN_STOPPING RETURNING       LATCHED
INPUT_STOP      .               .               STOPPING        STOPPING        .               .               FAULT_STOPPING  FAULT_STOPPING  .
FAULT_STOP      FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING
FAULT_RETURN    RETURN_STOPPING RETURN_STOPPING RETURN_STOPPING RETURN_STOPPING RETURN_STOPPING FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING  FAULT_STOPPING
FAULT_DROP      LATCHED         LATCHED         LATCHED         LATCHED         LATCHED         LATCHED         LATCHED         LATCHED         LATCHED
FAULT_FREEZE    LATCHED         LATCHED         LATCHED         LATCHED         LATCHED         LATCHED         LATCHED         LATCHED         LATCHED
ZERO_FIRST      ZERO_ONLY       .               .               .               .               .               .               .               .
"""  # noqa: E501
HEADER, *ROWS = (line.split() for line in EXPECTED.strip().splitlines())
NEXT = {(Stage[at], Event[row[0]]): to for row in ROWS for at, to in zip(HEADER, row[1:], strict=True)}

REQUESTS = {
    Event.PAUSE: Request.PAUSE, Event.STOP: Request.STOP, Event.HOLD: Request.HOLD, Event.RESUME: Request.RESUME,
    Event.ACK: Request.ACK,
}  # fmt: skip
FAULTS = {
    Event.FAULT_STOP: Fault.INPUT_TIMEOUT, Event.FAULT_RETURN: Fault.DRILLING_TIME, Event.FAULT_DROP: Fault.PORT_LOST,
    Event.FAULT_FREEZE: Fault.EMERGENCY_STOP,
}  # fmt: skip
NAMED = {"ids": lambda value: value.name}


class Watched(Bench):
    """A machine that holds its current in an emergency stop, and the stages that it enters."""

    def __init__(self) -> None:
        machine = replace(shipped("pcb-drill"), emergency_stop="hold", only_zero_after=("LINE_MISMATCH",))
        super().__init__(machine)
        self.m.position_known = True
        self.entered: list[Stage] = []
        self._enter = self.m.enter
        self.m.enter = self.note  # type: ignore[method-assign]
        self.check = Invariants(self.m)

    def note(self, stage: Stage) -> None:
        self.entered.append(stage)
        self._enter(stage)

    def checked(self, ticks: int = 1) -> None:
        """So many ticks, each of them sound."""
        self.ticker.run(ticks, self.check)


def moving(request: Request = Request.NONE, fault: Fault = Fault.NONE) -> Watched:
    """Two axes in mid-ramp, a command waits; then a request or a fault, and its tick."""
    b = Watched()
    b.queue("KMD_GOTO_X_Y 200 100; KMD_GOTO_X_Y 0 0").tick(60)
    if request:
        b.ask(request).tick()
    if fault:
        raise_fault(b.m, fault)
        b.tick()
    return b


def at(stage: Stage) -> Watched:
    """A machine brought to a stage by commands, requests and faults alone."""
    if stage in (Stage.RETURNING, Stage.LATCHED):
        b = moving(fault=Fault.DRILLING_TIME if stage == Stage.RETURNING else Fault.INPUT_TIMEOUT)
        b.until(lambda: b.m.stage == stage)
        b.tick(3)
    elif stage == Stage.ZERO_ONLY:
        b = moving(fault=Fault.LINE_MISMATCH)
        b.until(b.latched)
        b.ask(Request.ACK).tick()
    else:
        b = {
            Stage.IDLE: Watched,
            Stage.RUNNING: moving,
            Stage.HOLDING: lambda: moving(Request.HOLD),
            Stage.STOPPING: lambda: moving(Request.STOP),
            Stage.FAULT_STOPPING: lambda: moving(fault=Fault.INPUT_TIMEOUT),
            Stage.RETURN_STOPPING: lambda: moving(fault=Fault.DRILLING_TIME),
        }[stage]()
    assert (b.m.stage, b.m.condition) == (stage, CONDITIONS[stage])
    b.entered.clear()
    b.check = Invariants(b.m)
    return b


def expected(stage: Stage, event: Event) -> list[Stage]:
    """The stages that one event enters."""
    to = NEXT[stage, event]
    return [] if to == "." else [Stage[to]]


def test_the_table_has_these_pairs_and_no_other() -> None:
    assert set(NEXT) == {(stage, event) for stage in Stage for event in Event}
    assert {pair: [to] for pair, (to, _) in TABLE.items()} == {p: expected(*p) for p, to in NEXT.items() if to != "."}


@pytest.mark.parametrize("event", [*REQUESTS, Event.OUTPUT, Event.PACE], **NAMED)
@pytest.mark.parametrize("stage", Stage, **NAMED)
def test_every_request_at_every_stage(stage: Stage, event: Event) -> None:
    b, entered = at(stage), expected(stage, event)
    if event in REQUESTS:
        b.ask(REQUESTS[event])
    elif event == Event.OUTPUT:
        assert b.ticker.requests.set_output(b.machine.axes[1].wire_bits[0], 1)
    else:
        assert b.ticker.requests.set_rate(NEW_HZ)
    epoch, fault, known = b.m.epoch, b.m.fault, b.m.position_known
    b.tick()
    assert b.entered[: max(1, len(entered))] == entered
    assert b.m.epoch - epoch == (event == Event.STOP and len(entered))
    assert b.m.fault == (0 if entered == [Stage.IDLE] and event == Event.ACK else fault)
    assert (b.m.tick_hz == NEW_HZ) == (event == Event.PACE and stage == Stage.IDLE)
    if event == Event.OUTPUT:
        assert b.m.position_known == (known and stage != Stage.IDLE)
    else:
        b.checked(400)
    holds = event == Event.HOLD and stage == Stage.RUNNING
    assert not holds or ([axis.motion for axis in b.m.axes] == [AxisMotion.REST] * 3 and b.m.axes[0].target == 200)


@pytest.mark.parametrize("event", FAULTS, **NAMED)
@pytest.mark.parametrize("stage", Stage, **NAMED)
def test_every_kind_of_fault_at_every_stage(stage: Stage, event: Event) -> None:
    b = at(stage)
    first, epoch, bits = b.m.fault, b.m.epoch, [axis.hold_bits for axis in b.m.axes]
    raise_fault(b.m, FAULTS[event])
    b.check = Invariants(b.m)  # the fault came between two ticks
    assert b.entered == expected(stage, event)
    assert (b.m.fault, b.m.epoch, b.m.job) == (first or FAULTS[event], epoch + 1, False)
    b.checked(2)
    held = [axis.bits for axis in b.m.axes]
    assert event != Event.FAULT_DROP or held == [0, 0, 0]
    assert event != Event.FAULT_FREEZE or held == bits
    b.until(lambda: b.check() or b.latched())
    b.checked(20)


@pytest.mark.parametrize("stage", Stage, **NAMED)
def test_every_stage_left_alone_comes_to_rest_as_the_table_has_it(stage: Stage) -> None:
    """HOME ends the return; RUNNING ends with its job, whose last commands are taken meanwhile."""
    b, way, events = at(stage), [], [Event.REST, Event.HOME]
    if stage == Stage.RUNNING:
        events = [Event.JOB_END]
    there = stage
    while nexts := [to for event in events for to in expected(there, event) if to != there]:
        there = nexts[0]
        way.append(there)
    b.checked(4_000)
    changes = [after for before, after in pairwise([stage, *b.entered]) if after != before]
    assert (changes, b.m.stage) == (way, there)


@pytest.mark.parametrize("stage", Stage, **NAMED)
def test_commands_are_taken_where_the_table_says_so(stage: Stage) -> None:
    b = at(stage)
    b.queue("KMD_CZEKAJ 1000", end=False)
    taken = len(b.ticker.queue)
    b.checked(3)
    assert b.entered[:1] == (expected(stage, Event.COMMAND) or b.entered[:1])
    assert (Stage.RUNNING in b.entered) == (stage <= Stage.ZERO_ONLY)
    assert (len(b.ticker.queue) < taken) == (stage <= Stage.ZERO_ONLY)
