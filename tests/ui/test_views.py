"""Views as text: each is a function of a record, so no terminal is needed."""

import io
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from drillctl.kmd import FAULTS, Fault
from drillctl.language.number_text import clock
from drillctl.ui.terminal import wait
from drillctl.ui.terminal.progress import ProgressView
from drillctl.ui.terminal.reports import summary_lines
from drillctl.ui.widgets.dots import dot_rows
from drillctl.viewmodel.fault_texts import FAULT_WORDS, fault_report
from drillctl.viewmodel.records import Outcome, Progress


def outcome(**changes: Any) -> Outcome:
    told: dict[str, Any] = {
        "machine": "m", "holes_done": 3, "holes_total": 4, "ticks": 1000, "tick_hz": 500,
        "steps": {"x": 7, "y": 8}, "position": {"x": -1, "y": 2}, "position_known": True,
        "lost_steps": {"x": 0, "y": 0}, "underruns": 0, "fault": None,
    }  # fmt: skip
    return Outcome(**{**told, **changes})


def test_summary_of_a_good_run() -> None:
    lines = summary_lines(outcome())
    assert lines[0] == "m: 3 of 4 holes drilled, 1000 ticks at 500 Hz = 0:02 of machine time"
    assert "WARNING" not in "\n".join(lines) and "FAULT" not in "\n".join(lines)


def test_summary_warns_of_lost_steps() -> None:
    assert summary_lines(outcome(lost_steps={"x": 0, "y": 4}))[-1] == "WARNING: lost steps: x 0 y 4"


@pytest.mark.parametrize("fault", [fault for fault in Fault if fault])
def test_every_fault_is_told_with_cause_remedy_and_position(fault: Fault) -> None:
    text = "\n".join(summary_lines(outcome(fault=fault_report(fault, kept=False))))
    assert fault.name in text and FAULT_WORDS[fault].cause in text and FAULT_WORDS[fault].remedy in text
    assert "position lost" in text


def test_words_and_codes_are_the_same_set() -> None:
    assert set(FAULT_WORDS) == set(FAULTS) == {fault for fault in Fault if fault}


@pytest.mark.parametrize(("seconds", "text"), [(0, "0:00"), (59.6, "1:00"), (3599, "59:59"), (3661, "1:01:01")])
def test_clock(seconds: float, text: str) -> None:
    assert clock(seconds) == text


def test_in_a_pipe_no_progress_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    now_s = [1000.0]
    monkeypatch.setattr("drillctl.ui.terminal.progress.time.monotonic", lambda: now_s[0])
    stream = io.StringIO()
    with ProgressView(stream) as view:
        for done in range(50):
            now_s[0] += 60.0
            view.show(Progress(done, 50, 1, done * 100, done * 0.2, 9.8))
    assert stream.getvalue() == ""


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_on_a_terminal_progress_is_a_bar_with_the_time_left() -> None:
    stream = Terminal()
    with ProgressView(stream) as view:
        view.show(Progress(0, 50, 2, 0, 0.0, 125.0))
        view.show(Progress(25, 50, 2, 5000, 10.0, 62.0))
    assert "2:05 left" in stream.getvalue() and "tool 2" in stream.getvalue()


def test_the_time_left_of_a_free_run_is_the_wait_and_machine_time_stands_beside_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now_s = [1000.0]
    monkeypatch.setattr("drillctl.ui.terminal.progress.time.monotonic", lambda: now_s[0])
    stream = Terminal()
    with ProgressView(stream, by_clock=False) as view:
        view.show(Progress(0, 50, 2, 0, 0.0, 4000.0))
        assert "left" not in stream.getvalue(), "nobody knows yet how fast it is"
        now_s[0] += 5.0
        view.show(Progress(10, 50, 2, 500_000, 1000.0, 3000.0))
        now_s[0] += 5.0
        view.show(Progress(40, 50, 2, 2_000_000, 4000.0, None))
    told = stream.getvalue()
    assert "machine time 16:40, 0:15 left" in told and "machine time 1:06:40, 0:02 left" in told


def eventually(told: Callable[[], bool]) -> bool:
    """Whether it comes to be so; a thread draws."""
    until_s = time.monotonic() + 30.0
    while not told() and time.monotonic() < until_s:
        time.sleep(0.01)
    return told()


def test_a_wait_says_what_is_done_and_how_long_it_will_take(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wait, "SHOWN_AFTER_S", 0.0)
    monkeypatch.setattr(wait, "DRAWN_EVERY_S", 0.01)
    stream = Terminal()
    with wait.Wait(stream) as waits:
        advance = waits("reading a\x1b[2J\nb.drl")
        assert eventually(lambda: "reading a\\x1b[2J b.drl, 0:00 so far" in stream.getvalue().replace("\\n", " "))
        advance(1, 4)
        assert eventually(lambda: "b.drl: 25%, " in stream.getvalue() and " left" in stream.getvalue())
        waits("putting the holes in order")(1, 2)
        assert eventually(lambda: "in order: 50%" in stream.getvalue())
    assert stream.getvalue().rstrip(" ").endswith("\r"), "the line is wiped out"


def test_the_time_left_is_by_how_long_it_took_so_far() -> None:
    part = wait.Wait(io.StringIO())("running it again")
    began_s = part._began_s
    assert part.line(began_s + 75.0) == "running it again, 1:15 so far"
    part(25, 100)
    assert part.line(began_s + 10.0) == "running it again: 25%, 0:30 left"
    part(100, 100)
    assert part.line(began_s + 40.0) == "running it again: 100%, 0:00 left"


def test_a_wait_under_a_second_and_one_in_a_pipe_show_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    short = Terminal()
    with wait.Wait(short) as waits:
        waits("reading")(1, 2)
    monkeypatch.setattr(wait, "SHOWN_AFTER_S", 0.0)
    pipe = io.StringIO()
    with wait.Wait(pipe) as waits:
        waits("reading")(1, 2)
        time.sleep(0.05)
    assert (short.getvalue(), pipe.getvalue()) == ("", "")


def test_a_board_is_drawn_to_scale_with_y_upwards() -> None:
    rows = dot_rows(np.array([[0.0, 0.0], [30.0, 0.0], [0.0, 10.0]]), 20, 10)
    assert all(len(row) == 20 for row in rows) and len(rows) <= 4
    assert rows[-1][0] != "\u2800" and rows[-1][-1] != "\u2800", "lowest row: both lower holes"
    assert rows[0][0] != "\u2800" and rows[0][-1] == "\u2800", "highest row: the upper left hole alone"


def test_every_hole_far_enough_apart_has_its_dot() -> None:
    grid = np.array([(x, y) for x in range(10) for y in range(5)], float)
    dots = sum(bin(ord(cell) - 0x2800).count("1") for row in dot_rows(grid, 40, 20) for cell in row)
    assert dots == 50


@pytest.mark.parametrize("points", [np.empty((0, 2)), np.array([[5.0, 5.0]]), np.array([[1.0, 2.0], [1.0, 9.0]])])
def test_boards_without_extent_are_no_trouble(points: np.ndarray) -> None:
    rows = dot_rows(points, 20, 5)
    assert len(rows) <= 5 and (len(rows) > 0) == (len(points) > 0)
