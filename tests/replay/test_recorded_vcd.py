"""The VCD file of a run of the fast engine: the bytes of a run that was ticked, and nothing kept of what is written."""

from pathlib import Path

import pytest

from drillctl.cli import main

JOBS = Path(__file__).resolve().parents[2] / "examples"


@pytest.mark.parametrize(
    ("job", "machine"),
    [
        ("blinker.drl", "pcb-drill"), ("square.kmd", "pcb-drill-ramp-lab"), ("square.kmd", "cnc-shield"),
        ("short-moves.kmd", "boiler-drum"), ("short-moves.kmd", "mega-28byj48"), ("short-moves.kmd", "eight-axis"),
    ],
)  # fmt: skip
def test_both_engines_write_the_same_bytes(
    job: str, machine: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [tmp_path / f"{engine}.vcd" for engine in ("tick", "fast")]
    for file in files:
        assert main(["run", str(JOBS / job), "--machine", machine, "--engine", file.stem, "--vcd", str(file)]) == 0
    assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("more", [(), ("--vcd", "a.vcd")])
def test_both_engines_write_the_same_segments(
    more: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for engine in ("tick", "fast"):
        call = ["run", str(JOBS / "square.kmd"), "--engine", engine, "--trace", f"{engine}.seg", *more]
        assert main(call) == 0
    assert Path("tick.seg").read_bytes() == Path("fast.seg").read_bytes()


@pytest.mark.parametrize("kept", ["a.trace", "a.seg"])
def test_a_trace_beside_it_is_the_one_without_it(kept: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    alone, beside, vcd = tmp_path / kept, tmp_path / f"b{kept}", tmp_path / "a.vcd"
    assert main(["run", str(JOBS / "square.kmd"), "--trace", str(alone)]) == 0
    assert main(["run", str(JOBS / "square.kmd"), "--trace", str(beside), "--vcd", str(vcd)]) == 0
    assert alone.read_bytes() == beside.read_bytes()
    assert vcd.read_text("utf-8").count("$var") > 30
