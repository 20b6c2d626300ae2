"""A pytest plugin: ``*.trace`` and ``*.seg`` files are tests, in anybody's repository that has drillctl installed; and
tests of one's own can run a machine by the fixture ``drill``.

A trace is replayed with the tables at hand; the test fails at the first tick that differs. Only files that begin
with the magic line are collected. ``--drillctl-rewrite`` records goldens anew on the simulated machine.

Rule: every pytest run on the computer loads this module, so nothing of drillctl is imported before a file has a
trace's name, and numpy only once one begins as a trace does, or a test asks for the fixture.
"""

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from drillctl.api.fixture import Drill
    from drillctl.replay.compare import Verdict

SUFFIXES = (".trace", ".seg")
START = b"drillctl-"  # of both forms; which one, and whether it is one at all, the trace room knows
NO_TRACES = pytest.ExitCode.NO_TESTS_COLLECTED
COUNT = pytest.StashKey[int]()  # traces that were collected, here or by the workers of pytest-xdist
TO_CONTROLLER = "drillctl_traces"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the plugin's options to pytest's."""
    group = parser.getgroup("drillctl", "traces of drilling machines")
    group.addoption("--drillctl-rewrite", action="store_true", help="record every golden trace anew, then pass")
    group.addoption("--drillctl-tables", metavar="DIR", type=Path, help="look for tables here first")
    group.addoption("--drillctl-same-tables", action="store_true", help="a trace recorded with other tables fails")
    group.addoption("--drillctl-report", metavar="DIR", type=Path, help="write a page for each trace that fails here")
    group.addoption("--drillctl-require-traces", action="store_true", help="exit non-zero when no trace was collected")


def pytest_configure(config: pytest.Config) -> None:
    """A folder of tables that is not there is refused, as on the command line."""
    tables = config.getoption("--drillctl-tables")
    if tables is not None and not tables.is_dir():
        raise pytest.UsageError(f"--drillctl-tables {tables}: no such folder")


@pytest.fixture
def drill(request: pytest.FixtureRequest) -> "Drill":
    """Returns a simulated machine to be driven: ``drill.run("KMD_GOTOdXdY 30 0").positions("x")`` (docs/API.md)."""
    from drillctl.api.fixture import Drill

    return Drill(request.path.parent)


def pytest_assertrepr_compare(op: str, left: object, right: object) -> list[str] | None:
    """Explains why two runs are not equal, by the first tick that differs."""
    if op != "==" or "drillctl.api.result" not in sys.modules:
        return None
    from drillctl.api.fixture import explain
    from drillctl.api.result import Run

    return explain(left, right) if isinstance(left, Run) and isinstance(right, Run) else None


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> "TraceFile | None":
    """Collects files that begin as a trace does; others with such a name are left alone."""
    if file_path.suffix in SUFFIXES and _is_trace(file_path):
        return TraceFile.from_parent(parent, path=file_path, nodeid=_node_id(parent, file_path))
    return None


def _node_id(parent: pytest.Collector, file: Path) -> str:
    """The name under which pytest shows the file, from its root folder; hidden characters of it are made visible."""
    from drillctl.language import one_line

    root = parent.config.rootpath
    return one_line((file.relative_to(root) if file.is_relative_to(root) else file).as_posix())


def _is_trace(file: Path) -> bool:
    from drillctl.files.inputs import read_start

    try:
        if read_start(file, len(START)) != START:
            return False
    except OSError:  # a pipe, a folder, a file that may not be read: nobody said that it is a trace
        return False
    from drillctl.trace import is_segments, is_trace

    return is_segments(file) if file.suffix == ".seg" else is_trace(file)


def pytest_collection_finish(session: pytest.Session) -> None:
    """Counts the traces that are to run in this process."""
    session.config.stash[COUNT] = sum(isinstance(item, TraceItem) for item in session.items)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any, error: object) -> None:
    """With pytest-xdist the workers collect; each tells the controller, as it ends, how many traces it found."""
    count = getattr(node, "workeroutput", {}).get(TO_CONTROLLER, 0)
    node.config.stash[COUNT] = max(node.config.stash.get(COUNT, 0), count)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """With --drillctl-require-traces, a run without any trace has failed."""
    config = session.config
    if hasattr(config, "workeroutput"):
        config.workeroutput[TO_CONTROLLER] = config.stash.get(COUNT, 0)
    elif session.exitstatus == pytest.ExitCode.OK and _lacks_traces(config):
        session.exitstatus = NO_TRACES


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """Says why a run whose tests all passed has failed."""
    if _lacks_traces(config):
        terminalreporter.write_line("drillctl: no trace was collected (--drillctl-require-traces)", red=True)


def _lacks_traces(config: pytest.Config) -> bool:
    return bool(config.getoption("--drillctl-require-traces")) and not config.stash.get(COUNT, 0)


class TraceFile(pytest.File):
    """A trace file, which has one test."""

    def collect(self) -> "Iterable[TraceItem]":
        """Yields the file's only test."""
        yield TraceItem.from_parent(self, name="replay")


class TraceMismatch(Exception):
    """The replay differs; the message is what a report shows."""


class TraceItem(pytest.Item):
    """The test of a trace: replays it, or records it anew."""

    def runtest(self) -> None:
        """Raises TraceMismatch at the first tick that differs."""
        from drillctl.machine import Library
        from drillctl.replay.compare import record_again, replay

        option = self.config.getoption
        library = Library.standard(option("--drillctl-tables"))
        if option("--drillctl-rewrite"):
            record_again(self.path, library)
            return
        verdict = replay(self.path, library)
        if verdict.failed(bool(option("--drillctl-same-tables"))):
            first = f"{self.path.name}: {verdict.headline()}"
            told = f"{first}\n{verdict.message()}\n  run       {verdict.remark()}"
            raise TraceMismatch(told + self._reported(verdict))

    def _reported(self, verdict: "Verdict") -> str:
        """Writes the page of the run by the tables at hand, where --drillctl-report asks for it; returns a line where
        it can't be had. A trace that differs has failed by that alone.
        """
        from drillctl.language import Refusal

        folder = self.config.getoption("--drillctl-report")
        if folder is None or verdict.difference is None:
            return ""
        try:
            self._write_page(verdict, folder)
        except (Refusal, OSError) as error:
            return f"\n  no page   {error}"
        return ""

    def _write_page(self, verdict: "Verdict", folder: Path) -> None:
        from drillctl.files.outputs import Output
        from drillctl.lab.run_report import comparison, report_of
        from drillctl.ui.report.page import report_page

        assert verdict.difference is not None
        found = comparison("recorded", "by these tables", verdict.difference, verdict.machine)
        page = report_page([report_of(verdict.actual, verdict.machine, self.path)], "en", found)
        folder.mkdir(parents=True, exist_ok=True)
        name = self.nodeid.partition("::")[0].replace("/", "-")  # traces of one name in several folders
        Output(folder / f"{name}.html").write(lambda stream: stream.write(page))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: object = None) -> str:
        """A dozen plain lines, without a Python traceback, for what is the trace's or the tables' fault."""
        from drillctl.language import LINES, visible
        from drillctl.machine import TableError
        from drillctl.trace import TraceError

        if isinstance(excinfo.value, TraceMismatch | TraceError | TableError):
            return visible(str(excinfo.value), LINES)
        return str(super().repr_failure(excinfo))

    def reportinfo(self) -> tuple[Path, int, str]:
        """The file of the test, its line and the name shown."""
        from drillctl.language import one_line

        return self.path, 0, f"trace {one_line(self.path.name)}"
