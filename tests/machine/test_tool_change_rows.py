"""Rows of ``[[tool_change]]`` that can't be meant, and the inputs that they look at."""

import pytest

from drillctl.machine import Machine, TableError
from tests.machine.test_parameters import machine_of, shipped_text

CHUCK = 'fault = "CHANGE_CHUCK"\ninput = "chuck_open"\n'


def changed(old: str, new: str) -> Machine:
    text = shipped_text()
    assert old in text
    return machine_of(text.replace(old, new, 1))


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (CHUCK, CHUCK.replace("chuck_open", "chuck_shut"), "step 6: the machine has no such input"),
        ('input = "foot_up"\n', "reads = 1\n", "step 2: what it reads belongs to an input"),
        ('fault = "TOOL_NOT_LEFT"\n', 'fault = "TOOL_NOT_LEFT"\ninput = "tool"\n', "step 10: it looks at the tool sen"),
        ('name = "chuck_open_6"', 'name = "chuck_open_7"', "step 6: the machine has no such input"),
    ],
)
def test_an_input_that_a_step_can_not_look_at_is_refused_by_the_step(old: str, new: str, reason: str) -> None:
    with pytest.raises(TableError, match=reason) as refused:
        changed(old, new)
    assert refused.value.line is not None


def test_a_step_may_look_at_nothing_at_one_input_or_at_one_of_each_spindle() -> None:
    changer = changed('input = "foot_up"\n', "").tool_changer
    assert changer is not None
    assert [(step.input, step.reads) for step in changer.steps[:7]] == [
        ("", 1), ("", 1), ("xy_in_place", 1), ("xy_in_place", 1), ("", 1), ("chuck_open", 1), ("chuck_open", 1),
    ]  # fmt: skip
