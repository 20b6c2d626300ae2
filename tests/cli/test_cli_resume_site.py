"""Where a job goes on: on the port, at the pace and before the plant that it ran; elsewhere only where that was said.

A journal's site is forged here as a run on that port would have written it; what would be started is looked at.
"""

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from msgspec.structs import asdict

from drillctl.cli import main
from drillctl.jobs import session
from drillctl.jobs.journal import read_journal
from drillctl.jobs.site import site_of
from drillctl.language import Message
from drillctl.machine import shipped_tables
from drillctl.ports import PortRefused
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.jobs import Site
from tests.support.journalled import BOARD, SITE, forged, keep_lines, lines_of, resume, run

BOARD_AT_USB = Site("firmata:/dev/ttyACM0", "real", "none")
WORN = Site("simulated", "free", "dynamic blunt=20", 3)
CARD = Site("mapped:/card", "real", "ideal")
Started = Callable[..., tuple[int, list[Site]]]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "job.drl").write_text(BOARD)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def started(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Started:
    """``started(site, *options)``: a job that ran there, cut off, is resumed; its exit code, and where it would run."""
    assert run() == 0
    keep_lines(folder, 4)
    head, *lines = lines_of(folder / "j")
    begun: list[Site] = []

    def start(machine: object, running: RunSettings, status_file: Path) -> None:
        begun.append(site_of(running))
        raise PortRefused(running.port, Message("not here"))

    def resumed(site: Site, *options: str) -> tuple[int, list[Site]]:
        (folder / "j").write_bytes(forged([{**head, "site": asdict(site)}, *lines]))
        before = (folder / "j").read_bytes()
        begun.clear()
        code = main(["resume", "j", "--tools", "assume", *options])
        assert (folder / "j").read_bytes() == before, "nothing ran, and the journal changed"
        return code, begun

    monkeypatch.setattr(session, "start", start)
    return resumed


@pytest.mark.parametrize("site", [SITE, BOARD_AT_USB, WORN, CARD])
def test_it_goes_on_where_it_ran(site: Site, started: Started, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    assert started(site) == (2, [site])
    first = capsys.readouterr().err.splitlines()[0]
    assert first == f"drillctl: j: 1 of 4 holes are drilled; it goes on as it ran: {site}"


@pytest.mark.parametrize(
    ("site", "options", "elsewhere"),
    [
        (BOARD_AT_USB, ["--port", "simulated"], SITE),
        (BOARD_AT_USB, ["--port", "mapped:card"], Site("mapped:CARD", "free", "ideal")),
        (BOARD_AT_USB, ["--port", "firmata:/dev/ttyACM1"], Site("firmata:/dev/ttyACM1", "real", "none")),
        (BOARD_AT_USB, ["--port", "firmata"], Site("firmata", "real", "none")),
        (BOARD_AT_USB, ["--port", "firmata-uno:/dev/ttyACM0"], Site("firmata-uno:/dev/ttyACM0", "real", "none")),
        (SITE, ["--port", "firmata:/dev/ttyACM0"], BOARD_AT_USB),
        (WORN, ["--port", "firmata:/dev/ttyACM0"], BOARD_AT_USB),
        (CARD, ["--port", "mapped:card"], Site("mapped:CARD", "free", "ideal")),
        (CARD, ["--pace", "free"], Site("mapped:/card", "free", "ideal")),
        (SITE, ["--pace", "real"], Site("simulated", "real", "ideal")),
        (SITE, ["--plant", "dynamic"], Site("simulated", "free", "dynamic")),
        (WORN, ["--plant", "ideal"], SITE),
        (WORN, ["--plant", "dynamic", "--seed", "3"], Site("simulated", "free", "dynamic", 3)),
        (WORN, ["--plant", "dynamic", "--fault", "blunt=20"], Site("simulated", "free", "dynamic blunt=20")),
    ],
)
def test_elsewhere_is_refused_unless_it_was_said(
    site: Site, options: list[str], elsewhere: Site, started: Started, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    there = str(elsewhere).replace("CARD", str(folder / "card"))
    capsys.readouterr()
    assert started(site, *options) == (2, [])
    told = capsys.readouterr()
    assert told.out == "" and told.err.count("\n") == 1
    assert told.err.startswith(f"drillctl: j: the job ran with {site}") and there in told.err
    assert told.err.endswith("to go on there, or say --elsewhere as well\n")
    assert ("is simulated, and would count as drilled" in told.err) == (site.real and not elsewhere.real)
    code, begun = started(site, *options, "--elsewhere")
    assert (code, list(map(str, begun))) == (2, [there])
    assert capsys.readouterr().err.startswith(
        f"drillctl: j: 1 of 4 holes are drilled; it goes on elsewhere: {there}; it ran on {site}\n"
    )


@pytest.mark.parametrize(
    ("site", "options"),
    [
        (SITE, ["--port", "simulated", "--pace", "free", "--plant", "ideal"]),
        (BOARD_AT_USB, ["--port", "firmata:/dev/ttyACM0"]), (BOARD_AT_USB, ["--pace", "real"]),
        (BOARD_AT_USB, ["--plant", "ideal"]), (CARD, ["--port", "mapped:/card", "--pace", "real"]),
        (CARD, ["--port", "mapped:/x/../card"]), (CARD, ["--elsewhere"]),
        (WORN, ["--fault", "blunt=20", "--seed", "3", "--plant", "dynamic"]), (SITE, ["--seed", "5"]),
    ],
)  # fmt: skip
def test_to_say_where_it_ran_is_to_say_nothing_new(site: Site, options: list[str], started: Started) -> None:
    assert started(site, *options) == (2, [site])


@pytest.mark.parametrize(
    ("site", "reason"),
    [
        (Site("lpt1", "real", "none"), "there is no such port"),
        (Site("firmata:/dev/ttyACM0", "free", "none"), "a real machine can't run free"),
        (Site("simulated", "free", "steam"), "plant 'steam' can't be built"),
    ],
)
def test_a_site_that_can_not_be_is_refused(
    site: Site, reason: str, started: Started, capsys: pytest.CaptureFixture[str]
) -> None:
    assert started(site) == (2, [])
    assert reason in capsys.readouterr().err


def test_a_file_of_a_port_is_the_same_one_from_any_folder(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And what a run says first is where it runs, and where its journal is."""
    assert run("--port", "mapped:card") == 0
    site = Site(f"mapped:{folder / 'card'}", "free", "ideal")
    assert capsys.readouterr().err.splitlines()[0] == f"drillctl: {site}; journal j"
    keep_lines(folder, 4)
    (folder / "card").unlink()
    (folder / "below").mkdir()
    monkeypatch.chdir(folder / "below")
    assert main(["resume", "../j", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["holes_done"] == 4
    assert (folder / "card").exists() and os.listdir() == []


def test_each_run_on_another_site_stands_in_the_journal(folder: Path) -> None:
    """What is said once holds for the next: a job that was taken elsewhere goes on there."""
    assert run() == 0
    keep_lines(folder, 3)
    assert resume("--plant", "dynamic", "--elsewhere") == 0
    keep_lines(folder, 5)
    account = read_journal(folder / "j")
    assert account.site == Site("simulated", "free", "dynamic") and account.open == [2]
    assert resume() == 0
    resumed = [line for line in lines_of(folder / "j") if "resumed" in line]
    assert resumed == [
        {"resumed": {**asdict(SITE), "plant": "dynamic"}, "again": None},
        {"resumed": {**asdict(SITE), "plant": "dynamic"}, "again": 2},
    ]


def test_a_machine_whose_file_was_real_does_not_go_on_simulated(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Begun without --port on the port of the file's card; the mode is a part of the machine."""
    table = folder / "t" / "machines" / "pcb-drill.toml"
    table.parent.mkdir(parents=True)
    text = (shipped_tables() / "machines" / "pcb-drill.toml").read_text("utf-8")
    assert 'mode = "SIMULATED"' in text
    table.write_text(text, "utf-8")
    assert run("--tables", "t") == 0
    keep_lines(folder, 4)
    table.write_text(text.replace('mode = "SIMULATED"', 'mode = "REAL"'), "utf-8")
    capsys.readouterr()
    for options in ((), ("--port", "simulated"), ("--elsewhere",)):
        assert resume(*options) == 2
        assert "machine pcb-drill is not the one that the job was begun on" in capsys.readouterr().err


def test_without_a_name_a_newer_journal_that_can_not_be_read_is_not_passed_over(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It may be the one that is meant; the older one would be another board."""
    kept = session.journals()
    kept.mkdir(parents=True)
    assert run() == 0
    keep_lines(folder, 3)
    (folder / "j").rename(kept / "older.journal")
    newer = kept / "newer.journal"
    newer.write_bytes((kept / "older.journal").read_bytes().replace(b'"begun": 1', b'"begun": 2'))
    later_s = (kept / "older.journal").stat().st_mtime + 60
    os.utime(newer, (later_s, later_s))
    assert main(["resume", "--json"]) == 2
    assert f"{newer}:2: damaged" in (told := capsys.readouterr().err)
    assert told.endswith("; to go on with another journal, name it\n")
    newer.unlink()
    assert main(["resume", "--json"]) == 0
