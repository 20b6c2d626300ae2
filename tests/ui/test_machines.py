"""The screens of a family of machines: chosen by what a machine has, and closed against the program and each other."""

import subprocess
import sys
from pathlib import Path

import pytest
import urwid
from msgspec.structs import replace

from drillctl.ui import app, machines
from drillctl.ui.machines import FAMILIES, screens_of
from drillctl.ui.pcb_drill import PCB_DRILL
from drillctl.ui.screens.menus import HELP
from drillctl.ui.screens.shell import MachineScreens
from drillctl.viewmodel.console import MachineView
from tests.test_rooms import PACKAGE, imported_modules
from tests.ui.fake_console import VIEW, FakeConsole, Program
from tests.ui.whole import Whole, at_home

UI = PACKAGE / "ui"
SHARED = ("screens", "models", "widgets", "terminal", "report")
PACKAGES = sorted(path.parent.name for path in UI.glob("*/__init__.py") if path.parent.name not in SHARED)
ROOT_MODULES = sorted(path.stem for path in UI.glob("*.py") if path.stem != "__init__")


def imports_of(file: Path) -> set[str]:
    """What of drillctl.ui a module imports: ``app``, ``screens.scope``."""
    package = ".".join(["drillctl", *file.relative_to(PACKAGE).parent.parts])
    names = imported_modules(file.read_text("utf-8"), package)
    return {name.removeprefix("drillctl.ui.") for name in names if name.startswith("drillctl.ui.")}


def into(names: set[str], rooms: list[str]) -> list[str]:
    return sorted(name for name in names if name.split(".")[0] in rooms)


@pytest.mark.parametrize("package", PACKAGES)
def test_a_familys_package_knows_neither_the_program_nor_another_family(package: str) -> None:
    closed = [*ROOT_MODULES, "terminal", *(other for other in PACKAGES if other != package)]
    assert {file.name: found for file in (UI / package).glob("*.py") if (found := into(imports_of(file), closed))} == {}


def test_the_program_reaches_a_family_through_the_registry_alone() -> None:
    files = [UI / f"{module}.py" for module in ROOT_MODULES if module != "machines"]
    assert {file.name: found for file in files if (found := into(imports_of(file), PACKAGES))} == {}
    assert set(PACKAGES) <= {name.split(".")[0] for name in imports_of(UI / "machines.py")}


def test_the_verbs_output_and_the_program_on_the_screen_know_nothing_of_each_other() -> None:
    closed = [*ROOT_MODULES, *PACKAGES]
    for file in (UI / "terminal").glob("*.py"):
        assert into(imports_of(file), closed) == []
    for module in ROOT_MODULES:
        assert into(imports_of(UI / f"{module}.py"), ["terminal"]) == []


def test_no_familys_screen_is_imported_before_it_is_opened() -> None:
    """The first frame shows one of them, of the family that the machine belongs to."""
    ask = "import sys, drillctl.ui.app; print(*(name for name in sys.modules if name.startswith('drillctl.ui.')))"
    loaded = subprocess.run([sys.executable, "-c", ask], capture_output=True, text=True, check=True).stdout.split()
    screens = {"boiler_drum.panel", "eight_axis.machine", "pcb_drill.drilling", "pcb_drill.files"}
    assert "drillctl.ui.machines" in loaded and not screens & {name.removeprefix("drillctl.ui.") for name in loaded}


def test_every_familys_menus_lead_to_screens_that_it_has() -> None:
    for family in FAMILIES:
        assert family.first in family.makers
        assert {menu.label for menu in family.menus} >= {"&Tests", "&Configuration", "&Help"}


class OtherScreen(urwid.SolidFill):
    """The first screen of a family that is not there yet."""

    title = "Other"


OTHER = MachineScreens(
    recognises=lambda view: len(view.axes) == 1,
    menus=(HELP,),
    makers={"other": lambda _console, _shell, _plain: OtherScreen("?")},
    first="other",
    at_start=lambda _console, _shell: None,
    next_step=PCB_DRILL.next_step,
)


def one_axis(view: MachineView) -> MachineView:
    return replace(view, axes=view.axes[:1])


def test_a_family_recognises_its_machines_and_the_last_takes_the_rest() -> None:
    families = (OTHER, PCB_DRILL)
    assert screens_of(one_axis(VIEW), families) is OTHER
    assert screens_of(VIEW, families) is PCB_DRILL
    assert screens_of(VIEW, (OTHER,)) is OTHER


def test_a_machine_of_another_family_brings_its_own_screens_and_menus(
    monkeypatch: pytest.MonkeyPatch, idle: None
) -> None:
    monkeypatch.setattr(app, "screens_of", lambda view: machines.screens_of(view, (OTHER, PCB_DRILL)))
    program = Program(FakeConsole())
    assert program.text().splitlines()[0].split() == ["Files", "Drilling", "Tests", "Configuration", "Help"]
    program.console.now = one_axis(VIEW)
    program.app.take_machine("lathe")
    assert program.text().splitlines()[0].split() == ["Help"]
    assert "????" in program.text()
    program.app.back()
    assert "????" in program.text()
    assert program.app.show("files") is None
    program.press("esc")
    program.console.now = VIEW
    program.app.take_machine("pcb-drill")
    assert "Drilling" in program.text().splitlines()[0]
    assert "????" not in program.text()


def test_the_screens_follow_a_machine_that_came_by_another_way_than_the_menu(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A table put in force loads the machine of its file; what every machine has stays open."""
    at_home(tmp_path, monkeypatch)
    whole = Whole()
    try:
        whole.app.take_machine("boiler-drum")
        assert type(whole.app.screens[-1]).__name__ == "Panel"
        signals = whole.app.show("signals")
        assert whole.console.choose_machine("pcb-drill") == ()
        whole.go_on(1)
        assert whole.app.screens[-1] is signals
        whole.press("esc")
        assert [type(screen).__name__ for screen in whole.app.screens] == ["Drilling"]
        assert "Drilling" in whole.text()
    finally:
        whole.console.close()
