"""The whole program in one process: every screen on paper, and a console whose machine runs free behind them.

Rule: only the terminal is a stand-in; the console notes what sets its machine going, and by which actions of the
screens. Used by the tests that try everything on every screen.
"""

import re
import sys
from pathlib import Path

import pytest
import urwid

from drillctl.cli.screen import EditorScreens
from drillctl.console import signals as handbench
from drillctl.console.machine_console import MachineConsole
from drillctl.generation.waits import unwatched
from drillctl.language import words
from drillctl.machine import Library, shipped_tables
from drillctl.ticker.launch import RunSettings
from drillctl.ui import app, background
from drillctl.ui.eight_axis.machine import MachineScreen
from drillctl.viewmodel.console import Problems, Watch
from drillctl.viewmodel.job_options import JobOptions
from tests.ui.fake_console import Paper

BLINKER = Path(__file__).resolve().parents[2] / "examples" / "blinker.drl"
SCREENS = (
    "drilling", "files", "phase_editor", "ramp_editor", "queue_editor", "signals", "scope", "configuration", "port",
    "plant", "panel", "machine", "parameters",
)  # fmt: skip
MACHINES = {"panel": "boiler-drum", "machine": "eight-axis", "parameters": "eight-axis"}  # of others than the first
PARTS = re.compile(r"/drillctl/(ui|console)/")
Event = str | tuple[str, int, int, int]


def at_home(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The user's folders are here, with a board in them; a beat takes no time of its own."""
    words.use("en")
    for name in ("XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_DATA_HOME", "HOME"):
        monkeypatch.setenv(name, str(home))
    monkeypatch.chdir(home)
    monkeypatch.setattr(app, "TURNING_S", 0.0)
    monkeypatch.setattr(background, "SHOWN_AFTER_S", 60.0)  # work is waited for, however busy the computer is
    monkeypatch.setattr(handbench, "MachineSignals", WatchedHands)
    (home / BLINKER.name).write_bytes(BLINKER.read_bytes())


def actions() -> set[str]:
    """The functions of screens and console that are on their way just now."""
    found, frame = set(), sys._getframe(1)
    while frame.f_back is not None:
        frame = frame.f_back
        if PARTS.search(frame.f_code.co_filename):
            found.add(frame.f_code.co_qualname)
    return found


class Watched(MachineConsole):
    """Notes whatever sets the machine going, and by which actions; reads one board only, whichever is chosen."""

    def __init__(self, library: Library | None = None) -> None:
        library = library or Library((shipped_tables(),))
        super().__init__(library, library.machine("pcb-drill"), RunSettings("simulated", "free"), tools="ask")
        self.moved: list[tuple[str, set[str]]] = []
        self.stops = 0

    def load(self, file: str, asked: JobOptions, watch: Watch = unwatched) -> Problems:
        return super().load(str(BLINKER), asked, watch)

    def start(self, dry: bool) -> Problems:
        return self.noted("dry" if dry else "start", super().start(dry))

    def go_on(self) -> Problems:
        return self.noted("go_on", super().go_on())

    def tool_changed(self) -> Problems:
        return self.noted("tool_changed", super().tool_changed())

    def run_queue(self, text: str) -> Problems:
        return self.noted("run_queue", super().run_queue(text))

    def initialise(self) -> Problems:
        return self.noted("initialise", super().initialise())

    def jog(self, axis: str, steps: int) -> Problems:
        return self.noted("jog", super().jog(axis, steps))

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        return self.noted("go_to", super().go_to(x_mm, y_mm))

    def resume(self) -> Problems:
        return self.noted("resume", super().resume())

    def emergency_stop(self) -> Problems:
        self.stops += 1
        return super().emergency_stop()

    def noted(self, what: str, problems: Problems) -> Problems:
        """Handed on as it is."""
        if not problems:
            self.moved.append((what, actions()))
        return problems


class WatchedHands(handbench.MachineSignals):
    """An output that is switched by hand is noted as well."""

    def set_output(self, bit: int, on: bool) -> Problems:
        assert isinstance(self._console, Watched)
        return self._console.noted("set_output", super().set_output(bit, on))


def show(shell: app.App, name: str) -> urwid.Widget | None:
    """Opens a screen by its name, on a machine that has it."""
    if name in MACHINES:
        shell.take_machine(MACHINES[name])
    if name not in ("machine", "parameters"):
        return shell.show(name)
    machine = shell.show("drilling")
    assert isinstance(machine, MachineScreen)
    if name == "parameters":
        machine.form("tool")
    return shell.screens[-1]


class Whole:
    """The program at a size, in the language that is spoken, on the shipped tables or a library. To be closed."""

    def __init__(self, size: tuple[int, int] = (80, 24), library: Library | None = None):
        library = library or Library((shipped_tables(),))
        self.console = Watched(library)
        self.paper = Paper()
        self.paper.size = size
        makers = EditorScreens(library, self.console, plain=False).makers()
        self.app = app.App(self.console, makers=makers, terminal=self.paper)

    def press(self, *events: Event) -> None:
        """As the loop does it: filter, widgets, and what is left."""
        for event in events:
            self.app.loop.screen_size = self.paper.size
            self.app.loop.process_input(self.app.filtered([event], []))

    def go_on(self, turns: int) -> None:
        """The machine works, and the screen shows it."""
        for _ in range(turns):
            self.console.turn()
        self.app.turn()

    def text(self) -> str:
        """The screen, row by row, without its colours."""
        return "\n".join(row.decode() for row in self.canvas().text)

    def canvas(self) -> urwid.Canvas:
        """The whole screen as it is drawn; the same object again where nothing has changed."""
        return self.app.loop.widget.render(self.paper.size, focus=True)
