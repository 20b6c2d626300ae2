"""The board as drilled, as a picture: as many circles as holes, as wide as their drills, and a line for each error."""

import re
from pathlib import Path

import numpy as np
import pytest

from drillctl.cli import main
from drillctl.lab.errors import LabError
from drillctl.lab.hole_table import diameters, read_holes, with_diameters
from drillctl.lab.pictures import board_picture
from drillctl.ui.report.board_plan import board_figure
from drillctl.ui.terminal.charts import ChartLook, picture_lines
from drillctl.ui.terminal.image_file import picture_bytes
from drillctl.viewmodel.reports import BoardPlan

ROOT = Path(__file__).resolve().parents[2]
CIRCLE = re.compile(r'<circle class="hole t(\d)" cx="([\d.]+)" cy="([\d.]+)" r="([\d.]+)"')
PLAN = BoardPlan(
    np.array([[0.0, 0.0], [40.0, 0.0], [40.0, 20.0], [10.0, 5.0]]),
    np.array([[0.0, 0.0], [40.1, 0.0], [40.0, 20.05], [10.0, 5.0]]),
    np.array([1.0, 1.0, 3.0, np.nan]),
    np.array([1, 1, 7, 9]),
)


def test_errors_are_enlarged_by_a_round_number_that_keeps_them_short() -> None:
    assert PLAN.times == 20 and PLAN.error_mm.tolist() == pytest.approx([0, 0.1, 0.05, 0])
    assert PLAN.ends_mm.tolist()[1:3] == [pytest.approx([42.0, 0.0]), pytest.approx([40.0, 21.0])]
    assert BoardPlan(PLAN.sent_mm, PLAN.sent_mm, PLAN.diameter_mm, PLAN.tool).times == 1
    assert [(tool.number, tool.diameter_mm, tool.holes.tolist()) for tool in PLAN.tools] == [
        (1, 1.0, [0, 1]), (7, 3.0, [2]), (9, None, [3]),
    ]  # fmt: skip


def test_the_page_has_circles_to_scale_and_a_line_for_each_hole() -> None:
    page = board_figure(PLAN)
    circles = [(int(tool), *map(float, numbers)) for tool, *numbers in CIRCLE.findall(page)]
    assert [tool for tool, *_ in circles] == [0, 0, 1, 2]
    per_mm = (circles[1][1] - circles[0][1]) / 40.0
    assert [2 * radius / per_mm for *_, radius in circles] == pytest.approx([1.0, 1.0, 3.0, 0.8], rel=0.01)
    assert circles[1][2] - circles[2][2] == pytest.approx(20 * per_mm, abs=0.2)  # Y upwards
    (errors,) = re.findall(r'class="error" d="([^"]*)"', page)
    begun = re.findall(r"M([\d.]+) ([\d.]+)L([\d.]+) ([\d.]+)", errors)
    assert len(begun) == 4 and float(begun[1][2]) - float(begun[1][0]) == pytest.approx(2.0 * per_mm, abs=0.2)
    for words in ("T1, 1 mm: 2 holes", "T7, 3 mm: 1 hole", "T9, size not known: 1 hole", "20 times as long",
                  "42.0 x 22.0 mm", "x, mm", "y, mm"):  # fmt: skip
        assert words in page, words
    assert page.count('class="outline"') == 1 and "-0<" not in page


def test_without_holes_there_is_no_board() -> None:
    assert board_figure(BoardPlan(np.empty((0, 2)), np.empty((0, 2)), np.empty(0), np.empty(0, np.int64))) == ""


def test_one_hole_is_a_board_too() -> None:
    one = BoardPlan(PLAN.sent_mm[:1], PLAN.made_mm[:1], PLAN.diameter_mm[:1], PLAN.tool[:1])
    assert len(CIRCLE.findall(board_figure(one))) == 1 and "nan" not in board_figure(one)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_file_has_a_group_a_tool_and_one_of_errors(theme: str) -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is an extra: pip install '.[plot]'")
    svg = picture_bytes(board_picture("a board", PLAN), "svg", theme).decode()  # type: ignore[arg-type]
    groups = dict(re.findall(r'<g id="([\w-]+)">(.*?)\n   </g>', svg, re.DOTALL))
    counted = {name: len(re.findall("<path|<use", body.partition("</defs>")[2] or body)) for name, body in
               groups.items() if name.startswith(("tool-", "errors", "outline"))}  # fmt: skip
    assert counted == {"tool-1": 2, "tool-7": 1, "tool-9": 1, "errors": 4, "outline": 1}


def test_the_terminal_has_points_and_lines() -> None:
    lines = picture_lines(board_picture("a board", PLAN), ChartLook(80, 12, plain=True))
    assert any("off by, 20 times as long" in line for line in lines) and any("x, mm" in line for line in lines)


def test_a_holes_file_is_drawn_as_it_is_and_sizes_a_trace(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    holes, trace, page = tmp_path / "h.csv", tmp_path / "b.trace", tmp_path / "b.html"
    board = str(ROOT / "examples" / "blinker.drl")
    assert main(["run", board, "--plant", "dynamic", "--trace", str(trace), "--holes", str(holes), "-q"]) == 0
    plan = read_holes(holes)
    assert len(plan.tool) == 26 and diameters(plan) == {1: 0.8, 2: 1.0, 3: 3.2} and plan.error_mm.max() > 0
    assert with_diameters(PLAN, {1: 0.7}).drawn_mm.tolist() == [0.7, 0.7, 0.8, 0.8]
    assert main(["plot", str(holes)]) == 0 and "26 holes" in capsys.readouterr().out
    assert main(["report", str(trace), "--holes", str(holes), "-o", str(page)]) == 0
    text = page.read_text()
    assert [text.count(f'class="hole t{number}"') for number in range(4)] == [16, 6, 4, 0]
    assert "T3, 3.2 mm: 4 holes" in text


def test_a_stretch_is_chosen_by_seconds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trace, queue = tmp_path / "q.trace", tmp_path / "q.kmd"
    queue.write_text("KMD_GOTOdXdY 100 0\n")
    assert main(["run", str(queue), "--machine", "pcb-drill-ramp-lab", "--trace", str(trace), "-q"]) == 0
    told = []
    for window in (["--seconds", "0.1:0.4"], ["--from-tick", "50", "--to-tick", "200"]):
        capsys.readouterr()
        assert main(["plot", str(trace), "--what", "motion", *window]) == 0
        told.append(capsys.readouterr().out)
    assert told[0] == told[1] and "speed, mm/s" in told[0] and "lag, full steps" in told[0]
    assert main(["plot", str(trace), "--seconds", "0:1", "--to-tick", "3"]) == 2


@pytest.mark.parametrize(
    ("text", "told"),
    [("tool,x\n1,2\n", "h.csv:1: is no holes CSV: column diameter_mm"), ("", "h.csv:1: is no holes CSV"),
     ("HEAD\n", "no hole to be shown"), ("HEAD\n1,0.8,x,2,1,1,1,0\n", "h.csv:2: not a row"),
     ("HEAD\n1,0.8,1,2,1,1,1,0\n,0.8,1,2,1,1,1,0\n", "h.csv:3: a hole without tool"),
     ("HEAD\n1e99,0.8,1,2,1,1,1,0\n", "h.csv:2: a hole without"), ("HEAD\n1,-1,1,2,1,1,1,0\n", "of no width"),
     ("HEAD\n1,0.8,inf,2,1,1,1,0\n", "h.csv:2: a hole without"), ("HEAD\n1,\0,1,2,1,1,1,0\n", "h.csv:2: not a row"),
     ("HEAD\n" + "1" * 200_000 + ",0.8,1,2,1,1,1,0\n", "not a row")],
)  # fmt: skip
def test_what_is_no_holes_file_is_refused(text: str, told: str, tmp_path: Path) -> None:
    file = tmp_path / "h.csv"
    head = "tool,diameter_mm,x_mm,y_mm,number,wanted_x_mm,wanted_y_mm,error_mm"
    file.write_text(text.replace("HEAD", head))
    with pytest.raises(LabError, match=re.escape(told)):
        read_holes(file)


def test_a_holes_file_tells_nothing_of_motors(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(tmp_path / "h.csv"), "--what", "speed"]) == 2
    assert "needs a trace" in capsys.readouterr().err
