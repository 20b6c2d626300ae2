"""What a screen asks of a board reaches the job's options whole: each field of the one has its place in the other."""

from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import msgspec
import pytest

from drillctl.console.job_request import options_of
from drillctl.generation.choices import AFTER_END, MIRRORED, ORDERS, ORIGINS
from drillctl.generation.job_options import JobOptions
from drillctl.machine import Library, Machine
from drillctl.ui.pcb_drill.board_facts import CHOICES, option_lines, recent_line
from drillctl.viewmodel.jobs import Asked, MeasuredHole, PanelOf

VERBS_ONLY = {"tables", "store"}  # folder and file that a verb is given; a screen has those of its console
HOLES = (MeasuredHole(0.0, 1.0, 2.0, 3.0), MeasuredHole(4.0, 5.0, 6.0, 7.0))
EVERYTHING = Asked(
    format="mm,decimal", origin="file", mirror="x", rotate_deg=90.0, offset_mm=(1.0, -2.0), order="nearest",
    panel=PanelOf(2, 3, 40.0, 30.5), measured=HOLES, peck_mm=0.5, spot_mm=0.2, skip_tools=(3, 2),
    drills="/drills.toml", after_end="drill",
)  # fmt: skip
BASE = (120, 240)
ASKED_FIELDS = [field.name for field in fields(Asked)]
OFFERED = {"mirror": MIRRORED, "origin": ORIGINS, "order": ORDERS, "after_end": AFTER_END}


@pytest.fixture(scope="module")
def machine() -> Machine:
    return Library.standard().machine("pcb-drill").at_rate(750)


def test_each_field_becomes_its_option(machine: Machine) -> None:
    assert options_of(EVERYTHING, machine, BASE) == JobOptions(
        machine="pcb-drill", tick_hz=750, origin="file", mirror="x", rotate=90.0, offset=(1.0, -2.0),
        align=((0.0, 1.0, 2.0, 3.0), (4.0, 5.0, 6.0, 7.0)), panel=(2, 3, 40.0, 30.5), order="nearest",
        skip_tools=(2, 3), drills="/drills.toml", peck=0.5, spot=0.2, format="mm,decimal", after_end="drill", base=BASE,
    )  # fmt: skip


def test_a_screen_that_asks_nothing_has_the_defaults_of_the_verbs(machine: Machine) -> None:
    assert options_of(Asked(), machine, (0, 0)) == JobOptions(machine="pcb-drill", tick_hz=750)


def test_every_option_can_be_asked_for_on_the_screen(machine: Machine) -> None:
    """A new option that the screen lacks fails here, until it has a field of Asked or a reason in VERBS_ONLY."""
    options = options_of(EVERYTHING, machine, BASE)
    usual = {field.name: field.default for field in msgspec.structs.fields(JobOptions)}
    assert {name for name, value in usual.items() if getattr(options, name) == value} == VERBS_ONLY


@pytest.mark.parametrize("field", ASKED_FIELDS)
def test_no_field_is_asked_in_vain_or_unseen(field: str, machine: Machine) -> None:
    usual = Asked()
    other = replace(usual, **{field: getattr(EVERYTHING, field)})
    assert options_of(other, machine, BASE) != options_of(usual, machine, BASE)
    assert option_lines(other) != option_lines(usual)
    assert recent_line("/a.drl", other) != recent_line("/a.drl", usual)


@pytest.mark.parametrize("field", OFFERED)
def test_the_screen_offers_what_the_verbs_offer(field: str) -> None:
    (choice,) = (choice for choice in CHOICES if choice.field == field)
    assert tuple(value for value, _ in choice.values if value is not None) == OFFERED[field]


@pytest.mark.parametrize(
    "asked", [{"order": "shortest"}, {"origin": "corner"}, {"after_end": "sell"}, {"offset_mm": (1.0,)}]
)
def test_a_value_that_no_verb_takes_is_refused(asked: dict[str, Any], machine: Machine) -> None:
    with pytest.raises(msgspec.ValidationError):
        options_of(Asked(**asked), machine, BASE)


def test_a_machine_of_a_folder_of_its_own_is_named_by_its_file(machine: Machine, tmp_path: Path) -> None:
    file = tmp_path / "pcb-drill.toml"
    file.write_bytes(Path(machine.file).read_bytes())
    own = Library.standard().machine(str(file))
    assert options_of(Asked(), own, BASE).machine == str(file)
