"""A ``tables/`` folder in the current directory, or the user's own, may stand in for a shipped table: that is said."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.console.machine_console import MachineConsole
from drillctl.language import words
from drillctl.machine import Library, shipped_tables
from drillctl.ticker.launch import RunSettings
from tests.ui.fake_console import Paper

QUEUE = "KMD_CZEKAJ 3\nKMD_KONIEC\n"
SAID = "drillctl: local tables are in use, not the shipped ones: "
MACHINE, RAMP = "machines/pcb-drill.toml", "ramp/seven-state.toml"
PHASE, MOTOR = "phase/two-phase-forced.toml", "motor/two-phase.toml"
Told = Callable[..., list[str]]


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to work in, with a queue and a trace of the shipped machine; the user's own folder in it."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.chdir(tmp_path)
    Path("q.kmd").write_text(QUEUE)
    assert main(["run", "q.kmd", "--trace", "q.trace"]) == 0
    return tmp_path


@pytest.fixture
def said(capsys: pytest.CaptureFixture[str]) -> Told:
    """The lines on standard error of a call that is not refused."""

    def run(*arguments: str) -> list[str]:
        capsys.readouterr()
        assert main(arguments) == 0
        return capsys.readouterr().err.splitlines()

    return run


def put(folder: Path, name: str, remark: str = "# another\n") -> Path:
    """A copy of a shipped table with a remark at its end, which makes it another file and the same table."""
    copy = folder / name
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_text((shipped_tables() / name).read_text() + remark)
    return copy


@pytest.mark.parametrize("name", [MACHINE, RAMP, PHASE, MOTOR])
def test_it_is_the_first_line_of_a_run(name: str, place: Path, said: Told) -> None:
    assert said("run", "q.kmd") == []
    put(place / "tables", name)
    assert said("run", "q.kmd")[0] == f"{SAID}tables/{name}"
    assert said("run", "q.kmd", "--json", "--tick-hz", "400")[0] == f"{SAID}tables/{name}"


def test_all_of_them_in_one_line_and_the_users_own_too(place: Path, said: Told) -> None:
    put(place / "tables", MACHINE)
    own = put(place / "config" / "drillctl" / "tables", RAMP)
    assert said("run", "q.kmd") == [f"{SAID}tables/{MACHINE}, {own}"]


@pytest.mark.parametrize(
    "verb",
    [
        ["estimate", "q.kmd"], ["convert", "q.trace", "--to", "q.seg"], ["replay", "q.trace"],
        ["machines"], ["latency", "--seconds", "1"],
        ["sweep", "--steps", "1", "--out", "o.csv", "--workers", "1"],
    ],
    ids=lambda verb: verb[0],
)  # fmt: skip
def test_every_verb_with_a_machine_says_it(verb: list[str], place: Path, said: Told) -> None:
    put(place / "tables", RAMP)
    assert said(*verb)[0] == f"{SAID}tables/{RAMP}"


def test_a_table_that_only_a_sweep_names(place: Path, said: Told) -> None:
    put(place / "tables", "ramp/even-interval.toml")
    lines = said("sweep", "--ramp", "even-interval", "--steps", "1", "--out", "o.csv", "--workers", "1")
    assert lines[0] == f"{SAID}tables/ramp/even-interval.toml"


def test_what_was_asked_for_and_what_is_the_same_is_not_said(place: Path, said: Told) -> None:
    put(place / "tables", MACHINE, remark="")
    assert said("run", "q.kmd") == []
    put(place / "tables", MACHINE)
    assert said("run", "q.kmd", "--tables", "tables") == []
    assert said("run", "q.kmd", "--machine", "tables/machines/pcb-drill.toml") == []
    assert said("run", "q.kmd", "--machine", "boiler-drum") == []


@pytest.mark.parametrize("language", ["en", "pl"])
def test_the_second_line_of_the_screen(language: str, place: Path) -> None:
    from drillctl.ui.app import App

    words.use(language)
    try:
        for local in (False, True):
            if local:
                put(place / "tables", RAMP)
            library = Library.standard()
            station = MachineConsole(library, library.machine("pcb-drill"), RunSettings("simulated", "free"))
            try:
                paper = Paper()
                program = App(station, terminal=paper)
                rows = [row.decode() for row in program.loop.widget.render((80, 24), focus=True).text]
                assert (f"pcb-drill {words._('(local)')} | simulated" in rows[1]) is local
                assert words._("position not known")[:10] in rows[1]
                assert any(f"tables/{RAMP}" in notice for notice in station.view().notices) is local
            finally:
                station.close()
    finally:
        words.use("en")


def test_a_choice_on_the_screen_writes_nothing_beside_it(place: Path, capfd: pytest.CaptureFixture[str]) -> None:
    put(place / "tables", MACHINE)
    library = Library.standard()
    station = MachineConsole(library, library.machine("boiler-drum"), RunSettings("simulated", "free"))
    try:
        assert not station.choose_machine("pcb-drill")
        assert station.view().local
    finally:
        station.close()
    assert capfd.readouterr() == ("", "")
    assert sys.stderr is not None
