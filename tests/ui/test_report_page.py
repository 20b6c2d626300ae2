"""The page of a run: what a browser shows, what is escaped, both languages; and in a real browser, wide and narrow."""

import html.parser
import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from drillctl.api import load
from drillctl.cli import main
from drillctl.lab.run_report import run_report
from drillctl.language import words
from drillctl.machine import Library
from drillctl.ui.report.page import report_page
from drillctl.viewmodel.run_report import RunReport

ROOT = Path(__file__).resolve().parent.parent.parent
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
QUEUE = "KMD_GOTOdXdY 30 -12\nKMD_WIERTLO_GORA\n"


@pytest.fixture(scope="module")
def traces(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("runs")
    run = load("run")
    run(ROOT / "examples" / "blinker.drl", skip_tools=(1, 3)).save(folder / "ideal.trace")
    run(ROOT / "examples" / "blinker.drl", skip_tools=(1, 3), plant="dynamic", seed=1).save(folder / "dynamic.trace")
    run(ROOT / "examples" / "blinker.drl", plant="dynamic", tick_hz=640).save(folder / "faulty.trace")
    return folder


@pytest.fixture(scope="module")
def dynamic(traces: Path) -> RunReport:
    return run_report(traces / "dynamic.trace", Library.standard())


class Page(html.parser.HTMLParser):
    """Counts elements and collects texts and what would be fetched; unclosed elements are a fault."""

    VOID = ("meta", "circle", "path")

    def __init__(self, page: str):
        super().__init__()
        self.open: list[str] = []
        self.count: dict[str, int] = {}
        self.fetched: list[str] = []
        self.words: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.count[tag] = self.count.get(tag, 0) + 1
        self.fetched += [value for name, value in attrs if name in ("src", "href") and value]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag not in self.VOID:
            assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words.append(data)


def test_the_page_is_whole_and_fetches_nothing(dynamic: RunReport) -> None:
    page = Page(report_page([dynamic]))
    assert not page.open and not page.fetched
    assert page.count["circle"] == len(dynamic.holes.made_mm)
    assert page.count["canvas"] == 1 and page.count["svg"] == 1 + 2 * len(dynamic.axes)
    text = " ".join(page.words)
    assert "The run ended without a fault" in text and "lost steps" in text


def test_the_figures_are_those_of_the_run(traces: Path, dynamic: RunReport) -> None:
    made = load("run")(ROOT / "examples" / "blinker.drl", skip_tools=(1, 3), plant="dynamic", seed=1)
    assert dynamic.ticks == made.ticks and {axis.name: axis.lost_steps for axis in dynamic.axes} == made.lost_steps
    assert len(dynamic.holes.made_mm) == len(made.holes)
    between = made.holes[["made_x_mm", "made_y_mm"]].tolist()
    steps = np.diff(np.array(between), axis=0)
    assert np.allclose(steps, np.diff(dynamic.holes.made_mm, axis=0), atol=1e-6)
    for axis in dynamic.axes:
        assert np.abs(axis.lag_steps).max() < 4
        assert 9 < axis.speed_mm_s.max() < 11  # full speed: a column a tick


@pytest.mark.parametrize(("sheet", "axis"), [("01-phase-sequences", "paper"), ("02-forcing", "x")])
def test_a_bench_that_positions_no_board_has_a_page(sheet: str, axis: str, tmp_path: Path) -> None:
    tables = ROOT / "docs" / "lab" / sheet / "drillctl" / "tables"
    (machine,) = (tables / "machines").iterdir()
    load("run")(f"KMD_RUCHd {axis}=9", str(machine)).save(tmp_path / "bench.trace")
    report = run_report(tmp_path / "bench.trace", Library.standard(tables))
    assert f"KMD_RUCHd {axis}=9" in report_page([report], "en")


def test_a_run_of_several_tick_rates_has_no_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every time on it would be wrong; plot refuses it too."""
    load("run")(QUEUE).save(tmp_path / "plain.trace")
    plain = (tmp_path / "plain.trace").read_text("utf-8")
    declared = plain.replace("signal fault >\n", "signal fault >\nsignal pace <\n")
    (tmp_path / "paced.trace").write_text(declared.replace("0 fault -", "0 fault -\n0 pace 580"))
    assert main(["report", str(tmp_path / "paced.trace"), "-o", str(tmp_path / "x.html")]) == 2
    assert "the tick rate was changed on the way (PACE)" in capsys.readouterr().err


def test_waves_are_unfolded_to_the_changes_of_the_run(dynamic: RunReport) -> None:
    data = json.loads(re.findall(r'<script type="application/json">(.*?)</script>', report_page([dynamic]))[0])
    assert [wave["name"] for wave in data["waves"]] == [wave.name for wave in dynamic.waves]
    for drawn, wave in zip(data["waves"], dynamic.waves, strict=True):
        assert np.array_equal(np.cumsum(drawn["ticks"]), wave.ticks)
        values = np.cumsum(drawn["values"]) if "values" in drawn else (drawn["first"] + np.arange(len(wave.ticks))) % 2
        assert np.array_equal(values, wave.values)


def test_a_fault_is_told_with_its_cause_and_what_to_do(traces: Path) -> None:
    report = run_report(traces / "faulty.trace", Library.standard())
    text = " ".join(Page(report_page([report])).words)
    assert report.fault is not None and report.fault[0] in text and "What to do" in text
    assert any("fault" in str(event.words) for event in report.events)


def test_polish(dynamic: RunReport) -> None:
    try:
        words.use("pl")
        page = report_page([dynamic], "pl")
    finally:
        words.use("en")
    assert '<html lang="pl">' in page and "zgubione kroki" in page and "lost steps" not in page


def test_names_from_outside_are_escaped(dynamic: RunReport) -> None:
    evil = "<script>alert(1)</script>\u202e"
    page = report_page([replace(dynamic, name=evil, description=evil, plant=evil)])
    assert "alert(1)</script>" not in page and "\u202e" not in page


def test_the_verb_writes_a_page_and_tells_where_two_runs_part(traces: Path, tmp_path: Path) -> None:
    ideal, dynamic, out = traces / "ideal.trace", traces / "dynamic.trace", tmp_path / "run.html"
    assert main(["report", str(ideal), "-o", str(out)]) == 0
    one = out.read_text("utf-8")
    assert main(["report", str(ideal), "-o", str(out)]) == 0 and out.read_text("utf-8") == one
    assert main(["report", str(ideal), str(ideal), "-o", str(out)]) == 0
    assert "The two runs are the same to the end" in out.read_text("utf-8")
    assert main(["report", str(ideal), str(dynamic), "-o", str(out)]) == 1
    assert re.search(r"The two runs part at tick \d+", out.read_text("utf-8"))


def test_wrong_input_writes_no_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "no.trace").write_text("nothing\n")
    for run, out in (("no.trace", "a.html"), ("missing.trace", "a.html"), ("no.trace", "a.pdf")):
        assert main(["report", str(tmp_path / run), "-o", str(tmp_path / out)]) == 2
        assert "drillctl:" in capsys.readouterr().err
    assert sorted(file.name for file in tmp_path.iterdir()) == ["no.trace"]


@pytest.mark.skipif(BROWSER is None, reason="no chromium here (.ci/run installs it)")
@pytest.mark.parametrize("width", [1200, 390])
def test_a_browser_draws_it_and_nothing_is_wider_than_the_page(dynamic: RunReport, tmp_path: Path, width: int) -> None:
    check = (
        "<script>addEventListener('load', () => setTimeout(() => { const c = document.querySelector('canvas');"
        "document.querySelector('[data-do=in]').click();"
        "const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
        "document.title = JSON.stringify([document.documentElement.scrollWidth, innerWidth,"
        "d.some(v => v > 0), document.querySelector('output').textContent]); }, 50));</script></body>"
    )
    page = tmp_path / "run.html"
    page.write_text(report_page([dynamic]).replace("</body>", check), "utf-8")
    command = [
        str(BROWSER), "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}",
        f"--window-size={width},900", "--virtual-time-budget=4000", "--dump-dom", page.as_uri(),
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=110, check=True)
    found = re.search(r"<title>(.*?)</title>", done.stdout)
    assert found
    wide, inner, drawn, told = json.loads(html.unescape(found[1]))
    assert wide <= inner and drawn
    assert told.endswith(f"{round(dynamic.waves_to / 2)} ticks")
