"""The keys of a paced run on a terminal: held and gone on with, stopped, dropped; and where there are none."""

import sys
import termios
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from drillctl.jobs.journal import read_journal
from drillctl.jobs.keys import HELP
from drillctl.kmd.channel import Channel
from drillctl.portio.mapped import read_map
from tests.support.terminal import Terminal

pytestmark = [
    pytest.mark.paced,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux"),
]

BOARD = "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nG90\nT1\nX1.0Y1.0\nT2\nX2.0Y1.5\nM30\n"
RUN = ("run", "board.drl", "--tick-hz", "4000", "--journal", "j", "--pace", "real", "--port", "mapped:card")
HOMED_TICKS = 2200  # then the head is on its way down
PATIENCE_S = 15.0
Begin = Callable[..., Terminal]


@pytest.fixture
def begin(tmp_path: Path) -> Iterator[Begin]:
    """A run on a terminal of its own; ended where it has not ended."""
    begun: list[Terminal] = []

    def start(*options: str) -> Terminal:
        (tmp_path / "board.drl").write_text(BOARD)
        begun.append(Terminal(*RUN, *options, folder=tmp_path, size=(120, 24)))
        return begun[-1]

    yield start
    for terminal in begun:
        terminal.close()


def moving(folder: Path, terminal: Terminal) -> Channel:
    """The channel of the run, once its head goes down."""
    found: list[Channel] = []

    def is_moving() -> bool:
        file = folder / "j.status"
        if not found and file.exists() and file.stat().st_size:
            found.append(Channel(file, create=False))
        return bool(found) and found[0].status()["tick"] >= HOMED_TICKS

    terminal.until(is_moving, "it never moved")
    return found[0]


def line_mode(terminal: Terminal) -> bool:
    """Whether the terminal gives whole lines and shows what is typed, as before the run."""
    flags = termios.tcgetattr(terminal._line)[3]
    return flags & (termios.ICANON | termios.ECHO) == termios.ICANON | termios.ECHO


def test_space_holds_and_goes_on_losing_nothing(begin: Begin, tmp_path: Path) -> None:
    terminal = begin()
    channel = moving(tmp_path, terminal)
    assert HELP in terminal.text
    for _ in range(2):
        terminal.press(" ")
        terminal.wait_for("held (Space goes on)")
        terminal.until(lambda: not channel.status()["moving"], "it never came to rest")
        stood = channel.status()["position"].tolist()
        time.sleep(0.3)
        assert channel.status()["position"].tolist() == stood
        terminal.press(" ")
        terminal.until(lambda: bool(channel.status()["moving"]), "it never went on")
    assert terminal.exit_code() == 0
    assert "2 of 2 holes" in terminal.text and "(known)" in terminal.text and "lost" not in terminal.text
    assert line_mode(terminal)


def test_space_twice_at_once_holds_nothing_up(begin: Begin, tmp_path: Path) -> None:
    """The two requests may be served in one tick, in either order; what was wanted last is what comes of it."""
    terminal = begin()
    moving(tmp_path, terminal)
    terminal.press("  ")
    assert terminal.exit_code() == 0


def test_x_stops_down_the_ramp_and_the_job_can_be_resumed(begin: Begin, tmp_path: Path) -> None:
    terminal = begin()
    moving(tmp_path, terminal)
    terminal.press("x")
    assert terminal.exit_code() == 1
    assert "the operator stopped the job" in terminal.text and "position kept" in terminal.text
    assert read_journal(tmp_path / "j").ended == "stopped"
    assert read_map(tmp_path / "card").outputs == 0 and line_mode(terminal)


def test_x_ends_a_job_that_is_held(begin: Begin, tmp_path: Path) -> None:
    terminal = begin()
    moving(tmp_path, terminal)
    terminal.press(" ")
    terminal.wait_for("held (Space goes on)")
    terminal.press("x")
    assert terminal.exit_code() == 1 and "the operator stopped the job" in terminal.text


def test_an_exclamation_mark_is_an_emergency_stop(begin: Begin, tmp_path: Path) -> None:
    terminal = begin()
    moving(tmp_path, terminal)
    terminal.press("!")
    assert terminal.exit_code() == 1
    assert "FAULT EMERGENCY_STOP" in terminal.text and "position lost" in terminal.text
    assert read_map(tmp_path / "card").outputs == 0 and line_mode(terminal)


def test_the_keys_work_while_a_tool_is_waited_for(begin: Begin) -> None:
    terminal = begin("--tools", "ask")
    terminal.wait_for("tool T1 (0.800 mm): insert it, then press Enter")
    terminal.press("Enter")
    terminal.wait_for("tool T2 (1.000 mm): insert it, then press Enter")
    terminal.press("x")
    assert terminal.exit_code() == 1 and "1 of 2 holes" in terminal.text


def test_with_json_a_program_reads_and_the_terminal_is_left_alone(begin: Begin, tmp_path: Path) -> None:
    terminal = begin("--json")
    moving(tmp_path, terminal)
    assert line_mode(terminal) and HELP not in terminal.text
    terminal.press("x\n")
    assert terminal.exit_code() == 0
