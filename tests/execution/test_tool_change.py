"""Steps of a tool change: the status names them, a command of a step that takes too long or fails ends in the step's
fault, and the stroke of the heads goes back to its whole length by itself.
"""

from dataclasses import replace

import pytest

from drillctl.kmd import Fault, Request
from drillctl.machine.tool_change import ChangeStep, ToolChanger
from tests.support.bench import Bench, shipped

LIMIT_TICKS = 100
STEPS = (
    ChangeStep("home", 9.0, "CHANGE_Z_NOT_HOME"),
    ChangeStep("xy", LIMIT_TICKS / 500, "CHANGE_NOT_THERE", to="parking"),
    ChangeStep("taken", 9.0, "TOOL_NOT_TAKEN", part="new"),
)


def ready() -> Bench:
    return Bench(replace(shipped("pcb-drill"), tool_changer=ToolChanger("together", 1.0, 1.0, STEPS))).ready()


@pytest.mark.parametrize(
    ("queue", "step", "fault"),
    [
        ("KMD_KROK 2; KMD_GOTO_X_Y 70 0", 2, Fault.NONE),  # d + 21 ticks
        ("KMD_KROK 2; KMD_GOTO_X_Y 90 0", 2, Fault.CHANGE_NOT_THERE),
        ("KMD_KROK 2; KMD_CZEKAJ 90; KMD_CZEKAJ 90", 2, Fault.NONE),  # the limit is that of each command
        ("KMD_KROK 2; KMD_KROK 0; KMD_GOTO_X_Y 200 0", 0, Fault.NONE),
        ("KMD_KROK 3; KMD_CZEKAJ_WE x_max 1 9", 3, Fault.TOOL_NOT_TAKEN),
        ("KMD_KROK 4", 0, Fault.BAD_COMMAND),
    ],
)
def test_a_step_has_its_number_its_time_and_its_fault(queue: str, step: int, fault: Fault) -> None:
    b = ready().queue(queue)
    b.finish()
    assert (int(b.ticker.report()["step"]), b.m.fault) == (step, fault)


def test_a_hold_does_not_count_into_the_time_of_a_step() -> None:
    b = ready().queue("KMD_KROK 2; KMD_GOTO_X_Y 70 0").tick(40).ask(Request.HOLD).tick(3 * LIMIT_TICKS)
    b.ask(Request.RESUME).finish()
    assert b.m.fault == Fault.NONE and b.m.axes[0].position == 70


def test_a_head_that_finds_no_sensor_ends_in_the_fault_of_its_step() -> None:
    b = ready().queue("KMD_WIERTLO_DOL; KMD_KROK 1; KMD_CZEKAJ 9; KMD_WIERTLO_DOM")
    b.until(lambda: b_step(b) == 1)
    b.card.stuck_low = b.input_bit("z_top")
    b.finish()
    assert b.m.fault == Fault.CHANGE_Z_NOT_HOME


def b_step(b: Bench) -> int:
    return int(b.ticker.report()["step"])


def test_the_step_that_failed_is_named_until_the_next_initialisation() -> None:
    b = ready().queue("KMD_KROK 2; KMD_GOTO_X_Y 300 0")
    b.finish()
    assert b_step(b) == 2
    b.ask(Request.ACK).tick().queue("KMD_GOTO_X_Y 100 0").finish()
    assert (b.m.fault, b_step(b)) == (Fault.NONE, 2)  # and its time limit is over
    b.queue("KMD_INICJALIZACJA").finish()
    assert b_step(b) == 0


def test_heads_wait_where_the_stroke_says_until_the_next_initialisation_or_stop() -> None:
    b = Bench(shipped("eight-axis")).ready()
    z1 = b.m.axes[2]
    b.queue("KMD_SUW z1=40; KMD_RUCH z1=60; KMD_WIERTLO_GORA z1").finish()
    assert z1.position == 40
    b.queue("KMD_GOTO_X_Y 50 0").tick(5).ask(Request.STOP).finish()
    b.queue("KMD_WIERTLO_GORA z1").finish()
    assert z1.position == z1.top < 40
    b.queue("KMD_SUW x=40").finish()
    assert b.m.fault == Fault.SOFT_LIMIT  # x is no head
