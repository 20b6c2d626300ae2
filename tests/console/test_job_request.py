"""The screen offers every option of a job, and what it asks for is checked as the command line checks it."""

from pathlib import Path
from typing import Any

import msgspec
import pytest
from msgspec.structs import replace

from drillctl.console.job_request import setup_of
from drillctl.generation.job_setup import JobSetup
from drillctl.machine import Library, Machine
from drillctl.ui.pcb_drill.board_facts import CHOICES, option_lines, recent_line
from drillctl.viewmodel.choices import AFTER_END, MIRRORED, ORDERS, ORIGINS
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole, PanelOf, PinsOf

# A file that a verb is given (a screen has the store of its machine); a bound for scripts that can't wait, and what a
# journal keeps of it.
VERBS_ONLY = {"store", "order_seconds", "order_steps", "spindles"}
HOLES = (MeasuredHole(0.0, 1.0, 2.0, 3.0), MeasuredHole(4.0, 5.0, 6.0, 7.0))
EVERYTHING = JobOptions(
    format="mm,decimal", origin="file", mirror="x", rotate_deg=90.0, offset_mm=(1.0, -2.0), order="nearest",
    panel=PanelOf(2, 3, 40.0, 30.5), align=HOLES, peck_mm=0.5, spot_mm=0.2, skip_tools=(2, 3),
    drills="/drills.toml", after_end="drill", pins=PinsOf(3.0, "corners", 6.0), mill=True,
)  # fmt: skip
BASE = (120, 240)
ON_THE_SCREEN = [name for name in JobOptions.__struct_fields__ if name not in VERBS_ONLY]
OFFERED = {"mirror": MIRRORED, "origin": ORIGINS[1:], "order": ORDERS, "after_end": AFTER_END}  # base: by None


@pytest.fixture(scope="module")
def machine() -> Machine:
    return Library.standard().machine("pcb-drill").at_rate(750)


def test_the_options_of_the_screen_are_those_of_the_setup(machine: Machine) -> None:
    assert setup_of(EVERYTHING, machine, BASE) == JobSetup("pcb-drill", EVERYTHING, tick_hz=750, base=BASE)


@pytest.mark.parametrize("field", ON_THE_SCREEN)
def test_every_option_is_shown_on_the_screen(field: str) -> None:
    """A new option that the screen lacks fails here, until EVERYTHING has it or VERBS_ONLY says why not."""
    other = replace(JobOptions(), **{field: getattr(EVERYTHING, field)})
    assert other != JobOptions()
    assert option_lines(other) != option_lines(JobOptions())
    assert recent_line("/a.drl", other) != recent_line("/a.drl", JobOptions())


@pytest.mark.parametrize("field", OFFERED)
def test_the_screen_offers_what_the_verbs_offer(field: str) -> None:
    (choice,) = (choice for choice in CHOICES if choice.field == field)
    assert tuple(value for value, _ in choice.values if value is not None) == OFFERED[field]


@pytest.mark.parametrize(
    "options", [{"order": "shortest"}, {"origin": "corner"}, {"after_end": "sell"}, {"offset_mm": (1.0,)}]
)
def test_a_value_that_no_verb_takes_is_refused(options: dict[str, Any], machine: Machine) -> None:
    with pytest.raises(msgspec.ValidationError):
        setup_of(JobOptions(**options), machine, BASE)


def test_a_machine_of_a_folder_of_its_own_is_named_by_its_file(machine: Machine, tmp_path: Path) -> None:
    file = tmp_path / "pcb-drill.toml"
    file.write_bytes(Path(machine.file).read_bytes())
    own = Library.standard().machine(str(file))
    assert setup_of(JobOptions(), own, BASE).machine == str(file)
