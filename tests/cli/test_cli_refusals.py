"""What the operator gets wrong: exit 2, a clear line each on standard error, nothing printed, nothing made."""

import errno
import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.cli import main

Drillctl = Callable[..., "subprocess.CompletedProcess[str]"]
GERBER = "%FSLAX24Y24*%\n%MOIN*%\n%ADD10C,0.01*%\nD10*\nX0Y0D02*\nX100Y100D01*\nM02*\n"
BIG = "M48\nMETRIC\nT1C0.8\n%\nT1\nX0.0Y0.0\nX2000.0Y10.0\nX20.0Y10.0\nX15.0Y3000.0\nM30\n"
FILES: dict[str, str | bytes] = {
    "empty.drl": "",
    "empty.kmd": "",
    "board.gbr": GERBER,
    "big.drl": BIG,
    "bad.kmd": "KMD_INICJALIZACJA\nKMD_GOTO_X_Y 1\n",
    "bad.toml": 'name = "bad"\ntick_hz = 500\ntick = 3\n',
    "noise.kmd": b"KMD_BAZA\n\xff\xfe\n",
    "x.trace": "drillctl-trace 1\nmachine pcb-drill\ndigest 0\ntick_hz \u00b2\n"
    "signal in.0 <\n\n0 in.0 0x00000000\nend 1\n",
}
HOLE, OUT_OF_REACH = "hole of tool T1 at", "is out of reach of pcb-drill: "
REFUSED = [
    (["run", "empty.drl"], "drillctl: empty.drl: "),
    (["run", "board.gbr"], "drillctl: board.gbr: gerber-not-drill: this is a Gerber picture"),
    (["run", "missing.drl"], "drillctl: missing.drl: No such file or directory"),
    (["run", "missing.kmd"], "drillctl: missing.kmd: can't be read: No such file or directory"),
    (["run", "."], "drillctl: .: Is a directory"),
    (["run", "empty.kmd"], "drillctl: empty.kmd:1:1: no command in it"),
    (["run", "noise.kmd"], "drillctl: noise.kmd: not UTF-8 text, so not a .kmd queue"),
    (["run", "bad.kmd"], "drillctl: bad.kmd:2:1: 1 argument; it is written KMD_GOTO_X_Y X Y"),
    (["run", "kicad.drl", "--machine", "boiler-drum"], "drillctl: boiler-drum: a board needs axes x and y beside"),
    (["run", "kicad.drl", "--machine", "lathe"], "drillctl: lathe: no machine of this name; there are boiler-drum, "),
    (["run", "kicad.drl", "--machine", "bad.toml"], "drillctl: bad.toml:3: unknown key tick"),
    (["run", "kicad.drl", "--machine", "../no.toml"], "drillctl: ../no.toml: can't be read: No such file"),
    (["run", "kicad.drl", "--tables", "nowhere"], "drillctl: nowhere: no such folder"),
    (["run", "kicad.drl", "--tick-hz", "0"], "drillctl: argument --tick-hz: '0' is not a whole number from 1 to 1"),
    (["run", "kicad.drl", "--tick-hz", "fast"], "drillctl: argument --tick-hz: 'fast' is not a whole number"),
    (["run", "kicad.drl", "--tick-hz", "1e3"], "drillctl: argument --tick-hz: '1e3' is not a whole number"),
    (["run", "kicad.drl", "--format", "wat"], "drillctl: kicad.drl: bad-format: "),
    (["run"], "drillctl: the following arguments are required: JOB (see drillctl run --help)"),
    (["dig"], "drillctl: argument VERB: invalid choice: 'dig'"),
    ([], "drillctl: the screen needs a terminal"),
    (["run", "hole.kmd", "--trace", "nowhere/x.trace"], "drillctl: nowhere/x.trace: can't be written: No such file"),
    (["run", "hole.kmd", "--trace", "."], "drillctl: .: can't be written: Is a directory"),
    (["run", "hole.kmd", "--vcd", "hole.kmd/x"], "drillctl: hole.kmd/x: can't be written: Not a directory"),
    (["run", "hole.kmd", "--holes", "n" * 300], f"drillctl: {'n' * 300}: can't be written: File name too long"),
    (["run", "hole.kmd", "--trace", "hole.kmd"], "drillctl: hole.kmd: would overwrite a file that this run reads"),
    (["run", "hole.kmd", "--trace", "./sub/../hole.kmd"], "drillctl: sub/../hole.kmd: would overwrite a file"),
    (["run", "hole.kmd", "--trace", "link"], "drillctl: link: would overwrite a file that this run reads"),
    (["run", "hole.kmd", "--trace", "a", "--vcd", "a"], "drillctl: a: would overwrite a file that this run reads"),
    (["run", "hole.kmd", "--trace", "a", "--vcd", "nowhere/b"], "drillctl: nowhere/b: can't be written"),
    (["inspect", "missing.drl"], "drillctl: missing.drl: No such file or directory"),
    (["replay", "missing.trace"], "drillctl: missing.trace: can't be read: No such file or directory"),
    (["replay", "hole.kmd"], "drillctl: hole.kmd:1: not a trace: "),
    (["replay", "x.trace"], "drillctl: x.trace: tick_hz '\u00b2' is no tick rate"),
    (["tables", "check", "bad.toml"], "drillctl: bad.toml: no table of this program: "),
    (["tables", "check", "hole.kmd"], "drillctl: hole.kmd:2: not TOML: "),
    (["machines", "--tables", "hole.kmd"], "drillctl: hole.kmd: no such folder"),
]


@pytest.fixture
def hostile(folder: Path) -> Path:
    """Bad files beside the good ones."""
    for name, data in FILES.items():
        (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
    (folder / "sub").mkdir()
    (folder / "link").symlink_to("hole.kmd")
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


@pytest.mark.parametrize(("arguments", "line"), REFUSED, ids=[" ".join(arguments)[:50] for arguments, _ in REFUSED])
def test_refused(arguments: list[str], line: str, drillctl: Drillctl, hostile: Path) -> None:
    before = contents(hostile)
    done = drillctl(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(line) and done.stderr.count("\n") == 1
    assert contents(hostile) == before


def test_a_board_too_large_names_each_hole(drillctl: Drillctl, hostile: Path) -> None:
    done = drillctl("run", "big.drl", "--trace", "t", "--holes", "h")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.splitlines() == [
        f"drillctl: big.drl:7: {HOLE} X2000.0000 Y10.0000 mm {OUT_OF_REACH}X 94488 steps is outside 0..16528",
        f"drillctl: big.drl:9: {HOLE} X15.0000 Y3000.0000 mm {OUT_OF_REACH}Y 141732 steps is outside 0..11804",
    ]
    assert not (hostile / "t").exists() and not (hostile / "h").exists()


def test_tables_that_a_run_reads_are_not_written_over(drillctl: Drillctl, folder: Path) -> None:
    from drillctl.machine import shipped_tables

    for kind, name in (("machines", "pcb-drill"), ("ramp", "seven-state"), ("phase", "two-phase-forced")):
        copy = folder / "t" / kind / f"{name}.toml"
        copy.parent.mkdir(parents=True)
        copy.write_bytes((shipped_tables() / kind / f"{name}.toml").read_bytes())
        done = drillctl("run", "hole.kmd", "--tables", "t", "--holes", str(copy))
        assert done.returncode == 2 and "would overwrite a file that this run reads" in done.stderr


@pytest.mark.parametrize(
    ("name", "code", "text"),
    [("board.gbr", "gerber-not-drill", "%FS"), ("empty.drl", "empty-file", ""), ("missing.drl", "unreadable", "")],
)
def test_inspect_tells_an_error_as_an_object_too(
    name: str, code: str, text: str, drillctl: Drillctl, hostile: Path
) -> None:
    done = drillctl("inspect", name, "--json")
    assert done.returncode == 2 and done.stderr.startswith(f"drillctl: {name}: ")
    error = json.loads(done.stdout)["error"]
    assert (error["code"], error["line"], error["text"]) == (code, None, text)


OBJECTS = [
    (["run", "missing.drl"], "unreadable", None),
    (["run", "missing.kmd"], "job", None),
    (["run", "board.gbr"], "gerber-not-drill", None),
    (["run", "bad.kmd"], "job", 2),
    (["run", "big.drl"], "job", 7),
    (["run", "hole.kmd", "--machine", "pcb-dril"], "table", None),
    (["run", "hole.kmd", "--machine", "bad.toml"], "table", 3),
    (["run", "hole.kmd", "--port", "gpi"], "port", None),
    (["run", "hole.kmd", "--trace", "."], "output", None),
    (["run", "hole.kmd", "--plant", "dynamik"], "usage", None),
    (["run", "hole.kmd", "--plan", "dynamic", "--fualt", "blunt=1"], "usage", None),
    (["run"], "usage", None),
    (["resume", "hole.kmd"], "journal", None),
    (["estimate", "empty.kmd"], "job", 1),
    (["estimate", "kicad.drl", "--offset", "1"], "usage", None),
    (["inspect", "empty.drl"], "empty-file", None),
    (["latency", "--seconds", "0"], "usage", None),
    (["machines", "--tables", "nowhere"], "table", None),
    (["ports", "more"], "usage", None),
]


@pytest.mark.parametrize(("arguments", "code", "line"), OBJECTS, ids=[" ".join(row[0]) for row in OBJECTS])
def test_with_json_a_refusal_is_an_object_of_every_verb(
    arguments: list[str], code: str, line: int | None, hostile: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(hostile)
    before = contents(hostile)
    assert main([*arguments, "--json"]) == 2
    told = capsys.readouterr()
    error = json.loads(told.out)["error"]
    assert set(error) == {"code", "line", "text", "reason"}
    assert (error["code"], error["line"]) == (code, line) and error["reason"]
    assert told.err.startswith("drillctl: ")
    assert contents(hostile) == before


@pytest.mark.parametrize(
    ("arguments", "meant"),
    [
        (["runn", "x"], "run"), (["run", "x", "--order", "optimized"], "optimised"),
        (["run", "x", "--mahcine", "x"], "--machine"), (["run", "hole.kmd", "--machine", "pcb-dril"], "pcb-drill"),
        (["run", "hole.kmd", "--port", "simulate"], "simulated"), (["tables", "chek", "x"], "check"),
        (["run", "hole.kmd", "--plant", "dynamic", "--fault", "blumt=1"], "blunt=N, N from 0 to 1000"),
        (["sweep", "--out", "o", "--ramp", "seven-stat"], "seven-state"), (["run", "slip.kmd"], "KMD_CZEKAJ"),
        (["sweep", "--out", "o", "--vary", "coulom_nm=1"], "coulomb_nm"),
        (["run", "lamp.kmd", "--machine", "cnc-shield"], "spindle"),
    ],
)  # fmt: skip
def test_a_word_that_is_nearly_right(
    arguments: list[str], meant: str, hostile: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(hostile)
    (hostile / "slip.kmd").write_text("KMD_CZEKA 3\n")
    (hostile / "lamp.kmd").write_text("KMD_WYJSCIE spindel 1\n")
    assert main(arguments) == 2
    assert f"did you mean {meant}?" in capsys.readouterr().err


def test_a_broken_table_spoils_its_own_machine_only(drillctl: Drillctl, folder: Path) -> None:
    (folder / "tables" / "machines").mkdir(parents=True)
    (folder / "tables" / "machines" / "broken.toml").write_text('name = "broken"\n')
    done = drillctl("machines")
    assert done.returncode == 2 and done.stderr == "drillctl: tables/machines/broken.toml: tick_hz is missing\n"
    assert [line.split()[0] for line in done.stdout.splitlines()] == [
        "boiler-drum", "cnc-shield", "eight-axis", "mega-28byj48", "pcb-drill", "pcb-drill-ramp-lab",
    ]  # fmt: skip
    assert drillctl("run", "hole.kmd").returncode == 0


@pytest.mark.parametrize(
    "verb",
    [["machines"], ["run", "hole.kmd"], ["inspect", "kicad.drl"], ["run", "--help"], ["--version"]], ids=" ".join,
)  # fmt: skip
def test_a_reader_that_has_gone(verb: list[str], folder: Path) -> None:
    """As with ``| head -0``: quiet, and the exit code of a broken pipe."""
    reading, writing = os.pipe()
    os.close(reading)
    call = [sys.executable, "-m", "drillctl", *verb]
    done = subprocess.run(call, cwd=folder, stdout=writing, stderr=subprocess.PIPE, timeout=60, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (141, b"")


def test_an_output_goes_through_a_link_and_replaces_what_was_there(drillctl: Drillctl, folder: Path) -> None:
    (folder / "kept").mkdir()
    (folder / "h.csv").symlink_to("kept/holes.csv")
    for old in (None, "old\n"):
        if old is not None:
            (folder / "kept" / "holes.csv").write_text(old)
        assert drillctl("run", "hole.kmd", "--holes", "h.csv").returncode == 0
        assert (folder / "h.csv").is_symlink() and [f.name for f in (folder / "kept").iterdir()] == ["holes.csv"]
        assert (folder / "kept" / "holes.csv").read_text().startswith("tool,diameter_mm,x_mm,y_mm,")


@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (MemoryError(), "not enough memory"),
        (RecursionError("maximum recursion depth exceeded"), "nested too deeply"),
        (OSError(errno.EIO, "Input/output error", "board.drl"), "board.drl: Input/output error"),
    ],
)
def test_what_no_reader_has_caught_is_a_line_too(
    error: Exception, reason: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fails(_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("drillctl.generation.drillfile.read", fails)
    assert main(["inspect", "board.drl"]) == 2
    out, err = capsys.readouterr()
    assert not out and reason in err and err.count("\n") == 1 and "Traceback" not in err
