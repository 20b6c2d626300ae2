"""Each of the 23 steps of an automatic tool change made to fail: the fault names the step, the record stays true, and
once somebody has looked the rest of the board is drilled, no hole more and none less.
"""

from contextlib import closing
from dataclasses import replace

import pytest

from drillctl.generation.eight_axis.magazine import EMPTY, Magazine
from drillctl.generation.errors import JobError
from drillctl.jobs.magazine import MagazineFile
from drillctl.kmd import Fault
from drillctl.machine import Machine
from drillctl.machine.levels import SPEED_ACTUAL
from drillctl.ticker.link import LocalLink
from tests.jobs.near_machine import MACHINE, SPINDLES, check_true, runner, stepped

HOME, FOOT, THERE, HEIGHT, CHUCK = (
    Fault.CHANGE_Z_NOT_HOME, Fault.CHANGE_FOOT, Fault.CHANGE_NOT_THERE, Fault.CHANGE_HEIGHT, Fault.CHANGE_CHUCK,
)  # fmt: skip
# By step: what fails (input=level from then on, something about the bits, its time) and the fault that comes of it.
STEPS = {
    1: ("z1_home=0", HOME), 2: ("foot_up=0", FOOT), 3: ("xy_in_place=0", THERE), 4: ("xy_in_place=0", THERE),
    5: ("time", HEIGHT), 6: ("chuck_open_1=0", CHUCK), 7: ("chuck_open_3=0", CHUCK), 8: ("z3_home=0", HOME),
    9: ("xy_in_place=0", THERE), 10: ("stuck", Fault.TOOL_NOT_LEFT), 11: ("z1_home=0", HOME),
    12: ("xy_in_place=0", THERE), 13: ("xy_in_place=0", THERE), 14: ("xy_in_place=0", THERE), 15: ("time", HEIGHT),
    16: ("chuck_open_3=1", CHUCK), 17: ("chuck_open_1=1", CHUCK), 18: ("z1_home=0", HOME), 19: ("xy_in_place=0", THERE),
    20: ("missing", Fault.TOOL_NOT_TAKEN), 21: ("z3_home=0", HOME), 22: ("xy_in_place=0", THERE),
    23: ("foot_up=1", FOOT),
}  # fmt: skip
OTHERS = [
    *((number, "time", fault) for number, (how, fault) in STEPS.items() if how in ("xy_in_place=0", "z1_home=0")
      and number not in (11, 12, 21, 22)),  # nothing moves in these: the heads are up and the table is parked
    *((number, "x_alarm=1", Fault.DRIVE_ALARM) for number in (1, 6, 12, 17, 22)),
    (20, "dropped", Fault.TOOL_NOT_TAKEN),
]  # fmt: skip


@pytest.mark.parametrize(("number", "how", "fault"), [(number, *row) for number, row in STEPS.items()])
def test_after_a_step_that_failed_the_rest_is_drilled_once_somebody_has_looked(
    number: int, how: str, fault: Fault, kept: MagazineFile
) -> None:
    failed(number, how, fault, kept)
    doubtful = MagazineFile(kept.file, MACHINE)
    if any(doubtful.magazine.unknown()):
        with pytest.raises(JobError, match="unknown what the chucks of spindles 1, 3 hold"):
            runner(MACHINE, doubtful, done={1})
        doubtful.keep(looked_at(number, doubtful.magazine))
    run = runner(MACHINE, doubtful, done={1})
    with closing(run.link):
        for _ in stepped(run):
            pass
        assert not run.status["fault"]
    drilled = sorted((hole.number, hole.spindle) for hole in run.holes)
    assert drilled == [(hole, spindle) for hole in (2, 3) for spindle in SPINDLES]
    assert MagazineFile(kept.file, MACHINE).magazine.unknown() == ([], [])


@pytest.mark.parametrize(("number", "how", "fault"), OTHERS)
def test_a_step_that_fails_is_named_and_what_it_made_doubtful_is_unknown(
    number: int, how: str, fault: Fault, kept: MagazineFile
) -> None:
    failed(number, how, fault, kept)


def failed(number: int, how: str, fault: Fault, kept: MagazineFile) -> None:
    """Drills from the second hole on with a change in which that fails; checks fault, step and record."""
    run = runner(with_limit(number, 0.001) if how == "time" else MACHINE, kept, done={1})
    assert isinstance(run.link, LocalLink)
    with closing(run.link):
        spoil(run.link, how)
        begun = False
        for step in stepped(run):
            if not begun and step == number and "=" in how:
                begun = True
                force(run.link, *how.split("="))
            check_true(MagazineFile(kept.file, MACHINE).magazine, run.link)
        assert (int(run.status["step"]), Fault(run.status["fault"])) == (number, fault)
        assert run.holes == []
    chucks, bits = MagazineFile(kept.file, MACHINE).magazine.unknown()
    leaving, taking = 5 <= number < 11, 15 <= number < 21
    assert chucks == ([1, 3] if leaving or taking else [])
    assert {place for place, _ in bits} == ({1} if leaving else {2} if taking else set())


def looked_at(number: int, magazine: Magazine) -> Magazine:
    """What somebody says who has looked, and put every bit back into its place by hand."""
    place = 1 if number < 11 else 2
    return magazine.with_chucks(SPINDLES, EMPTY).with_bits(place, SPINDLES, True)


def with_limit(number: int, limit_s: float) -> Machine:
    """The machine with another time limit of a step."""
    assert MACHINE.tool_changer is not None
    steps = list(MACHINE.tool_changer.steps)
    steps[number - 1] = replace(steps[number - 1], limit_s=limit_s)
    return replace(MACHINE, tool_changer=replace(MACHINE.tool_changer, steps=tuple(steps)))


def force(link: LocalLink, name: str, level: str) -> None:
    """The wire of an input is low (0) or high (1) from now on."""
    port, bit = link.ticker.port, next(1 << line.bit for line in MACHINE.input_lines if line.name == name)
    latch = port.latch
    port.latch = lambda: latch() | bit if level == "1" else latch() & ~bit  # type: ignore[method-assign]


def spoil(link: LocalLink, how: str) -> None:
    """Makes a tool stay in the chuck of spindle 1, be missing in its place, or fall out on the way up."""
    plant = link.ticker.plant
    assert plant is not None
    chuck = plant.chucks.of(MACHINE.drill_axes[0])
    assert chuck is not None
    if how == "stuck":
        chuck.output = 0  # it does not open
    elif how == "missing":
        magazine = plant.chucks._magazine  # the plant has no other door to it
        assert magazine is not None
        magazine.take((2, 1))
    elif how == "dropped":
        chuck.drops_at = 1


def test_no_step_is_begun_while_the_spindle_does_not_stand(kept: MagazineFile) -> None:
    run = runner(MACHINE, kept, done={1})
    assert isinstance(run.link, LocalLink)
    word, before = MACHINE.input_word(SPEED_ACTUAL), MagazineFile(kept.file, MACHINE).magazine
    assert word is not None
    with closing(run.link):
        port = run.link.ticker.port
        latch = port.latch
        port.latch = lambda: word.put(latch(), 300)  # type: ignore[method-assign]
        for _ in stepped(run):
            pass
        assert (int(run.status["step"]), Fault(run.status["fault"])) == (0, Fault.SPINDLE_SPEED)
    assert MagazineFile(kept.file, MACHINE).magazine == before
