"""What a script or a notebook sees: the names, the shapes, the errors, and how little an import costs."""

import doctest
import signal
import subprocess
import sys
import threading
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import drillctl
from drillctl.api import PUBLIC
from drillctl.jobs.interrupts import caught
from drillctl.viewmodel.records import Progress

BOARD = Path(__file__).resolve().parent.parent.parent / "examples" / "blinker.drl"
MODULES = sorted({*PUBLIC.values()})


def test_public_names_are_listed_once_and_all_are_there() -> None:
    assert sorted(drillctl.__all__) == sorted(PUBLIC)
    for name, module in PUBLIC.items():
        found = getattr(drillctl, name)
        assert found is getattr(import_module(f"drillctl.api.{module}"), name)
        assert found.__doc__
    with pytest.raises(AttributeError, match="no attribute 'runn'"):
        drillctl.runn  # noqa: B018  # type: ignore[attr-defined]


@pytest.mark.parametrize("module", MODULES)
def test_examples_in_docstrings_run(module: str) -> None:
    found = doctest.testmod(import_module(f"drillctl.api.{module}"))
    assert found.failed == 0


def test_import_loads_nothing_but_itself() -> None:
    ask = "import sys; old = set(sys.modules); import drillctl; print(*sorted(set(sys.modules) - old))"
    done = subprocess.run([sys.executable, "-I", "-c", ask], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.split() == ["drillctl"]


def test_arrays_have_a_value_a_tick_and_agree_with_each_other() -> None:
    run = drillctl.run(["KMD_GOTOdXdY 30 -12", "KMD_CZEKAJ 5"])
    assert run.fault is None and len(run.time_s) == run.ticks
    positions, columns, wires = run.positions("x"), run.columns("x"), run.wires("x")
    assert positions.shape == columns.shape == run.states("x").shape == (run.ticks,)
    assert (positions[0], positions[-1], run.positions("y")[-1]) == (0, 30, -12)
    steps = np.diff(positions)
    assert steps.sum() == 30 and set(steps) == {0, 1}
    assert np.array_equal(np.flatnonzero(steps), np.flatnonzero(np.diff(columns) % 12))
    assert wires.shape == (run.ticks, len(run.wire_names("x")))
    on = [name for name, is_on in zip(run.wire_names("x"), wires[6], strict=True) if is_on]
    assert on == ["1a", "2a", "24a"]  # the first column, put out in the seventh tick (paper, table 1)


def test_holes_of_a_board_are_where_they_were_wanted() -> None:
    run = drillctl.run(BOARD, order="nearest")
    assert len(run.holes) == run.outcome.holes_total == run.outcome.holes_done
    wanted = {tuple(place) for place in drillctl.inspect(BOARD).hole_xy_mm.round(6).tolist()}
    made = {(round(float(hole["wanted_x_mm"]), 6), round(float(hole["wanted_y_mm"]), 6)) for hole in run.holes}
    assert made <= wanted and 0 <= run.holes["error_mm"].max() < 0.05
    assert drillctl.estimate(BOARD, order="nearest").ticks == run.ticks
    html = run._repr_html_()
    assert html.count("<circle") >= len(run.holes) and "blinker.drl" in html


def test_a_broken_table_in_memory_loses_steps_and_the_file_is_as_it_was() -> None:
    changes = {"phase.two-phase-forced.wire.24a.pattern": "............",
               "phase.two-phase-forced.wire.24b.pattern": "............"}  # fmt: skip
    whole = drillctl.run("KMD_GOTOdXdY 600 0", plant="dynamic")
    weak = drillctl.run("KMD_GOTOdXdY 600 0", drillctl.load_machine(changes=changes), plant="dynamic")
    assert whole.lost_steps["x"] == 0 and abs(weak.lost_steps["x"]) >= 12
    assert abs(weak.lag("x")[-1]) >= 4 > abs(whole.lag("x")[-1])
    assert weak.currents("x").shape == (weak.ticks, 4) and weak.currents("x").max() < whole.currents("x").max()
    assert drillctl.load_machine().digest == whole.machine.digest != weak.machine.digest


def test_a_run_is_kept_and_replayed(tmp_path: Path) -> None:
    run = drillctl.run("KMD_GOTOdXdY 30 -12")
    for name in ("run.trace", "run.seg"):
        run.save(tmp_path / name)
        verdict = drillctl.replay_trace(tmp_path / name)
        assert not verdict.failed(True)
    run.save(tmp_path / "run.vcd")
    assert "$enddefinitions" in (tmp_path / "run.vcd").read_text()


def test_a_sweep_is_a_record_a_machine() -> None:
    rows = drillctl.sweep(hz=(300, 900), steps=(40,), vary={"coulomb_nm": (0.5, 1)})
    assert rows["tick_hz"].tolist() == [300, 300, 900, 900]
    assert rows["lost"].tolist()[:2] == [0, 0] and all(rows["lost"][2:] > 0)
    assert set(rows["phase"]) == {"two-phase-forced"}


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: drillctl.run(["KMD_GOTOdXdY 30"]), "commands:1"),
        (lambda: drillctl.run(["KMD_KONIEC"], "nope"), "no machine of this name"),
        (lambda: drillctl.run(["KMD_KONIEC"], plant="real"), "ideal, dynamic"),
        (lambda: drillctl.run(["KMD_KONIEC"], faults={"blunt": 20}), "only the dynamic plant"),
        (lambda: drillctl.run(["KMD_KONIEC"], order="nearest"), "can't be placed and ordered"),
        (lambda: drillctl.run(BOARD, rotat=90), "rotat"),
        (lambda: drillctl.run(["KMD_KONIEC"], tick_hz=0), "tick_hz 0"),
        (lambda: drillctl.load_machine(changes={"axis.q.range": [0, 1]}), "there is no axis.q.range in it"),
        (lambda: drillctl.load_machine(changes={"phase.nope.wire.1a.pattern": "x"}), "there is no phase table"),
        (lambda: drillctl.load_machine(changes={"axis.x.range": "far"}), "expected array"),
        (lambda: drillctl.run(["KMD_KONIEC"]).positions("q"), "there are x, y, z"),
        (lambda: drillctl.run(["KMD_KONIEC"], trace=False).positions("x"), "trace=False"),
    ],
)
def test_what_is_wrong_is_said_in_a_sentence(call: object, words: str) -> None:
    with pytest.raises(drillctl.Refused) as refused:
        call()  # type: ignore[operator]
    assert words in str(refused.value)


def test_a_missing_file_is_an_os_error() -> None:
    with pytest.raises(FileNotFoundError):
        drillctl.run("nope.drl")


def test_runs_in_a_thread_too() -> None:
    ticks: list[int] = []
    thread = threading.Thread(target=lambda: ticks.append(drillctl.run("KMD_GOTOdXdY 30 0").ticks))
    thread.start()
    thread.join(60)
    assert ticks == [drillctl.estimate("KMD_GOTOdXdY 30 0").ticks]


def test_ctrl_c_reaches_the_script_when_the_machine_stands(monkeypatch: pytest.MonkeyPatch) -> None:
    def pressed(progress: Progress) -> None:
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("drillctl.api.runs._unwatched", pressed)
    with pytest.raises(KeyboardInterrupt):
        drillctl.run("KMD_GOTOdXdY 30 0")
    own: list[int] = []
    with caught(lambda number, frame: own.append(number)):
        assert drillctl.run("KMD_GOTOdXdY 30 0").outcome.interrupted
    assert own and set(own) == {signal.SIGINT}


def test_a_script_ends_soundly_where_memory_is_checked() -> None:
    """Python's checks of its memory find what a compiled library frees wrongly; else it ends a script at times."""
    script = f"import drillctl; drillctl.run({str(BOARD)!r}, order='nearest', align=[(0, 0, 0, 0), (9, 0, 9, 0)])"
    done = subprocess.run([sys.executable, "-X", "dev", "-c", script], capture_output=True, check=False, timeout=100)
    assert (done.returncode, done.stderr[:200]) == (0, b"")


def test_the_script_of_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (BOARD.parent.parent / "docs" / "API.md").read_text("utf-8")
    script = page.split("```python\n")[1].split("```")[0]
    assert len([line for line in script.splitlines() if line]) <= 15
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    found: dict[str, object] = {}
    exec(compile(script, "docs/API.md", "exec"), found)
    lost = found["lost"]
    assert isinstance(lost, list) and lost[0] == 0 < lost[-1] and (tmp_path / "lost.png").is_file()
