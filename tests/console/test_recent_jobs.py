"""The list of recent jobs: what was opened comes back, and no file in its place ever stops anything."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.console.recent_jobs import LARGEST_LIST_BYTES, MOST_RECENT, RecentJobs
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole, PanelOf
from drillctl.viewmodel.jobs import RecentJob

OPTIONS = JobOptions(
    format="inch,2:4,trailing", origin="file", mirror="x", rotate_deg=90.0, offset_mm=(1.5, -2.0), order="nearest",
    panel=PanelOf(2, 1, 40.0, 0.0), align=(MeasuredHole(1.0, 2.0, 3.0, 4.0),), peck_mm=0.5, spot_mm=0.2,
    skip_tools=(2, 3), drills="/drills.toml", after_end="drill",
)  # fmt: skip
OLDER = (  # as earlier versions wrote it
    '{"recent":[{"file":"/boards/a.drl","asked":{"format":"inch,2:4,trailing","origin":"file","mirror":"x",'
    '"rotate_deg":90.0,"offset_mm":[1.5,-2.0],"order":"nearest","panel":{"columns":2,"rows":1,"pitch_x_mm":40.0,'
    '"pitch_y_mm":0.0},"measured":[{"file_x_mm":1.0,"file_y_mm":2.0,"machine_x_mm":3.0,"machine_y_mm":4.0}],'
    '"peck_mm":0.5,"spot_mm":0.2,"skip_tools":[2,3],"drills":"/drills.toml","after_end":"drill"}},'
    '{"file":"/boards/b.drl","asked":{"format":null,"origin":"base","mirror":null,"rotate_deg":0.0,'
    '"offset_mm":[0.0,0.0],"order":"file","panel":null,"measured":[],"peck_mm":null,"spot_mm":null,'
    '"skip_tools":[],"drills":null,"after_end":"refuse"}}]}'
)
KEYS = st.sampled_from(["recent", "file", "asked", "options", "panel", "measured", "order", "columns", "x"])
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=4),
    max_leaves=12,
)


def test_what_was_opened_comes_back_with_all_its_settings(tmp_path: Path) -> None:
    recent = RecentJobs(tmp_path / "state" / "recent.json")
    assert recent.read() == []
    recent.add(Path("/boards/a.drl"), OPTIONS)
    (job,) = recent.read()
    assert (job.file, job.options) == ("/boards/a.drl", OPTIONS)


def test_a_list_of_an_older_version_is_read_and_kept_in_the_form_of_this_one(tmp_path: Path) -> None:
    recent = RecentJobs(tmp_path / "recent.json")
    recent.file.write_text(OLDER)
    jobs = [RecentJob("/boards/a.drl", OPTIONS), RecentJob("/boards/b.drl", JobOptions())]
    assert recent.read() == jobs
    recent.add(Path("/boards/c.drl"), OPTIONS)
    assert recent.read() == [RecentJob("/boards/c.drl", OPTIONS), *jobs]
    assert "asked" not in recent.file.read_text()


def test_a_row_that_is_no_job_is_left_out(tmp_path: Path) -> None:
    recent = RecentJobs(tmp_path / "recent.json")
    rows = [{"file": "/a.drl", "options": {"order": order}} for order in ("nearest", "shortest", "file")]
    recent.file.write_text(json.dumps({"recent": [*rows, 7, {"file": "/b.drl", "asked": {"panel": 3}}]}))
    assert [job.options.order for job in recent.read()] == ["nearest", "file"]


def test_the_newest_stands_first_each_file_once_and_not_too_many(tmp_path: Path) -> None:
    recent = RecentJobs(tmp_path / "recent.json")
    for number in range(MOST_RECENT + 3):
        recent.add(Path(f"/boards/{number}.drl"), JobOptions())
    recent.add(Path("/boards/5.drl"), OPTIONS)
    files = [job.file for job in recent.read()]
    assert files[0] == "/boards/5.drl" and files.count("/boards/5.drl") == 1 and len(files) == MOST_RECENT
    assert recent.read()[0].options == OPTIONS


def test_a_name_that_is_no_text_is_left_out(tmp_path: Path) -> None:
    recent = RecentJobs(tmp_path / "recent.json")
    recent.add(Path("/boards/a.drl"), JobOptions())
    recent.add(Path("/boards/\udc80.drl"), JobOptions())
    assert [job.file for job in recent.read()] == ["/boards/a.drl"]


def test_a_place_that_cannot_be_written_stops_nothing(tmp_path: Path) -> None:
    (tmp_path / "state").write_text("a file where the folder should be")
    recent = RecentJobs(tmp_path / "state" / "recent.json")
    recent.add(Path("/boards/a.drl"), JobOptions())
    assert recent.read() == []


@given(data=st.binary(max_size=200) | JSON.map(lambda value: json.dumps(value).encode()))
def test_any_file_reads_as_a_list(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    file = tmp_path_factory.getbasetemp() / "recent.json"
    file.write_bytes(data)
    assert isinstance(RecentJobs(file).read(), list)


def test_a_huge_or_deep_file_reads_as_an_empty_list(tmp_path: Path) -> None:
    file = tmp_path / "recent.json"
    for data in (b" " * (LARGEST_LIST_BYTES + 1), b'{"recent": ' + b"[" * 20000, b"\xff\xfe"):
        file.write_bytes(data)
        assert RecentJobs(file).read() == []
    file.unlink()
    file.mkdir()
    assert RecentJobs(file).read() == []
