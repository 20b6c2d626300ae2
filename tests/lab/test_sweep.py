"""Sweeps: the same bytes on any number of processes, gone on with where they were, refused where they can't be."""

import csv
import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from drillctl.cli import main
from drillctl.cli.number_lists import numbers, whole_numbers
from drillctl.lab.answers import answer, chunk_size, chunks
from drillctl.lab.errors import LabError
from drillctl.lab.question import PARAMETERS, SPREAD, Question
from drillctl.lab.sweep import Results, WorkerPool, sweep
from drillctl.lab.sweep_picture import losing, sweep_picture
from drillctl.lab.tables import axis_of, phases, ramps
from drillctl.machine import Library, shipped_tables
from drillctl.viewmodel.reports import HeatMap

LIBRARY = Library((shipped_tables(),))
LAB = LIBRARY.machine("pcb-drill-ramp-lab")
AXIS = axis_of(LAB, None)
ASKED = Question(
    AXIS,
    (300, 640),
    ramps("seven-state,direct-start", AXIS, LIBRARY),
    phases("two-phase-forced,forcing removed", AXIS, LIBRARY),
    (("coulomb_nm", (0.5, 1.0, 2.0)), ("inertia_kgm2", (1.0, 1.1))),
    (0.0, 0.001),
    (2, 9),
    draws=2,
    spread=0.02,
    seed=3,
)
SOUND = ("two-phase-forced", "seven-state", "300")


def answered(question: Question, path: Path, crew: WorkerPool | None = None) -> bytes:
    """The whole file, gone on with where it has been begun."""
    with Results(path, question) as results:
        done = [*sweep(question, results, crew or WorkerPool())]
    assert done == sorted(set(done)) and done[-1:] in ([], [question.machines])
    return path.read_bytes()


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The answer to ASKED, in one process and one go."""
    return answered(ASKED, tmp_path_factory.mktemp("whole") / "r.csv")


def table(content: bytes) -> list[dict[str, str]]:
    return [*csv.DictReader(io.StringIO(content.decode()))]


def test_a_row_is_a_machine_in_its_order(whole: bytes) -> None:
    rows = table(whole)
    assert len(rows) == ASKED.machines == 2 * 2 * 2 * 3 * 2 * 2 * 2
    assert [(row["phase"], row["ramp"], row["tick_hz"], row["draw"]) for row in rows[:2]] == [
        ("two-phase-forced", "seven-state", "300", "0"), ("two-phase-forced", "seven-state", "300", "1"),
    ]  # fmt: skip
    for number, row in enumerate(rows):
        variant = ASKED.variant(number)
        assert float(row["coulomb_nm"]) == variant.dynamics.coulomb_nm
        assert (row["phase"], int(row["tick_hz"]), float(row["load_nm"])) == (
            variant.phase, variant.tick_hz, variant.load_nm,
        )  # fmt: skip


def test_any_reader_of_tables_takes_the_file_as_it_is(whole: bytes, tmp_path: Path) -> None:
    file = tmp_path / "r.csv"
    file.write_bytes(whole)
    found = np.genfromtxt(file, delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert found.shape == (ASKED.machines,) and set(found["tick_hz"].tolist()) == {300, 640}
    assert set(found["question"].tolist()) == {f"sweep2-{ASKED.digest}"} and found["lost"].dtype.kind == "i"


def test_it_finds_what_loses_steps(whole: bytes) -> None:
    """Sound tables with the friction that there is lose nothing at 300 Hz; without forcing 640 Hz loses everywhere."""
    own = {repr(ASKED.variant(number).dynamics.coulomb_nm) for number in range(8, 16)}
    sound = [row for row in table(whole) if (row["phase"], row["ramp"], row["tick_hz"]) == SOUND]
    sound = [row for row in sound if row["coulomb_nm"] in own]
    assert len(sound) == 8
    bad = [row for row in table(whole) if (row["phase"], row["tick_hz"]) == ("forcing removed", "640")]
    assert {row["lost"] for row in sound} == {"0"} and max(float(row["worst_full_steps"]) for row in sound) < 1
    assert "0" not in {row["lost"] for row in bad} and min(float(row["worst_full_steps"]) for row in bad) >= 1


def test_two_processes_give_the_same_bytes(whole: bytes, tmp_path: Path) -> None:
    assert len(chunks(ASKED)) > 1
    assert answered(ASKED, tmp_path / "r.csv", WorkerPool(workers=2)) == whole


def test_an_interrupted_sweep_goes_on(whole: bytes, tmp_path: Path) -> None:
    """At the end of a chunk, within one, within a line: always to the same bytes."""
    file, lines = tmp_path / "r.csv", whole.splitlines(keepends=True)
    last = len(lines) - ASKED.machines % chunk_size(ASKED)
    for begun in (lines[:last], lines[: last - 3], [*lines[:-2], lines[-2][:9]]):
        file.write_bytes(b"".join(begun))
        assert answered(ASKED, file) == whole


def test_chunks_are_the_same_wherever_one_goes_on() -> None:
    """A fleet's moves rest until its longest has ended: so its company is part of the answer."""
    all_of_them, size = chunks(ASKED), chunk_size(ASKED)
    assert [number for chunk in all_of_them for number in chunk] == [*range(ASKED.machines)]
    for begin in (0, 1, size - 1, size, ASKED.machines - 1):
        assert chunks(ASKED, begin) == all_of_them[begin // size :]


def test_one_interrupted_in_its_first_lines_begins_anew(tmp_path: Path) -> None:
    small = replace(ASKED, rates_hz=(640,), ramps=ASKED.ramps[:1], phases=ASKED.phases[:1], times=(), draws=1)
    file = tmp_path / "r.csv"
    complete = answered(small, file)
    for cut in (0, 20, len(complete.splitlines()[0]), len(complete.splitlines()[0]) + 9):
        file.write_bytes(complete[:cut])
        assert answered(small, file) == complete


def test_what_is_done_is_not_tried_again(whole: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "r.csv"
    file.write_bytes(whole)
    monkeypatch.setattr("drillctl.lab.workers.answer", lambda question, chunk: pytest.fail("tried again"))
    with Results(file, replace(ASKED)) as results:
        assert results.rows == ASKED.machines and [*sweep(ASKED, results, WorkerPool())] == []


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"# drillctl-sweep 1 0123456789abcdef\nphase\n", "is of an earlier version, .* a table without that line"),
        (b"phase,ramp,tick_hz,load_nm,draw,moves,lost,worst_full_steps,question\n", "another question"),
        (b"tool,x\n1,2\n", "no results file"),
        (b"#\n", "no results file"),
        (b"HEAD\nshort,row\n", r"r.csv:2: not a row"),
        (b"HEAD\n1,2,3,4,5,6,7,8,9,sweep2-0123456789abcdef\n", "another question"),
        (b"HEAD\nFIRST\n1,2,3,4,5,6,7,8,9,sweep2-0123456789abcdef\n", r"r.csv:3: not a row"),
    ],
)
def test_what_is_no_part_of_this_answer_is_left_alone(
    content: bytes, reason: str, whole: bytes, tmp_path: Path
) -> None:
    file = tmp_path / "r.csv"
    head, first, *_ = whole.split(b"\n")
    file.write_bytes(content.replace(b"HEAD", head).replace(b"FIRST", first))
    before = file.read_bytes()
    with pytest.raises(LabError, match=reason):
        Results(file, ASKED)
    assert file.read_bytes() == before


def test_two_sweeps_do_not_write_one_file(tmp_path: Path) -> None:
    with Results(tmp_path / "r.csv", ASKED), pytest.raises(LabError, match="another sweep"):
        Results(tmp_path / "r.csv", ASKED)


@pytest.mark.parametrize("name", ["rates_hz", "loads_nm", "steps", "spread", "seed", "draws", "axis"])
def test_every_part_of_a_question_is_in_its_digest(name: str) -> None:
    assert AXIS.dynamics is not None
    other_axis = replace(AXIS, dynamics=replace(AXIS.dynamics, detent_nm=0.003))
    others = {
        "axis": other_axis, "rates_hz": (300,), "loads_nm": (0.1,), "steps": (2,), "spread": 0.1, "seed": 4, "draws": 3,
    }  # fmt: skip
    assert replace(ASKED, **{name: others[name]}).digest != ASKED.digest


def test_draws_are_within_their_spread_and_alike_over_the_grid() -> None:
    first, elsewhere = ASKED.variant(0), ASKED.variant(2)
    assert AXIS.dynamics is not None and (first.draw, elsewhere.draw, elsewhere.load_nm) == (0, 0, 0.001)
    assert first.dynamics == elsewhere.dynamics
    for name in SPREAD:
        own = getattr(AXIS.dynamics, name) * (0.5 if name == "coulomb_nm" else 1)
        assert 0 < abs(getattr(first.dynamics, name) / own - 1) <= 0.02
    assert ASKED.variant(1).dynamics.resistance_ohm != first.dynamics.resistance_ohm


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"times": (("colour", (1.0,)),)}, "no parameter 'colour'; there are normal_volts"),
        ({"times": (("coulomb_nm", (1.0,)),) * 2}, "varied twice"),
        ({"draws": 100_000, "loads_nm": tuple(range(100))}, "at most"),
        ({"axis": LIBRARY.machine("mega-28byj48").axes[0]}, "no dynamics"),
        ({"axis": LIBRARY.machine("eight-axis").axes[0]}, "take unipolar motors; .* is a drive motor's"),
        ({"phases": (("other", LIBRARY.machine("cnc-shield").axes[0].phase),)}, "has the wires"),
    ],
)
def test_a_question_that_can_not_be_tried_is_refused(change: dict[str, object], reason: str) -> None:
    with pytest.raises(LabError, match=reason):
        replace(ASKED, **change)


def test_a_table_that_holds_no_rotor_is_refused_when_it_is_tried() -> None:
    off = replace(AXIS.phase, wires=tuple(replace(wire, forward=(False,) * 12) for wire in AXIS.phase.wires))
    with pytest.raises(LabError, match="holds no rotor"):
        answer(replace(ASKED, phases=(("off", off),)), range(1))


def test_every_parameter_can_be_varied() -> None:
    assert {"coulomb_nm", "viscous_nms", "forcing_volts", "detent_nm"} < set(PARAMETERS) and "name" not in PARAMETERS
    for name in PARAMETERS:
        asked = replace(ASKED, times=((name, (1.25,)),), spread=0.0)
        assert getattr(asked.variant(0).dynamics, name) == getattr(AXIS.dynamics, name) * 1.25


def test_the_picture_has_a_line_for_each_pair_of_tables(whole: bytes, tmp_path: Path) -> None:
    (tmp_path / "r.csv").write_bytes(whole)
    lost = losing(tmp_path / "r.csv", ASKED)
    picture = sweep_picture(ASKED, lost, "a-machine")
    curves = picture.charts[0].curves
    assert picture.charts[0].x_label == "times coulomb_nm" and curves[0].x.tolist() == [0.5, 1, 2]
    assert len(curves) == 8 and curves[0].label == "phase two-phase-forced, ramp seven-state, tick_hz 300"
    rows = table(whole)
    last = ("forcing removed", "direct-start", "640")
    unforced = [row["lost"] != "0" for row in rows if (row["phase"], row["ramp"], row["tick_hz"]) == last]
    assert curves[-1].y.mean() == pytest.approx(100 * np.mean(unforced))
    assert lost.sum() == sum(row["lost"] != "0" for row in rows)
    assert picture.notes[1] == "each point is the mean over all values of times inertia_kgm2, load_nm, draw"
    assert picture.title.startswith("a-machine, axis x") and ASKED.digest in picture.notes[-1]


def test_on_demand_the_two_longest_factors_are_a_heat_map(whole: bytes, tmp_path: Path) -> None:
    (tmp_path / "r.csv").write_bytes(whole)
    lost = losing(tmp_path / "r.csv", ASKED)
    (heat,) = sweep_picture(ASKED, lost, "a-machine", heat=True).charts
    assert isinstance(heat, HeatMap) and heat.columns == ("0.5", "1", "2")
    assert (heat.x_label, heat.y_label) == ("times coulomb_nm", "phase") and heat.share.shape == (2, 3)
    forced = [row["lost"] != "0" for row in table(whole) if row["phase"] == "two-phase-forced"]
    assert heat.share[0].mean() == pytest.approx(np.mean(forced))


@pytest.mark.parametrize(
    ("text", "found"),
    [("1", (1,)), ("3,1,2", (3, 1, 2)), ("0.1:0.4:0.1", (0.1, 0.2, 0.3, 0.4)), ("1:2:0.4,5", (1, 1.4, 1.8, 5))],
)
def test_lists_and_ranges(text: str, found: tuple[float, ...]) -> None:
    assert numbers(text, "values", 0, 10) == found


NO_LISTS = ["", "1:2", "2:1:1", "1:2:0", "x", "1,,2", "nan", "1:inf:1", "0:10:1e-9", "11", "1,1.0"]


@pytest.mark.parametrize("text", NO_LISTS)
def test_what_is_no_list_of_numbers(text: str) -> None:
    with pytest.raises(LabError, match="values"):
        numbers(text, "values", 0, 10)


def test_whole_numbers_are_whole() -> None:
    with pytest.raises(LabError, match=r"1\.5 is no whole number"):
        whole_numbers("1,1.5", "values", 0, 10)


def test_the_verb(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Twice: the second time nothing is left to do."""
    call = ["sweep", "--machine", "pcb-drill", "--hz", "700", "--steps", "5", "--ramp", "direct-start"]
    out = tmp_path / "r.csv"
    for _ in range(2):
        assert main([*call, "--phase", "broken", "--workers", "1", "--out", str(out)]) == 0
    told = capsys.readouterr()
    assert len(table(out.read_bytes())) == 10 and "10 of 10 machines are done" in told.err
    assert "machines that lose steps, %" in told.out


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (("--ramp", "steep"), "no ramp is named 'steep'; there are"),
        (("--phase", "odd"), "no phase table is named 'odd'; there are"),
        (("--ramp", "seven-state,seven-state"), "a name twice"),
        (("--hz", "20"), "--hz 20 is outside 50 to 20000"),
        (("--vary", "coulomb_nm"), "is no list of numbers"),
        (("--axis", "w"), "no axis 'w'"),
        (("--spread", "2"), "not a number from 0 to 0.5"),
    ],
)
def test_the_verb_refuses(
    options: tuple[str, ...], reason: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    call = ["sweep", "--out", str(tmp_path / "r.csv"), *options]
    try:
        code = main(call)
    except SystemExit as left:
        assert isinstance(left.code, int)
        code = left.code
    assert code == 2 and reason in capsys.readouterr().err and not (tmp_path / "r.csv").exists()


@pytest.mark.long
def test_a_cluster_of_two_workers_gives_the_same_bytes(whole: bytes, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="dask is an extra: pip install '.[cluster]'")
    pytest.importorskip("joblib")
    settings = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None, "local_directory": str(tmp_path)}
    with distributed.LocalCluster(**settings) as cluster:
        crew = WorkerPool(cluster=cluster.scheduler_address)
        assert answered(ASKED, tmp_path / "r.csv", crew) == whole


def test_nobody_at_the_cluster_s_address_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed", reason="dask is an extra: pip install '.[cluster]'")
    monkeypatch.setattr("drillctl.lab.workers.CONNECT_S", 0.5)
    with pytest.raises(LabError, match="no dask scheduler answers there"):
        answered(ASKED, tmp_path / "r.csv", WorkerPool(cluster="tcp://127.0.0.1:9"))


def test_an_answer_is_the_same_alone_and_in_its_chunk(whole: bytes) -> None:
    """Machines of a fleet don't touch each other."""
    rows = whole.decode().splitlines()[1:]
    for number in (0, 50, ASKED.machines - 1):
        assert answer(ASKED, range(number, number + 1)) == [rows[number]]
