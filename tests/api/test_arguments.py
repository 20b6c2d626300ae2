"""What a stranger passes: numpy's numbers and any path are taken, anything else is refused in a sentence."""

import json
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import drillctl

BOARD = Path(__file__).resolve().parent.parent.parent / "examples" / "blinker.drl"
MOVE = "KMD_GOTOdXdY 3 0"


def test_numbers_of_numpy_are_numbers() -> None:
    run = drillctl.run(MOVE, tick_hz=np.int64(250), plant="dynamic", seed=np.uint8(3), faults={"blunt": np.float64(20)})
    assert run.machine.tick_hz == drillctl.run(MOVE, tick_hz=250.0).machine.tick_hz == 250  # type: ignore[arg-type]
    assert json.loads(json.dumps(run.outcome.as_dict()))["tick_hz"] == 250
    placed = drillctl.job(BOARD, rotate=np.int64(90), offset=np.array([5, 5]), skip_tools=np.array([1]))
    same = drillctl.job(str(BOARD), rotate=90.0, offset=(5.0, 5.0), skip_tools=[1])
    assert np.array_equal(placed.program, same.program)
    changed = drillctl.load_machine(changes={"axis.x.range": np.array([-10, 16600]), "tick_hz": np.int64(250)})
    assert (changed.axes[0].high_steps, changed.tick_hz) == (16600, 250)


def test_a_job_is_a_path_a_text_or_a_list() -> None:
    ticks = drillctl.estimate(MOVE).ticks
    for given in ([MOVE], (MOVE,), np.array([MOVE]), f"# a remark first\n{MOVE}\n", drillctl.job(MOVE)):
        assert drillctl.run(given).ticks == ticks


def test_a_small_fault_is_passed_on_as_it_was_given() -> None:
    run = drillctl.run(MOVE, plant="dynamic", faults={"loose.x": 1e-7, "blunt": 0.12345678})
    assert run.plant.faults == ("blunt=0.12345678", "loose.x=0.0000001")


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: drillctl.run(None), "source: expected a path, a text or a list of commands, got NoneType"),
        (lambda: drillctl.run([BOARD]), "each a text, got PosixPath"),
        (lambda: drillctl.run({MOVE}), "source: expected a path, a text or a list of commands, got set"),
        (lambda: drillctl.run(""), "source: no name that a file can have"),
        (lambda: drillctl.run("a\0b"), "source: no name that a file can have"),
        (lambda: drillctl.run(MOVE, None), "machine: expected a name or a file, got NoneType"),
        (lambda: drillctl.run(MOVE, tick_hz=500.5), "tick_hz: expected a whole number, got float"),
        (lambda: drillctl.run(MOVE, tick_hz=True), "tick_hz: expected a number, got bool"),
        (lambda: drillctl.run(MOVE, tick_hz=10**30), f"tick_hz {10**30}: 1 to 100000"),
        (lambda: drillctl.run(MOVE, plant="dynamic", seed=-1), "seed -1: 0 to 2147483647"),
        (lambda: drillctl.run(MOVE, plant="dynamic", faults={"blunt": "20"}), "blunt: expected a number, got str"),
        (lambda: drillctl.run(MOVE, plant="dynamic", faults=["blunt=20"]), "faults: expected a dict, got list"),
        (lambda: drillctl.run(BOARD, offset="5,5"), "offset: expected array, got str"),
        (lambda: drillctl.run(BOARD, order="optimized"), "there are file, nearest, optimised; did you mean optimised?"),
        (lambda: drillctl.run(BOARD, skip_tool=3), "did you mean skip_tools?"),
        (lambda: drillctl.run(BOARD, tables="x"), "no option 'tables'"),
        (lambda: drillctl.run(drillctl.job(BOARD), rotate=90, tick_hz=9), "give rotate, tick_hz to drillctl.job"),
        (lambda: drillctl.run(drillctl.job(BOARD), "cnc-shield"), "give machine to drillctl.job"),
        (lambda: drillctl.load_machine(tables="nope"), "nope: no such folder"),
        (lambda: drillctl.load_machine(changes=[("tick_hz", 1)]), "changes: expected a dict, got list"),
        (lambda: drillctl.load_machine(changes={"tick_hz": None}), "tick_hz: expected a text or a number, got N"),
        (lambda: drillctl.load_machine(changes={"axis.x": 1}), "axis.x is a table and no value"),
        (lambda: drillctl.inspect(BOARD, after_end="q"), "there are refuse, ignore, drill"),
        (lambda: drillctl.inspect(BOARD, format=5), "format: expected str, got int"),
        (lambda: drillctl.replay_trace(None), "file: expected a path, got NoneType"),
        (lambda: drillctl.run(MOVE).signal(None), "no signal 'None'"),
        (lambda: drillctl.run(MOVE).currents(["x"]), "no axis ['x']"),
    ],
)
def test_what_is_no_argument_is_refused_by_its_name(call: Callable[[], Any], words: str) -> None:
    with pytest.raises(drillctl.Refused) as refused:
        call()
    assert words in str(refused.value)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"hz": 500}, "hz: expected a list, got int"),
        ({"hz": ()}, "hz: the list is empty"),
        ({"hz": (500, 500.0)}, "hz: a value stands in the list twice"),
        ({"hz": (0,)}, "hz 0: 50 to 20000"),
        ({"steps": (-5,)}, "steps -5: 1 to 100000"),
        ({"vary": {"coulomb_nm": (float("nan"),)}}, "coulomb_nm nan: 0.001 to 1000"),
        ({"vary": ["coulomb_nm"]}, "vary: expected a dict, got list"),
        ({"load_nm": ("1",)}, "load_nm: expected a number, got str"),
        ({"draws": 0}, "draws 0: 1 to 100000"),
        ({"spread": 5}, "spread 5: 0 to 0.5"),
        ({"workers": 1.5}, "workers: expected a whole number, got float"),
        ({"axis": 0}, "no axis '0'; there are x, y, z"),
        ({"machine": "eight-axis"}, "take unipolar motors"),
    ],
)
def test_a_sweep_that_can_not_be_meant_is_refused(arguments: dict[str, Any], words: str) -> None:
    with pytest.raises(drillctl.Refused) as refused:
        drillctl.sweep(**{"steps": (5,), **arguments})
    assert words in str(refused.value)


def test_a_sweep_takes_arrays_and_a_single_name() -> None:
    rows = drillctl.sweep(hz=np.arange(500, 700, 100), steps=np.array([5]), ramp="seven-state", phase="one phase alone")
    assert rows["tick_hz"].tolist() == [500, 600] and set(rows["phase"]) == {"one phase alone"}


@pytest.mark.parametrize("options", [{"offset": (1e30, 0.0)}, {"rotate": 1e300}, {"panel": (2, 1, 1e300, 5.0)}])
def test_a_place_beyond_all_machines_is_refused_as_it_was_given(options: dict[str, Any]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(drillctl.Refused, match=r"plain numbers up to 10000, not .*1e"):
            drillctl.job(BOARD, **options)
