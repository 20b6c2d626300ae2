"""Jobs that were cut off: offered on Files and at the start, gone on with or given up."""

import pytest
from msgspec.structs import replace

from drillctl.language import words
from drillctl.viewmodel.jobs import Site, UnfinishedJob
from tests.support.labels import counted
from tests.support.messages import screen_templates
from tests.ui.fake_console import BOARD, FakeConsole, Program
from tests.ui.opened_board import SIZES

HERE = Site("simulated", "real", "ideal")
CUT = UnfinishedJob("/state/four.journal", "/home/four.drl", "pcb-drill", 3, 26, (4,), True, True, None, HERE, HERE)
pytestmark = pytest.mark.usefixtures("idle", "folder")  # the list of files is drawn behind each box


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("size", SIZES)
def test_an_interrupted_job_is_offered_with_all_that_it_means(language: str, size: tuple[int, int]) -> None:
    words.use(language)
    program = Program(FakeConsole(unfinished_jobs=[CUT]), size)
    program.press("f", "u")
    text = " ".join(" ".join(row.split("│")[row.count("│") // 2] for row in program.text().splitlines()).split())
    for told in ("Hole {numbers} was cut off", "The last line of its journal", "Holes of the present tool"):
        source = next(message for message in screen_templates() if message.startswith(told))
        assert words._(source).format(numbers="4") in text
    assert counted("{done} of {count} holes are drilled", 26, done=3) in text
    program.press("enter")
    assert not program.console.asked


def test_a_hole_that_may_have_been_begun_is_named() -> None:
    program = Program(FakeConsole(unfinished_jobs=[replace(CUT, again=(), doubtful=4)]))
    program.press("f", "u")
    assert "Hole 4 may have been begun; it will be drilled again." in program.text()


def test_a_hole_after_which_a_bit_was_found_broken_is_named() -> None:
    program = Program(FakeConsole(unfinished_jobs=[replace(CUT, suspect=(3,))]))
    program.press("f", "u")
    assert "Look at hole 3: a bit was found broken after it." in program.text()


def test_an_interrupted_job_goes_on_or_is_given_up() -> None:
    program = Program(FakeConsole(unfinished_jobs=[CUT]))
    program.press("f", "u", "right", "enter")
    assert program.console.asked == [("take_up", CUT.journal, False), ("go_on",)]
    assert " Drilling " in program.text().splitlines()[1]
    program.press("f", "u", "right", "right", "enter")
    assert program.console.asked[-1] == ("give_up", CUT.journal)
    program.press("u")
    assert "No job was cut off." in program.text()


BOARD_SITE = Site("firmata:/dev/ttyACM0", "real", "none")


@pytest.mark.parametrize(
    ("ran", "here", "told"),
    [
        (BOARD_SITE, HERE, "machine drills counts as drilled. Go on all the same?"),
        (replace(HERE, pace="free"), HERE, "ran with port simulated, pace free, plant ideal. It would go on with port"),
        (HERE, BOARD_SITE, "go on with port firmata:/dev/ttyACM0, pace real. Go on all the same?"),
        (replace(HERE, plant="dynamic blunt=20", seed=3), HERE, "pace real, plant dynamic blunt=20, seed 3."),
    ],
)
def test_a_job_that_ran_elsewhere_is_asked_about(ran: Site, here: Site, told: str) -> None:
    """What is in use is none of the journal's sites: No, and Enter alone, leave everything as it is."""
    program = Program(FakeConsole(unfinished_jobs=[replace(CUT, ran=ran, here=here)]))
    program.press("f", "u", "right", "enter")
    assert told in " ".join(program.text().replace("│", " ").split()) and not program.console.asked
    program.press("enter")
    assert not program.console.asked
    program.press("u", "right", "enter", "right", "enter")
    assert program.console.asked == [("take_up", CUT.journal, True), ("go_on",)]


def test_several_interrupted_jobs_are_listed_and_a_refusal_is_told() -> None:
    other = replace(CUT, journal="/j2", file="/home/two.drl", again=(), torn=False)
    console = FakeConsole(unfinished_jobs=[CUT, other])
    program = Program(console)
    program.press("f", "u")
    assert "1 four.drl  3 of 26 holes are drilled" in program.text()
    console.answer = ("two.drl has changed since the job was begun",)
    program.press("2", "right", "enter")
    assert console.asked == [("take_up", "/j2", False)] and "has changed since" in program.text()


def test_start_offers_what_was_cut_off_of_the_same_board_and_begins_anew_on_request() -> None:
    program = Program(FakeConsole(loaded=BOARD, unfinished_jobs=[CUT]))
    program.press("s", "right", "right", "enter")
    assert program.console.asked == [("give_up", CUT.journal), ("start", False)]
    program.press("s")
    assert "Drill 4 holes of four.drl?" in program.text()


def test_jobs_cut_off_are_offered_when_the_program_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    program = Program(FakeConsole(unfinished_jobs=[CUT]))
    alarms = []
    monkeypatch.setattr(program.app.loop, "run", lambda: None)
    monkeypatch.setattr(program.app.loop, "set_alarm_in", lambda after_s, call: alarms.append(call))
    program.app.run()
    alarms[-1](program.app.loop, None)
    assert "Interrupted job" in program.text()
