"""What a test in any repository says of a machine: the object behind the fixture ``drill``."""

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


class Drill:
    """The functions of the API for a test; files are looked for beside the test first.

    folder  of the test
    runs    made so far by this test, in their order
    """

    def __init__(self, folder: Path):
        self.folder = folder
        self.runs: list[Run] = []

    def machine(self, name: str = DEFAULT, **options: Any) -> Machine:
        """Returns a machine, as ``drillctl.load_machine``; one given by its file is looked for beside the test."""
        return load_machine(self._beside(name) if name.endswith(".toml") else name, **options)

    def run(self, source: Source, machine: MachineGiven = DEFAULT, **options: Any) -> Run:
        """Runs a job, as ``drillctl.run``: ``drill.run("KMD_GOTOdXdY 30 0")``, ``drill.run("board.drl")``."""
        done = run(self._beside(source), machine, **options)
        self.runs.append(done)
        return done

    def estimate(self, source: Source, machine: MachineGiven = DEFAULT, **options: Any) -> Estimate:
        """Returns how long a job takes, as ``drillctl.estimate``."""
        return estimate(self._beside(source), machine, **options)

    def _beside(self, source: Any) -> Any:
        if isinstance(source, str | Path) and (self.folder / source).is_file():
            return self.folder / source
        return source


def explain(left: Run, right: Run) -> list[str]:
    """Returns why two runs are not equal, line by line: what pytest shows below ``assert run == other``."""
    found = first_difference(left.trace, right.trace)
    if found is None:
        return ["the runs differ in their machines", f"{left.machine.name} and {right.machine.name}"]
    shown = render(found, wire_names(left.machine))
    return ["the runs differ (the left one is taken as recorded)", *shown.splitlines()]
