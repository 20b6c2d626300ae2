"""Whole runs with a converter on a serial line: the speed reaches it, its words replay, and it is stopped on every way
out.
"""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from drillctl.machine import Library, shipped_tables
from drillctl.machine.converter import parse_converter
from drillctl.machine.source import Source
from drillctl.ports import PortRefused
from drillctl.replay.compare import replay
from drillctl.ticker.converter.card import ConverterChoice
from drillctl.ticker.launch import RunSettings, start
from tests.support.converter import ModbusConverter, Wire

pytestmark = [
    pytest.mark.paced,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="processes of their own need Linux"),
]
LIBRARY = Library((shipped_tables(),))
WITHIN_S = 40.0
CALL = (sys.executable, "-m", "drillctl", "run", "q.kmd", "--converter")
RUN, STOP = (0x2000, 0x12), (0x2000, 0x01)
QUEUE = "KMD_WRZECIONO 24000\nKMD_RUCHd x=60\nKMD_WRZECIONO 0\n"
LONG = "KMD_WRZECIONO 24000\nKMD_CZEKAJ 100000\n"


@dataclass
class Rig:
    folder: Path
    wire: Wire
    converter: ModbusConverter

    def start(self, queue: str, *more: str) -> "subprocess.Popen[str]":
        (self.folder / "q.kmd").write_text(queue)
        call = [*CALL, f"delta-gs20:{self.wire.ours}", "--machine", "eight-axis", "--tick-hz", "250", "--json"]
        call += ["--pace", "real", *more]
        return subprocess.Popen(call, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def until(self, holds: Callable[[], bool]) -> None:
        ends_s = time.monotonic() + WITHIN_S
        while not holds():
            assert time.monotonic() < ends_s, "it never came so far"
            time.sleep(0.02)


@contextmanager
def rigged(folder: Path) -> Iterator[Rig]:
    with Wire() as wire, ModbusConverter(wire.theirs, 19200) as converter:
        yield Rig(folder, wire, converter)


def test_the_speed_reaches_the_converter_and_a_replay_needs_none(tmp_path: Path) -> None:
    with rigged(tmp_path) as rig:
        begun = rig.start(QUEUE, "--trace", "t.trace")
        out, err = begun.communicate(timeout=WITHIN_S)
        assert begun.returncode == 0, err
        assert rig.converter.writes[0] == STOP and rig.converter.writes[-1] == STOP and not rig.converter.hz
        assert [write for write in rig.converter.writes if write != STOP] == [(0x2001, 40000), RUN]
    assert json.loads(out)["fault"] is None
    assert "in.1 0x40005dc0" in (tmp_path / "t.trace").read_text(), "24000 rev/min, as the converter says, foot up"
    assert not replay(tmp_path / "t.trace", LIBRARY).failed(same_tables_wanted=True)


def test_a_line_that_is_cut_holds_the_job_and_the_motor_is_stopped_once_it_is_back(tmp_path: Path) -> None:
    with rigged(tmp_path) as rig:
        begun = rig.start(LONG)
        rig.until(lambda: rig.converter.hz == 400.0)
        rig.wire.cut = True
        rig.until(lambda: rig.wire.lost > 9)  # each was waited for
        begun.send_signal(signal.SIGTERM)
        assert rig.converter.hz == 400.0
        rig.wire.cut = False
        _, err = begun.communicate(timeout=WITHIN_S)
        assert rig.converter.writes[-1] == STOP and "no good answer" in err and "a job is held" in err


@pytest.mark.parametrize("killed", ["desk", pytest.param("ticker", marks=pytest.mark.long)])
def test_the_motor_is_stopped_when_a_process_is_killed(killed: str, tmp_path: Path) -> None:
    with rigged(tmp_path) as rig:
        begun = rig.start(LONG)
        rig.until(lambda: rig.converter.hz == 400.0)
        _, ticker, _ = map(int, Path(f"/proc/{begun.pid}/task/{begun.pid}/children").read_text().split())
        os.kill({"desk": begun.pid, "ticker": ticker}[killed], signal.SIGKILL)
        rig.until(lambda: rig.converter.writes[-1] == STOP)
        begun.communicate(timeout=WITHIN_S)


def test_no_answer_no_real_time_and_a_machine_without_a_converter_are_refused(tmp_path: Path) -> None:
    with Wire() as wire:
        rows = (
            ("eight-axis", "real", "no delta-gs20 answers"),
            ("eight-axis", "free", "a converter needs real time"),
            ("pcb-drill", "real", "has no converter"),
        )
        table = LIBRARY.find("converter", "delta-gs20")
        assert table is not None
        choice = ConverterChoice(parse_converter(Source.read(table)), wire.ours)
        for name, pace, reason in rows:
            machine = LIBRARY.machine(name).at_rate(250)
            with pytest.raises(PortRefused, match=reason):
                start(machine, RunSettings(pace=pace, converter=choice), tmp_path / "status")
