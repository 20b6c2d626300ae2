"""No character that a terminal obeys or hides reaches it, wherever it came from; and names that are no UTF-8 are names.

Every verb in this process, with its standard streams as the system has them (``capfd``).
"""

import json
import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.cli import VERBS, main, parser
from drillctl.jobs.session import default_journal
from drillctl.language import LINES, visible
from drillctl.machine import shipped_tables

# A title, a colour, C1, a carriage return, a bidi override, no width, a byte that is no UTF-8.
NASTY = "n\x1b]0;t\x07\x1b[31m\x9b2J\r\u202e\u200b\udcff"
BOARD = "M48\n;{0}\nMETRIC\nT1C0.8\n%\nT1\nX10.0Y30.0\nX20.0Y30.0\nM30\n"
WRONG = "M48\nMETRIC\nT1C0.8\n%\nT1\nX10.0Y30.0\n{0}\nM30\n"
QUEUE = "# {0}\nKMD_CZEKAJ 3 # {0}\nKMD_KONIEC\n"
TRACE = "drillctl-trace 1\nmachine {0}\ndigest 0\ntick_hz 500\nplant ideal\n\nend 1\n"
JOURNAL = {
    "drillctl-journal": 1, "job": NASTY, "file_digest": "0", "program_digest": "0", "machine": NASTY,
    "machine_digest": NASTY, "holes": 2, "options": {"machine": NASTY, "order": NASTY, "tables": NASTY},
}  # fmt: skip
BIDI = "\u202e\u200b\ufeff"  # no control, so that a reader goes on
TEXTS = {
    f"{NASTY}-clean.drl": BOARD.replace("{0}", BIDI), f"{NASTY}-clean.kmd": QUEUE.replace("{0}", BIDI + "\x1b"),
    f"{NASTY}-odd.drl": WRONG.replace("{0}", BIDI),
    f"{NASTY}.drl": BOARD, f"{NASTY}-wrong.drl": WRONG, f"{NASTY}.kmd": QUEUE, f"{NASTY}-wrong.kmd": "KMD_{0}\n",
    f"{NASTY}.trace": TRACE, f"{NASTY}-align": "{0}\n", f"{NASTY}-drills": "{0}\n",
}  # fmt: skip
ANY, WRONG_FILE, KMD = f"{NASTY}-clean.drl", f"{NASTY}-wrong.drl", f"{NASTY}-clean.kmd"
OWN = f"{NASTY}/machines/own.toml"
CASES = [
    ["report", f"{NASTY}.trace", "-o", f"{NASTY}.html"], ["report", NASTY, "-o", NASTY], ["grade", NASTY, NASTY],
    ["grade", "01", NASTY], ["examples", NASTY], ["where"], ["where", "--tables", NASTY], ["completion", NASTY],
    ["completion", "bash"], ["parameters", "list", "--machine", NASTY], ["parameters", "set", NASTY],
    ["magazine", "list", "--machine", OWN], ["magazine", NASTY], ["tables", "show", NASTY], ["tables", "list", NASTY],
    ["tables", "copy", f"phase/{NASTY}"], ["convert", ANY, "--to", f"{NASTY}.nc", "--style", NASTY],
    ["run", f"{NASTY}.drl"], ["run", f"{NASTY}-odd.drl"], ["inspect", f"{NASTY}-odd.drl", "--json"],
    ["run", f"{NASTY}.kmd"], [NASTY], ["--theme", NASTY],
    ["screen", "--lang", NASTY], ["screen", "--port", NASTY, "--machine", NASTY],
    ["run", ANY], ["run", ANY, "--json", "--holes", f"{NASTY}.csv"], ["run", WRONG_FILE], ["run", WRONG_FILE, "--json"],
    ["run", KMD, "--trace", f"{NASTY}-out.trace", "--vcd", f"{NASTY}.vcd", "--machine", OWN],
    ["run", KMD, "--vcd", f"{NASTY}.vcd", "--machine", OWN, "--json"], ["machines", "--tables", f"{NASTY}-tables"],
    ["machines", "--tables", f"{NASTY}-tables", "--json"],
    ["run", KMD, "--port", f"mapped:{NASTY}.card"], ["run", KMD, "--port", NASTY], ["run", KMD, "--fault", NASTY],
    ["run", f"{NASTY}-wrong.kmd"], ["run", NASTY], ["run", ANY, "--journal", f"{NASTY}-new.journal"],
    ["run", ANY, "--align", f"{NASTY}-align"], ["run", ANY, "--drills", f"{NASTY}-drills"],
    ["run", ANY, "--format", NASTY], ["run", ANY, "--panel", NASTY], ["run", ANY, "--skip-tools", NASTY],
    ["run", ANY, "--tables", NASTY], ["run", ANY, "--tick-hz", NASTY], ["run", ANY, f"--{NASTY}"],
    ["run", ANY, "--holes", f"{NASTY}/none/x"], ["run", KMD, "--plant", "dynamic", "--fault", f"{NASTY}=1"],
    ["resume", f"{NASTY}.journal"], ["resume", NASTY, "--json"], ["resume"],
    ["estimate", ANY], ["estimate", ANY, "--json"], ["estimate", NASTY, "--json"], ["estimate", KMD, "--machine", OWN],
    ["inspect", ANY], ["inspect", ANY, "--json"], ["inspect", WRONG_FILE], ["inspect", WRONG_FILE, "--json"],
    ["convert", ANY, "--to", f"{NASTY}-new.kmd"], ["convert", ANY, "--to", f"{NASTY}-new.drl"],
    ["convert", ANY, "--to", f"{NASTY}.drl", "--style", NASTY], ["convert", NASTY, "--to", f"{NASTY}-new.trace"],
    ["convert", ANY, "--to", f"x.{NASTY}"],
    ["replay", f"{NASTY}.trace"], ["replay", NASTY], ["replay", "--engine", NASTY, NASTY],
    ["machines", "--tables", NASTY], ["machines", "--tables", NASTY, "--json"], ["machines", NASTY],
    ["tables", "check", f"{NASTY}/phase/{NASTY}.toml", OWN], ["tables", NASTY], ["tables", "check", NASTY],
    ["ports"], ["ports", "--json"], ["ports", NASTY], ["latency", "--hz", NASTY, "--json"],
    ["scope", NASTY], ["scope", f"{NASTY}.trace"],
    ["plot", f"{NASTY}.trace"], ["plot", NASTY, "--what", NASTY], ["plot", NASTY, "--out", f"x.{NASTY}"],
    ["plot", "ran.trace", "--axis", NASTY], ["plot", "ran.trace", "--machine", NASTY],
    ["sweep", "--out", f"{NASTY}.csv", "--ramp", NASTY], ["sweep", "--out", f"{NASTY}.csv", "--vary", NASTY],
    ["sweep", "--out", f"{NASTY}.csv", "--phase", NASTY], ["sweep", "--machine", NASTY, "--out", "o"],
    ["sweep", "--out", f"{NASTY}.csv", "--axis", NASTY], ["sweep", "--out", f"{NASTY}.csv", "--hz", NASTY],
    ["tune", NASTY], ["tune", "pcb-drill", "--name", NASTY], ["tune", "pcb-drill", "--axis", NASTY],
    ["tune", "pcb-drill", "--out", OWN],
    ["store", "show", NASTY], ["store", "put", "05", NASTY], ["store", "list", "--store", NASTY],
]  # fmt: skip


@pytest.fixture
def hostile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder full of it, tables of its own with a description, and the environment."""
    for name, text in TEXTS.items():
        (tmp_path / name).write_bytes(text.format(NASTY).encode("utf-8", "surrogateescape"))
    (tmp_path / f"{NASTY}.journal").write_text(json.dumps(JOURNAL) + '\n{"begun": 1}\n')
    for kind in ("machines", "phase"):
        (tmp_path / NASTY / kind).mkdir(parents=True)
    printed = json.dumps(NASTY.removesuffix("\udcff"))  # escapes of JSON are TOML's too
    machine = (shipped_tables() / "machines" / "pcb-drill.toml").read_text().split("description")
    described = f"{machine[0]}description = {printed}\n{machine[1].partition(chr(10))[2]}"
    (tmp_path / OWN).write_text(described.replace('name = "pcb-drill"', 'name = "own"'))
    (tmp_path / f"{NASTY}-tables" / "machines").mkdir(parents=True)
    (tmp_path / f"{NASTY}-tables" / "machines" / "own.toml").write_bytes((tmp_path / OWN).read_bytes())
    (tmp_path / NASTY / "machines" / f"{NASTY}.toml").write_text(f"name = {printed}\n{printed} = 1\n")
    (tmp_path / NASTY / "phase" / f"{NASTY}.toml").write_text(f"name = {printed}\n[[wire]]\nname = {printed}\n")
    for name in ("XDG_STATE_HOME", "XDG_CONFIG_HOME", "LANG", "NO_COLOR", "COLUMNS", "TERM"):
        monkeypatch.setenv(name, f"{tmp_path}/{NASTY}" if name.startswith("XDG") else NASTY)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """Runs the program as the shell does; its exit code, and what came out of the two streams."""

    def run(*arguments: str) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "stdout", sys.__stdout__)
        monkeypatch.setattr(sys, "stderr", sys.__stderr__)
        try:
            code = main(arguments)
        except SystemExit as left:
            code = int(left.code or 0)
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        return code, *capfd.readouterr()

    return run


def test_every_verb_is_tried() -> None:
    tried = {case[0] for case in CASES}
    assert len(VERBS) <= len(parser().verbs()) and set(parser().verbs()) <= tried


@pytest.mark.parametrize("arguments", CASES, ids=lambda case: visible(" ".join(case))[:60])
def test_it_is_escaped(arguments: list[str], hostile: Path, told: Callable[..., tuple[int, str, str]]) -> None:
    code, out, err = told(*arguments)
    assert code in (0, 1, 2)
    assert "Traceback" not in err
    for text in (out, err):
        assert visible(text, LINES) == text, ascii(text)
    if "--json" in arguments:
        json.loads(out)


def test_a_name_that_is_no_utf_8_is_shown_and_used(hostile: Path, told: Callable[..., tuple[int, str, str]]) -> None:
    odd = os.fsdecode(b"z\xfe.drl")
    (hostile / odd).write_text(BOARD.format("odd"))
    code, out, _err = told("inspect", odd)
    assert code == 0 and "z\\xfe.drl" in out
    code, _out, err = told("run", odd, "--journal", odd + ".journal", "--holes", odd + ".csv")
    assert (code, err) == (0, "drillctl: port simulated, pace free, plant ideal; journal z\\xfe.drl.journal\n")
    assert (hostile / (odd + ".csv")).read_text().count("\n") == 3
    assert (hostile / (odd + ".journal")).is_file()
    code, out, err = told("convert", odd, "--to", f"{odd}.kmd")
    assert (code, err) == (0, "drillctl: z\\xfe.drl.kmd is written\n") and (hostile / f"{odd}.kmd").is_file()


LINE = "a\nb"  # the second half may not pass for a message of its own
IN_TWO_LINES = [
    ["run", f"{LINE}.drl"], ["run", f"{LINE}.kmd"], ["run", f"{LINE}-wrong.drl"], ["run", f"{LINE}-wrong.kmd"],
    ["run", f"{LINE}.drl", "--journal", f"{LINE}.journal"], ["run", f"{LINE}.drl", "--holes", f"{LINE}/none"],
    ["run", f"{LINE}.drl", "--port", f"mapped:{LINE}/card"], ["run", f"{LINE}.drl", "--align", f"{LINE}-wrong.drl"],
    ["run", f"{LINE}.drl", "--machine", f"{LINE}.toml"], ["run", f"{LINE}.drl", "--tables", LINE],
    ["resume", LINE], ["inspect", f"{LINE}-wrong.drl"], ["inspect", LINE], ["estimate", LINE], ["replay", LINE],
    ["replay", f"{LINE}.drl"], ["scope", LINE], ["plot", LINE], ["tables", "check", LINE],
    ["convert", f"{LINE}.drl", "--to", f"{LINE}.trace"],
]  # fmt: skip


@pytest.mark.parametrize("arguments", IN_TWO_LINES, ids=lambda case: visible(" ".join(case)))
def test_a_line_end_in_a_name_begins_no_line(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, told: Callable[..., tuple[int, str, str]]
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, text in {".drl": BOARD, "-wrong.drl": WRONG, ".kmd": QUEUE, "-wrong.kmd": "KMD_{0}\n"}.items():
        Path(f"{LINE}{name}").write_text(text.format("x"))
    Path(f"{LINE}.toml").write_text("name = 1\n")
    _code, _out, err = told(*arguments)
    assert all(line.startswith("drillctl: ") for line in err.splitlines()), err


@pytest.mark.parametrize("name", [os.fsdecode(b"z\xfe.drl"), "z\ud800.drl"])
def test_any_name_has_a_place_for_its_journal(name: str) -> None:
    assert default_journal(Path(name)) != default_journal(Path("z.drl"))
