"""Standard streams that are closed, full or read by nobody, and results that can't be kept: the machine runs on."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.jobs.journal import read_journal
from tests.cli.conftest import COMMAND
from tests.support.terminal import Terminal

pytestmark = pytest.mark.paced

needs_full = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
needs_linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux")
PACED = ("--pace", "real", "--tick-hz", "4000", "--journal", "j")


@pytest.mark.parametrize("closed", ["<&-", ">&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(
    ("verb", "code"),
    [("run kicad.drl --holes h.csv", 0), ("run hole.kmd --pace real --tick-hz 4000", 0), ("inspect kicad.drl", 0),
     ("run kicad.drl --tools ask", 2), ("scope hole.kmd", 2)],
)  # fmt: skip
def test_streams_that_the_caller_has_closed(verb: str, code: int, closed: str, folder: Path) -> None:
    """As some service managers do; the next file that is opened must not become standard output."""
    if "real" in verb and not sys.platform.startswith("linux"):
        pytest.skip("real pace needs Linux")
    call = f"{' '.join(COMMAND)} {verb} {closed}"
    done = subprocess.run(call, shell=True, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == code and "Traceback" not in done.stderr
    if "--holes" in verb:
        assert (folder / "h.csv").read_text().count("\n") == 4


@needs_linux
def test_a_job_goes_on_when_nobody_reads_what_it_tells(folder: Path) -> None:
    """As ``run ... 2>&1 | true`` does."""
    reading, writing = os.pipe()
    os.close(reading)
    call = [*COMMAND, "run", "kicad.drl", *PACED, "--json"]
    done = subprocess.run(call, cwd=folder, stdout=subprocess.PIPE, stderr=writing, timeout=60, check=False)
    os.close(writing)
    assert done.returncode == 0 and json.loads(done.stdout)["holes_done"] == 3
    assert read_journal(folder / "j").ended == "done"


@needs_linux
def test_a_closed_terminal_stops_the_job_in_order(folder: Path) -> None:
    terminal = Terminal("run", "kicad.drl", "--pace", "real", "--journal", "j", folder=folder)
    terminal.wait_for("machine time")
    os.close(terminal._line)
    _, status = os.waitpid(terminal.pid, 0)
    assert os.waitstatus_to_exitcode(status) == 129
    assert read_journal(folder / "j").ended == "stopped"


@needs_linux
def test_a_closed_terminal_ends_the_screen(folder: Path) -> None:
    terminal = Terminal(folder=folder)
    terminal.wait_for("Files", "pcb-drill")
    os.close(terminal._line)
    _, status = os.waitpid(terminal.pid, 0)
    assert os.waitstatus_to_exitcode(status) == 129


@needs_full
@pytest.mark.parametrize("verb", [["machines"], ["run", "hole.kmd", "--holes", "h.csv"], ["ports", "--json"]])
def test_standard_output_that_takes_nothing(verb: list[str], folder: Path) -> None:
    """The verb did its work, so it is no refusal; nobody was told, so it is no success."""
    with open("/dev/full", "wb") as full:
        done = subprocess.run(
            [*COMMAND, *verb], cwd=folder, stdout=full, stderr=subprocess.PIPE, timeout=60, check=False
        )
    assert (done.returncode, done.stderr) == (1, b"drillctl: standard output: No space left on device\n")
    assert (folder / "h.csv").exists() == ("--holes" in verb)


@needs_full
@pytest.mark.parametrize("option", ["--trace", "--vcd", "--holes"])
def test_a_result_that_can_not_be_kept(option: str, drillctl: Callable[..., subprocess.CompletedProcess[str]],
                                       folder: Path) -> None:  # fmt: skip
    """Found only when the machine has moved: how it ended is told, the other results are kept, and it is no success."""
    others = [word for name in ("--trace", "--vcd", "--holes") if name != option for word in (name, f"kept{name}")]
    done = drillctl("run", "hole.kmd", option, "/dev/full", "--json", *others)
    assert done.returncode == 1 and json.loads(done.stdout)["position_known"]
    assert done.stderr == "drillctl: /dev/full: can't be written: No space left on device\n"
    assert len(list(folder.glob("kept*"))) == 2 and not list(folder.glob(".*"))


@pytest.mark.parametrize(
    ("options", "named"),
    [(["--journal", "j", "--trace", "j"], "j"), (["--journal", "j", "--holes", "j.status"], "j.status"),
     (["--port", "mapped:m", "--vcd", "m"], "m")],
)  # fmt: skip
def test_no_result_takes_the_place_of_what_the_run_keeps(
    options: list[str], named: str, drillctl: Callable[..., subprocess.CompletedProcess[str]], folder: Path
) -> None:
    done = drillctl("run", "kicad.drl", *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"drillctl: {named}: would overwrite a file that this run reads or writes\n"
    assert not (folder / named).exists()
