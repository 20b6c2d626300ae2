"""Wiring: ``*.trace`` and ``*.seg`` files are tests, in anybody's repository that has drillctl installed.

A trace is replayed with the tables at hand; the test fails at the first tick that differs. Only files that begin
with the magic line are collected. ``--drillctl-rewrite`` records goldens anew on the simulated machine.
"""

from collections.abc import Iterable
from pathlib import Path

import pytest

from drillctl.machine import Library, TableError
from drillctl.trace import TraceError, is_segments, is_trace
from drillctl.wording import LINES, one_line, visible

FORMS = {".trace": is_trace, ".seg": is_segments}
NO_TRACES = pytest.ExitCode.NO_TESTS_COLLECTED


def pytest_addoption(parser: pytest.Parser) -> None:
    """The plugin's options."""
    group = parser.getgroup("drillctl", "traces of drilling machines")
    group.addoption("--drillctl-rewrite", action="store_true", help="record every golden trace anew, then pass")
    group.addoption("--drillctl-tables", metavar="DIR", type=Path, help="look for tables here first")
    group.addoption(
        "--drillctl-same-tables", action="store_true", help="a trace recorded with other tables fails"
    )
    group.addoption(
        "--drillctl-require-traces", action="store_true", help="exit non-zero when no trace was collected"
    )


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> "TraceFile | None":
    """Traces by their first line; other files that happen to be called so are left alone."""
    if file_path.suffix in FORMS and FORMS[file_path.suffix](file_path):
        return TraceFile.from_parent(parent, path=file_path)
    return None


def pytest_sessionfinish(session: pytest.Session) -> None:
    """With --drillctl-require-traces, a run without any trace has failed."""
    if not session.config.getoption("--drillctl-require-traces"):
        return
    if not any(isinstance(item, TraceItem) for item in session.items) and session.exitstatus == pytest.ExitCode.OK:
        session.exitstatus = NO_TRACES


class TraceFile(pytest.File):
    """One file: one test."""

    def collect(self) -> "Iterable[TraceItem]":
        """The file's only item."""
        yield TraceItem.from_parent(self, name="replay")


class TraceMismatch(Exception):
    """The replay differs; the message is what a report shows."""


class TraceItem(pytest.Item):
    """Replays a trace, or records it anew."""

    def runtest(self) -> None:
        """Raises TraceMismatch at the first tick that differs."""
        from drillctl.wiring.replay import record_again, replay

        option = self.config.getoption
        library = Library.standard(option("--drillctl-tables"))
        if option("--drillctl-rewrite"):
            record_again(self.path, library)
            return
        verdict = replay(self.path, library)
        if verdict.failed(bool(option("--drillctl-same-tables"))):
            raise TraceMismatch(f"{self.path.name}: {verdict.remark()}\n{verdict.message()}")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: object = None) -> str:
        """A dozen plain lines, without a Python traceback, for what is the trace's or the tables' fault."""
        if isinstance(excinfo.value, TraceMismatch | TraceError | TableError):
            return visible(str(excinfo.value), LINES)
        return str(super().repr_failure(excinfo))

    def reportinfo(self) -> tuple[Path, int, str]:
        """Where the test stands."""
        return self.path, 0, f"trace {one_line(self.path.name)}"

