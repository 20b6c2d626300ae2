"""The questions asked of the status record: whether the machine is idle, and whether a job is over."""

from itertools import product

import numpy as np
import pytest

from drillctl.kmd import STATUS, Condition, has_ended, is_complete, is_idle, is_over

LAST, EPOCH = 7, 3


def status(condition: Condition = Condition.READY, job: int = 0, moving: int = 0,
           done: int = LAST, epoch: int = EPOCH) -> np.void:  # fmt: skip
    record = np.zeros(1, dtype=STATUS)
    for name, value in [("condition", condition), ("job", job), ("moving", moving), ("done", done), ("epoch", epoch)]:
        record[name] = value
    made: np.void = record[0]
    return made


def over(record: np.void) -> bool:
    return is_over(record, LAST, EPOCH)


@pytest.mark.parametrize(
    "record",
    [
        pytest.param(status(), id="complete"),
        pytest.param(status(done=LAST - 1, epoch=EPOCH + 1), id="stopped"),
        pytest.param(status(Condition.LATCHED, done=LAST - 1), id="latched outside a job"),
        pytest.param(status(Condition.LATCHED, job=1, done=LAST - 1), id="latched in a job"),
    ],
)
def test_a_job_that_has_ended_is_over_once_nothing_moves(record: np.void) -> None:
    assert over(record)
    record = record.copy()
    record["moving"] = 2
    assert not over(record)


def test_a_job_is_not_over_before_its_first_command() -> None:
    before = status(done=LAST - 4)
    assert has_ended(before["condition"], before["job"], before["moving"]) and not over(before)


@pytest.mark.parametrize("record", [status(job=1), status(job=1, done=LAST - 1), status(job=1, epoch=EPOCH + 1)])
def test_a_job_is_not_over_in_mid_program(record: np.void) -> None:
    assert not over(record)


@pytest.mark.parametrize("condition", [Condition.HOLDING, Condition.STOPPING, Condition.RETURNING])
def test_a_machine_that_holds_brakes_or_returns_has_not_ended(condition: Condition) -> None:
    for job, moving in product((0, 1), (0, 2)):
        assert not has_ended(condition, job, moving) and not is_idle(condition, job, moving)
        assert not over(status(condition, job, moving, epoch=EPOCH + 1))


def test_a_latched_machine_has_ended_and_is_not_idle() -> None:
    for condition in (Condition.LATCHED, Condition.ZERO_ONLY):
        assert has_ended(condition, 0, 0) and not has_ended(condition, 0, 1) and not is_idle(condition, 0, 0)
    assert is_idle(Condition.READY, 0, 0) and not is_idle(Condition.READY, 1, 0) and not is_idle(Condition.READY, 0, 1)


def test_a_program_is_complete_with_its_last_command() -> None:
    assert is_complete(status(), LAST) and not is_complete(status(done=LAST - 1), LAST)
