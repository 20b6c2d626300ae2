"""The plugin as another repository meets it: a pytest of its own, in a folder of its own, in a process of its own."""

import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from drillctl.cli import main
from drillctl.language import visible

COLLECTED_NOTHING = 5


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    (tmp_path / "job.kmd").write_text("KMD_GOTOdXdY 30 -12\n")
    assert main(["run", str(tmp_path / "job.kmd"), "--trace", str(tmp_path / "good.trace")]) == 0
    return tmp_path


def run_pytest(folder: Path, *options: str, found: bool = False) -> subprocess.CompletedProcess[str]:
    """``found``: pytest finds the plugin by itself, with every other plugin that is installed, which takes a second."""
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *options]
    surroundings = dict(os.environ)
    if not found:
        command += ["-p", "drillctl"]
        surroundings["PYTEST_DISABLE_PLUGIN_AUTOLOAD"] = "1"
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=100, check=False, env=surroundings
    )


def spoil(repository: Path) -> Path:
    """A copy of the trace in which the output word of tick 6 has another bit."""
    text = (repository / "good.trace").read_text()
    found = re.search(r"^6 out\.0 0x(.{8})$", text, re.M)
    assert found
    trace = repository / "bad.trace"
    trace.write_text(text.replace(found[0], f"6 out.0 0x{int(found[1], 16) ^ 0x4:08x}"))
    return trace


def test_traces_are_tests_and_other_files_are_not(repository: Path) -> None:
    (repository / "other.trace").write_text("strace of something\n")
    done = run_pytest(repository, "-v", found=True)
    assert done.returncode == 0, done.stdout
    assert "good.trace::replay PASSED" in done.stdout and "other.trace" not in done.stdout


def test_a_difference_fails_with_a_plain_message_also_in_junit(repository: Path) -> None:
    spoil(repository)
    done = run_pytest(repository, "--junitxml=out.xml")
    assert done.returncode == 1
    failure = ElementTree.parse(repository / "out.xml").find(".//failure")
    assert failure is not None and failure.text is not None
    first = failure.text.splitlines()[0]
    assert first == "bad.trace: differs at tick 6, in command 1 KMD_GOTOdXdY 30 -12"
    assert re.search(r"^  bits      x\.2a should be off$", failure.text, re.M), failure.text
    assert "Traceback" not in done.stdout and failure.text.isascii()


def test_rewrite_records_anew_and_passes(repository: Path) -> None:
    spoil(repository)
    assert run_pytest(repository, "--drillctl-rewrite").returncode == 0
    assert (repository / "bad.trace").read_bytes() == (repository / "good.trace").read_bytes()
    assert run_pytest(repository).returncode == 0


def test_a_broken_trace_fails_with_its_line(repository: Path) -> None:
    text = (repository / "good.trace").read_text()
    (repository / "good.trace").write_text(text[: text.index("\nend ")] + "\n")
    done = run_pytest(repository)
    assert done.returncode == 1 and "good.trace:" in done.stdout and "Traceback" not in done.stdout


def test_what_a_trace_holds_reaches_no_terminal(repository: Path) -> None:
    (repository / "n\x1b[31m\u202e.trace").write_text("drillctl-trace 1\nmachine \u202e\u200b\x1b[2J\n\nend 1\n")
    for quiet in ("-q", "-v"):
        done = run_pytest(repository, "--no-header", "--color=no", quiet)
        assert done.returncode == 1 and "out of place" in done.stdout and "n\\x1b[31m" in done.stdout
        assert [line for line in done.stdout.splitlines() if visible(line) != line] == []


def test_required_traces_must_be_there(repository: Path) -> None:
    (repository / "test_other.py").write_text("def test_other():\n    assert True\n")
    assert run_pytest(repository, "--drillctl-require-traces").returncode == 0
    (repository / "good.trace").unlink()
    assert run_pytest(repository).returncode == 0
    assert run_pytest(repository, "--drillctl-require-traces").returncode == COLLECTED_NOTHING


def test_required_traces_are_seen_through_workers_and_their_lack_is_said(repository: Path) -> None:
    pytest.importorskip("xdist")
    (repository / "test_other.py").write_text("def test_other():\n    assert True\n")
    assert run_pytest(repository, "-n", "2", "--drillctl-require-traces", found=True).returncode == 0
    (repository / "good.trace").unlink()
    done = run_pytest(repository, "-n", "2", "--drillctl-require-traces", found=True)
    assert done.returncode == COLLECTED_NOTHING and "no trace was collected" in done.stdout


def test_a_folder_of_tables_that_is_not_there_is_refused(repository: Path) -> None:
    done = run_pytest(repository, "--drillctl-tables", "nowhere")
    assert done.returncode == pytest.ExitCode.USAGE_ERROR and "nowhere: no such folder" in done.stderr


def test_a_pytest_run_without_traces_imports_no_room_of_ours(tmp_path: Path) -> None:
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    (tmp_path / "other.trace").write_text("strace of something\n")
    heavy = "[name for name in sys.modules if name.split('.')[0] in ('numpy', 'msgspec', 'urwid')]"
    rooms = "[name for name in sys.modules if name in ('drillctl.machine', 'drillctl.trace', 'drillctl.ticker')]"
    (tmp_path / "test_other.py").write_text(f"import sys\n\ndef test_other():\n    print({heavy}, {rooms})\n")
    done = run_pytest(tmp_path, "-s", found=True)
    assert done.returncode == 0 and "[] []" in done.stdout, done.stdout


def test_a_pytest_run_without_a_traces_name_imports_the_plugin_alone(tmp_path: Path) -> None:
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    ours = "sorted(name for name in sys.modules if name.startswith('drillctl.'))"
    (tmp_path / "test_other.py").write_text(f"import sys\n\ndef test_other():\n    print({ours})\n")
    done = run_pytest(tmp_path, "-s", found=True)
    assert "['drillctl.api', 'drillctl.api.pytest_plugin']" in done.stdout, done.stdout


def test_tables_of_ones_own_and_same_tables(repository: Path) -> None:
    shipped = Path(__file__).resolve().parents[2] / "tables" / "machines" / "pcb-drill.toml"
    (repository / "mine" / "machines").mkdir(parents=True)
    text = shipped.read_text("utf-8").replace("longest_drilling_s = 18", "longest_drilling_s = 17")
    (repository / "mine" / "machines" / "pcb-drill.toml").write_text(text, "utf-8")
    assert run_pytest(repository, "--drillctl-tables", "mine").returncode == 0
    assert run_pytest(repository, "--drillctl-tables", "mine", "--drillctl-same-tables").returncode == 1


def test_a_test_with_the_fixture_fails_with_the_first_tick_that_differs(repository: Path) -> None:
    same = "def test_it(drill):\n    assert drill.run('KMD_GOTOdXdY 3 0') == drill.run('KMD_GOTOdXdY 0 3')\n"
    (repository / "test_machine.py").write_text(same)
    done = run_pytest(repository, "test_machine.py")
    assert done.returncode == 1
    assert "the runs differ" in done.stdout and "tick 6" in done.stdout


def test_a_page_is_left_of_each_trace_that_failed(repository: Path) -> None:
    spoil(repository)
    done = run_pytest(repository, "--drillctl-report=out/pages")
    assert done.returncode == 1
    pages = sorted(page.name for page in (repository / "out" / "pages").iterdir())
    assert pages == ["bad.trace.html"]
    text = (repository / "out" / "pages" / pages[0]).read_text("utf-8")
    assert "The two runs part at tick 6" in text and "by these tables" in text


def test_where_no_page_can_be_left_the_difference_is_told_all_the_same(repository: Path) -> None:
    spoil(repository)
    (repository / "pages").write_text("a file is there")
    done = run_pytest(repository, "--drillctl-report=pages")
    assert done.returncode == 1
    assert "bad.trace: differs at tick 6" in done.stdout and "no page   " in done.stdout
    assert "File exists" in done.stdout and "Traceback" not in done.stdout
