"""The magazine record: kept across a cut at every step of a change and never untrue, and what a job makes of it."""

from contextlib import closing
from pathlib import Path

import pytest

from drillctl.generation.eight_axis.magazine import full_magazine
from drillctl.jobs.magazine import MagazineError, MagazineFile
from drillctl.ticker.link import LocalLink
from tests.jobs.near_machine import MACHINE, SPINDLES, check_true, runner, stepped


def test_a_cut_at_any_step_leaves_a_record_that_is_true_and_a_whole_one_ends_with_the_new_tool(
    kept: MagazineFile,
) -> None:
    run = runner(MACHINE, kept)
    assert isinstance(run.link, LocalLink)
    unknown_at, seen = set(), set()
    with closing(run.link):
        for step in stepped(run):
            on_disk = MagazineFile(kept.file, MACHINE).magazine
            check_true(on_disk, run.link)
            seen.add(step)
            if any(on_disk.unknown()):
                unknown_at.add(step)
        assert not run.status["fault"] and len(run.holes) == 6
    assert set(range(1, 24)) <= seen
    assert unknown_at <= {*range(5, 11), *range(15, 21)} and {6, 7, 8, 16, 17, 18} <= unknown_at
    magazine = MagazineFile(kept.file, MACHINE).magazine
    assert [magazine.chucks[n] for n in SPINDLES] == [2, 2] and magazine.hits == {1: 1, 2: 2}
    assert magazine.bits[1, 1] is True and magazine.bits[2, 1] is False and magazine.unknown() == ([], [])


def test_a_record_that_another_run_has_changed_stops_the_job(kept: MagazineFile) -> None:
    run = runner(MACHINE, kept)
    with closing(run.link):
        run.begin()
        MagazineFile(kept.file, MACHINE).keep(full_magazine(MACHINE))
        while not run.advance():
            pass
    assert "another run has changed it" in str(run.trouble)
    assert MagazineFile(kept.file, MACHINE).magazine == full_magazine(MACHINE)


@pytest.mark.parametrize("text", ["", "{}", '{"drillctl-magazine": 2}', "[" * 5000, '{"drillctl-magazine": "x"}'])
def test_what_is_no_record_is_refused_by_the_name_of_the_file(text: str, tmp_path: Path) -> None:
    file = tmp_path / "m.magazine"
    file.write_text(text)
    with pytest.raises(MagazineError, match=r"m\.magazine: is no magazine record"):
        MagazineFile(file, MACHINE)
    assert file.read_text() == text
