"""Boards drilled by many machines: the rows are those of single runs, go on where they were, and tell what is lost."""

import csv
import io
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

from drillctl.cli import main
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.lab.answers import answer
from drillctl.lab.board import Board
from drillctl.lab.question import Question
from drillctl.lab.sweep import Results, WorkerPool, sweep
from drillctl.lab.sweep_picture import losing, sweep_picture
from drillctl.lab.tables import axis_of, phases, ramps
from drillctl.lab.tune_board import board_lines, tune_board
from drillctl.machine import Library, shipped_tables
from drillctl.plant import IDEAL_PLANT
from drillctl.ticker.program_run import run_program
from drillctl.ui.terminal.charts import ChartLook, picture_lines
from drillctl.ui.terminal.heat import heat_lines
from drillctl.ui.terminal.image_file import picture_bytes
from drillctl.viewmodel.reports import HeatMap

LIBRARY = Library((shipped_tables(),))
LAB = LIBRARY.machine("pcb-drill-ramp-lab")
DRILL_FILE = "M48\nMETRIC\nT1C0.800\n%\nT1\nX0.0Y0.0\nX4.0Y3.0\nX0.5Y3.0\nM30\n"
RATES_HZ = (300, 500)


@pytest.fixture(scope="module")
def board_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("board") / "three.drl"
    file.write_text(DRILL_FILE)
    return file


@pytest.fixture(scope="module")
def board(board_file: Path) -> Board:
    programs = {hz: load_job(board_file, LAB.at_rate(hz), JobSetup(LAB.name)).program for hz in RATES_HZ}
    return Board.of("three.drl", LAB, (0, 1), programs)


@pytest.fixture(scope="module")
def asked(board: Board) -> Question:
    axis = axis_of(LAB, None)
    wrong = phases("two-phase-forced,forcing removed", axis, LIBRARY)
    return Question(axis, RATES_HZ, ramps("direct-start", axis, LIBRARY), wrong, (), (0.0,), (), board=board)


def answered(question: Question, path: Path) -> bytes:
    with Results(path, question) as results:
        assert [*sweep(question, results, WorkerPool())][-1:] in ([], [question.machines])
    return path.read_bytes()


def test_a_row_is_what_the_machine_does_in_a_run(
    asked: Question, board_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Slow and with sound tables nothing is lost; without a ramp at 500 Hz steps are; and the machine as it is takes
    the ticks of `run`.
    """
    content = answered(asked, tmp_path / "s.csv")
    rows = [*csv.DictReader(io.StringIO(content.decode()))]
    assert [(row["phase"], row["tick_hz"]) for row in rows] == [
        (name, str(hz)) for name, _ in asked.phases for hz in RATES_HZ
    ]
    assert {row["ramp"] for row in rows} == {"direct-start"}
    slow = rows[0]
    assert (slow["holes"], slow["lost"], slow["lost_steps"], slow["fault"]) == ("3", "0", "0", "")
    assert float(slow["worst_mm"]) < 0.1
    assert (rows[-1]["phase"], rows[-1]["lost"]) == ("forcing removed", "1")
    words = ["--machine", LAB.name, "--plant", "dynamic", "--tick-hz", "300", "--json"]
    assert main(["run", str(board_file), *words]) == 0
    told = json.loads(capsys.readouterr().out)
    assert asked.board is not None
    own = asked.board.drilled(LAB.at_rate(300), 0)
    assert (own.ticks, own.lost_steps, own.holes) == (told["ticks"], 0, told["holes_done"])


def test_an_interrupted_sweep_of_boards_goes_on_to_the_same_bytes(asked: Question, tmp_path: Path) -> None:
    """After a whole row and in the midst of one; and a process that was sent the question gives the same rows."""
    whole = answered(asked, tmp_path / "whole.csv")
    lines = whole.splitlines(keepends=True)
    begun = tmp_path / "begun.csv"
    begun.write_bytes(b"".join(lines[:4]) + lines[4][:7])
    assert answered(asked, begun) == whole
    sent = pickle.loads(pickle.dumps(asked))
    assert sent.digest == asked.digest and answer(sent, range(1)) == [lines[1].decode().rstrip()]


def test_another_board_is_another_question(asked: Question, board: Board, tmp_path: Path) -> None:
    moved = {hz: program.copy() for hz, program in board.programs.items()}
    goto = np.flatnonzero(moved[300]["args"][:, 0] != 0)[0]
    moved[300]["args"][goto, 0] += 1
    assert Board.of("three.drl", LAB, (0, 1), moved).digest != board.digest
    assert Board.of("three.drl", LAB, (0,), board.programs).digest != board.digest


def test_the_picture_of_a_board_is_a_heat_map(asked: Question, tmp_path: Path) -> None:
    answered(asked, tmp_path / "s.csv")
    picture = sweep_picture(asked, losing(tmp_path / "s.csv", asked), LAB.name)
    (heat,) = picture.charts
    assert isinstance(heat, HeatMap)
    assert (heat.columns, heat.rows) == (("300", "500"), ("two-phase-forced", "forcing removed"))
    lines = picture_lines(picture, ChartLook(60, 10))
    assert "  forcing removed ···███" in lines and " two-phase-forced ···███" in lines, lines
    assert picture_bytes(picture, "svg") == picture_bytes(picture, "svg")


def test_nothing_and_all_have_signs_of_their_own_and_many_columns_show_their_worst() -> None:
    share = np.array([[0.0, 0.01, 0.34, 0.99, 1.0]])
    heat = HeatMap("lost", "hz", "ramp", ("1", "2", "3", "4", "5"), ("r",), share)
    assert heat_lines(heat, 30, plain=True)[2] == "    r ...---+++***###"
    crowded = HeatMap("lost", "hz", "ramp", heat.columns, ("r",), share[:, ::-1])
    assert heat_lines(crowded, 9, plain=True)[2] == "    r #+."


def test_tuning_for_a_board_takes_the_fastest_setting_that_loses_nothing(board: Board) -> None:
    direct = ramps("direct-start", axis_of(LAB, None), LIBRARY)
    told: list[str] = []
    tuned = tune_board(board, direct, 1.3, told.append)
    assert len(told) == tuned.losing and tuned.tried == len(RATES_HZ) * 2 and tuned.load >= 1.3
    heavy = dict.fromkeys(("inertia_kgm2", "viscous_nms", "coulomb_nm"), tuned.load)
    machine = board.on(tuned.setting.tick_hz, tuned.setting.ramp, None, heavy)
    assert board.drilled(machine, 0).sound
    ideal = run_program(board.programs[tuned.setting.tick_hz], machine, IDEAL_PLANT)
    assert tuned.setting.seconds == ideal.ticks / tuned.setting.tick_hz
    assert f"tick_hz = {tuned.setting.tick_hz}" in board_lines(tuned, board, 1.3)[0]


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["sweep", "--out", "s.csv", "--order", "nearest"], "name one by --board"),
        (["sweep", "--out", "s.csv", "--board", "BOARD", "--steps", "3"], "--steps: is for single moves"),
        (["sweep", "--out", "s.csv", "--board", "no.drl"], "no.drl: No such file"),
        (["sweep", "--out", "s.csv", "--board", "BOARD", "--offset", "9999,0"], "out of reach"),
        (["tune", "pcb-drill", "--hz", "500"], "--hz: only with --board"),
        (["tune", "pcb-drill", "--board", "BOARD", "--name", "n"], "--name: not with --board"),
    ],
)
def test_what_does_not_fit_is_refused(
    words: list[str], reason: str, board_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    assert main([str(board_file) if word == "BOARD" else word for word in words]) == 2
    assert reason in capsys.readouterr().err
    assert not any(tmp_path.iterdir())
