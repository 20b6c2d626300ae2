"""A table on the bench: what its columns do to a rotor, and what the motors of a machine lose with it."""

import re
from pathlib import Path

import pytest

from drillctl.generation.waits import unwatched
from drillctl.lab import table_bench
from drillctl.lab.table_bench import TableBench
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.viewmodel.bench import BenchReport, CyclePath

LIBRARY = Library((shipped_tables(),))
FORCED = "two-phase-forced"
WINDINGS = '[[wire]]\nname = "{}"\nvolts = {}\npattern = "{}"\n'


@pytest.fixture(autouse=True)
def few_moves(monkeypatch: pytest.MonkeyPatch) -> None:
    """Enough to lose steps with a wrong table, and quick without a compiler."""
    monkeypatch.setattr(table_bench, "SHORT_STEPS", (3,))
    monkeypatch.setattr(table_bench, "CRUISE_COLUMNS", (48,))


def text_of(kind: str, name: str) -> str:
    file = LIBRARY.find(kind, name)
    assert file is not None
    return Path(file).read_text("utf-8")


def phase(**rows: str) -> str:
    """A phase table: ``w1a="xx.."`` is the wire 1a, a name with 24 in it is at 24 V."""
    wires = (WINDINGS.format(name[1:], 24 if "24" in name else 5, row) for name, row in rows.items())
    return f'name = "{FORCED}"\n' + "".join(wires)


def path(text: str, machine: str = "pcb-drill") -> CyclePath:
    return TableBench(lambda: LIBRARY.machine(machine)).path(FORCED, text)


def run(text: str, machine: str = "pcb-drill", kind: str = "phase", name: str = FORCED) -> BenchReport:
    report, problems = TableBench(lambda: LIBRARY.machine(machine)).run(kind, name, text, unwatched)  # type: ignore[arg-type]
    assert problems == () and report is not None
    return report


FORWARDS = {"w1a": "xxxxxx......", "w1b": "......xxxxxx", "w2a": "xxx......xxx", "w2b": "...xxxxxx..."}
FORCING = {"w24a": "x.....x.....", "w24b": "...x.....x.."}


def test_the_papers_table_turns_a_rotor_by_a_cycle_in_four_rests() -> None:
    found = path(text_of("phase", FORCED))
    assert [column.place for column in found.columns] == [3, 3, 3, 6, 6, 6, 9, 9, 9, 12, 12, 12]
    assert (found.turned, found.wanted, found.motor, found.in_use) == (12, 12, "x", True)
    assert {round(column.torque, 3) for column in found.columns} == {1.414} and found.torque_mnm == pytest.approx(
        78.18, abs=0.01
    )


def test_the_order_of_the_wires_in_a_table_means_nothing() -> None:
    backwards = dict(reversed({**FORWARDS, **FORCING}.items()))
    assert path(phase(**backwards)).columns == path(text_of("phase", FORCED)).columns
    assert not run(phase(**backwards)).lost


@pytest.mark.parametrize(
    ("changed", "free"),
    [
        pytest.param({"w1b": "xxxxxx......", "w2b": "xxx......xxx"}, range(12), id="all halves against each other"),
        pytest.param(dict.fromkeys(FORWARDS, "." * 12), range(12), id="nothing is on"),
    ],
)
def test_a_column_that_holds_no_rotor_has_no_torque(changed: dict[str, str], free: range) -> None:
    found = path(phase(**{**FORWARDS, **FORCING, **changed}))
    assert [number for number, column in enumerate(found.columns) if column.torque == 0] == [*free]
    assert found.turned == 0


def test_a_sound_table_loses_nothing_and_a_wrong_one_loses_what_the_rotor_did_not_turn() -> None:
    sound = run(text_of("phase", FORCED))
    assert [(each.motor, each.dynamic, each.lost) for each in sound.runs] == [
        ("x", True, 0),
        ("y", True, 0),
        ("z", True, 0),
    ]
    swapped = run(phase(**{**FORWARDS, **FORCING, "w2a": "...xxxxxx...", "w2b": "xxx......xxx"}))
    assert swapped.lost and abs(swapped.worst.lost) > abs(swapped.worst.steps), "it turns the other way"
    assert swapped.worst.behind[-1] == pytest.approx(swapped.worst.lost, abs=2)


def test_a_ramp_that_starts_too_fast_loses_steps_where_a_state_is_held_for_half_a_cycle() -> None:
    slow = text_of("ramp", "seven-state")
    fast = re.sub(r"interval = \d", "interval = 1", slow)
    assert not run(slow, "pcb-drill-ramp-lab", "ramp", "seven-state").lost
    assert run(fast, "pcb-drill-ramp-lab", "ramp", "seven-state").lost


def test_a_motor_without_dynamics_is_ideal_and_still_tells_a_wrong_table() -> None:
    name = "uln2003-half-step"
    sound = run(text_of("phase", name), "mega-28byj48", "phase", name)
    assert [(each.motor, each.dynamic, each.lost) for each in sound.runs] == [(motor, False, 0) for motor in "xyz"]
    off = "\n".join('pattern = "......"' if "pattern" in line else line for line in text_of("phase", name).split("\n"))
    assert run(off, "mega-28byj48", "phase", name).lost


def test_a_reluctance_motor_is_dynamic() -> None:
    name = "three-phase-six-beat"
    sound = run(text_of("phase", name), "boiler-drum", "phase", name)
    assert [(each.motor, each.dynamic, each.lost) for each in sound.runs] == [("y", True, 0)]


def test_a_table_that_no_motor_has_is_tried_on_one_that_fits_or_refused() -> None:
    assert not run(text_of("phase", FORCED).replace(FORCED, "mine"), name="mine").in_use
    report, problems = TableBench(lambda: LIBRARY.machine("pcb-drill")).run(
        "phase", "pulse-direction", text_of("phase", "pulse-direction"), unwatched
    )
    assert report is None and len(problems) == 1
    assert path(text_of("phase", "pulse-direction"), "eight-axis").columns == ()


def test_what_is_no_table_or_no_machine_is_refused_and_has_no_path() -> None:
    nowhere: Machine | None = None
    bench = TableBench(lambda: nowhere)
    assert bench.path("one", "nonsense [") == CyclePath()
    for text in ("nonsense [", text_of("phase", FORCED)):
        report, problems = bench.run("phase", "one", text, unwatched)
        assert report is None and problems
