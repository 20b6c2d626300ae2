"""A machine of as many axes as there is room for: the eight-axis one with a magazine's turn and gripper besides."""

from pathlib import Path

import pytest

from drillctl.generation.job import Job, names_of
from drillctl.jobs.journal import head_of
from drillctl.kmd import parse_program
from drillctl.kmd.commands import MOST_AXES
from drillctl.kmd.text import to_text
from drillctl.machine import Library, TableError, shipped_tables
from drillctl.trace import first_difference
from tests.support.twins import remembered, trace, twins

MAGAZINE = ("turn", "gripper")
AXIS = """
[[axis]]
name = "{name}"
phase = "pulse-direction"
ramp = "drive-servo"
columns_per_step = 2
columns_per_inch = 5080
range = [-100, 4000]
start = 0
"""
QUEUE = "KMD_RUCHd x=12 turn=300 gripper=70\nKMD_LINIAd turn=-40 gripper=-20\nKMD_KONIEC\n"
MOST_TICKS = 5_000


def machine_file(folder: Path, added: tuple[str, ...]) -> Path:
    """The shipped machine's file with these axes, on free bits of its cards."""
    text = (shipped_tables() / "machines" / "eight-axis.toml").read_text()
    wires = "".join(f'"{name}.pulse" = {24 + 2 * i}\n"{name}.dir" = {25 + 2 * i}\n' for i, name in enumerate(added))
    text = text.replace("[wiring]\n", "[wiring]\n" + wires)
    file = folder / "with-magazine.toml"
    file.write_text(text.replace('"eight-axis"', '"with-magazine"') + "".join(AXIS.format(name=name) for name in added))
    return file


def test_axes_of_a_magazine_move_and_are_reported(tmp_path: Path) -> None:
    machine = Library((shipped_tables(),)).machine(str(machine_file(tmp_path, MAGAZINE)))
    assert len(machine.axes) == MOST_AXES
    program = parse_program(QUEUE, names_of(machine))
    assert [to_text(record, names_of(machine)) for record in program] == QUEUE.splitlines()
    ticked, fast = twins(machine, program, {}, MOST_TICKS)
    assert first_difference(trace(ticked), trace(fast)) is None and remembered(ticked) == remembered(fast)
    status = ticked.report()
    assert status["position"].tolist() == status["target"].tolist() == [12, *[0] * 7, 260, 50]
    assert status["steps"].tolist() == [12, *[0] * 7, 340, 90] and not status["lost"].any()


def test_one_axis_more_than_there_is_room_for_is_refused(tmp_path: Path) -> None:
    with pytest.raises(TableError, match=rf"axis.*{MOST_AXES}"):
        Library((shipped_tables(),)).machine(str(machine_file(tmp_path, (*MAGAZINE, "cover"))))


def test_a_journal_of_eight_axes_keeps_its_digest_and_further_axes_count(tmp_path: Path) -> None:
    """Begun when a record had room for eight axes, in 52 bytes, it is still gone on with."""
    machine = Library((shipped_tables(),)).machine(str(machine_file(tmp_path, MAGAZINE)))

    def digest(text: str) -> str:
        job = Job("q.kmd", parse_program(text, names_of(machine)), machine)
        return head_of(tmp_path / "with-magazine.toml", job, {}).program_digest

    assert digest("KMD_RUCHd x=1 z6=-2") == "e1a05b2cc2cf32e9b6c31e9e9a2d2234f69a630619495ab2dcf8db3011c67e87"
    assert len({digest(f"KMD_RUCHd {axis}={steps}") for axis in MAGAZINE for steps in (1, 2)}) == 4
