"""What a test in any repository says of a machine: the object behind the fixture ``drill``."""

from os import PathLike, fspath
from pathlib import Path
from typing import Any

from drillctl.api.jobs import MachineGiven, Source, estimate
from drillctl.api.machines import DEFAULT, load_machine
from drillctl.api.result import Run
from drillctl.api.runs import run
from drillctl.machine import Machine
from drillctl.ticker.sampler import wire_names
from drillctl.trace import first_difference, render
from drillctl.viewmodel.records import Estimate

FILES = ("tables", "align", "drills", "store")  # options that name one


class Drill:
    """The functions of the API for a test; files are looked for beside the test first.

    folder  of the test
    runs    made so far by this test, in their order
    """

    def __init__(self, folder: Path):
        self.folder = folder
        self.runs: list[Run] = []

    def machine(self, name: str | PathLike[str] = DEFAULT, **options: Any) -> Machine:
        """Returns a machine, as ``drillctl.load_machine``; one given by its file is looked for beside the test."""
        return load_machine(self._machine(name), **self._options(options))

    def run(self, source: Source, machine: MachineGiven = DEFAULT, **options: Any) -> Run:
        """Runs a job, as ``drillctl.run``: ``drill.run("KMD_GOTOdXdY 30 0")``, ``drill.run("board.drl")``."""
        done = run(self._beside(source), self._machine(machine), **self._options(options))
        self.runs.append(done)
        return done

    def estimate(self, source: Source, machine: MachineGiven = DEFAULT, **options: Any) -> Estimate:
        """Returns how long a job takes, as ``drillctl.estimate``."""
        return estimate(self._beside(source), self._machine(machine), **self._options(options))

    def _options(self, options: dict[str, Any]) -> dict[str, Any]:
        return {name: self._beside(value) if name in FILES else value for name, value in options.items()}

    def _machine(self, given: Any) -> Any:
        return self._beside(given) if isinstance(given, str | PathLike) and fspath(given).endswith(".toml") else given

    def _beside(self, given: Any) -> Any:
        """A file or a folder beside the test; what is none there, as it was given."""
        if not isinstance(given, str | PathLike) or not fspath(given):
            return given
        try:
            found = (self.folder / given).exists()
        except (OSError, ValueError):  # no name that a file can have: commands
            return given
        return self.folder / given if found else given


def explain(left: Run, right: Run) -> list[str]:
    """Returns why two runs are not equal, line by line: what pytest shows below ``assert run == other``."""
    found = first_difference(left.trace, right.trace)
    if found is None:
        told = (f"{run.machine.name} {run.machine.digest}" for run in (left, right))
        return ["the same in every tick, but by other tables", " and ".join(told)]
    shown = render(found, wire_names(left.machine))
    return ["the runs differ (the left one is taken as recorded)", *shown.splitlines()]
