"""Part programs and stores on the command line: run, inspected, estimated, converted, kept."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl.generation.boiler_drum.store_file import parse_store, store_text
from tests.support.sentences import decoded

Drillctl = Callable[..., "subprocess.CompletedProcess[str]"]
DRUM = ("--machine", "boiler-drum")
RAM = ("--store", "ram.hex")
PART = "# two holes\n6F0100\n8F0300\n2F0300\n6F0200\n8F0300\n2F0300\n4F0300\n"
PATTERN = """\
depth_mm = 30.0
approach_mm = 8.0
[gears]
along = "F"
in = "E"
feed = "3"
out = "D"
[[row]]
start_mm = 10.0
pitch_mm = 12.0
count = 2
[[row]]
start_mm = 50.0
count = 1
"""


@pytest.fixture(autouse=True)
def material(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "part.sentences").write_text(PART)
    (folder / "pattern.toml").write_text(PATTERN)
    monkeypatch.setenv("XDG_STATE_HOME", str(folder / "state"))


def done(drillctl: Drillctl, *call: str, code: int = 0) -> str:
    found = drillctl(*call)
    assert found.returncode == code, found.stderr
    return found.stdout


def test_a_part_program_drills_what_its_sentences_say(drillctl: Drillctl, folder: Path) -> None:
    told = json.loads(done(drillctl, "run", "part.sentences", *DRUM, "--holes", "h.csv", "--json"))
    rows = decoded(PART)
    assert told["steps"] == {"x": sum(abs(row[0]) for row in rows), "y": sum(abs(row[1]) for row in rows)}
    assert told["position"] == {"x": 0, "y": 0} and told["lost_steps"] == {"x": 0, "y": 0}
    holes = (folder / "h.csv").read_text().splitlines()[1:]
    assert [line.split(",")[2] for line in holes] == ["10.0000", "30.0000"]
    estimated = json.loads(done(drillctl, "estimate", "part.sentences", *DRUM, "--json"))
    assert estimated["exact"] and estimated["ticks"] == told["ticks"]


def test_the_ram_is_run_before_the_eprom(drillctl: Drillctl) -> None:
    shipped = done(drillctl, "inspect", "03", *DRUM, "--json")
    assert "RAM 03: 7 sentences" in done(drillctl, "store", "put", "03", "part.sentences")
    ours = json.loads(done(drillctl, "run", "03", *DRUM, "--json"))
    assert ours["steps"] == {"x": 3000, "y": 6000}
    done(drillctl, "store", "remove", "03")
    assert done(drillctl, "inspect", "03", *DRUM, "--json") == shipped != ours


def test_a_store_gives_back_copies_and_compares(drillctl: Drillctl, folder: Path) -> None:
    done(drillctl, "store", "put", "05", "part.sentences", *RAM)
    done(drillctl, "store", "put", "06", "05", *RAM)
    done(drillctl, "store", "get", "06", "--to", "out.sentences", *RAM)
    assert decoded((folder / "out.sentences").read_text()) == decoded(PART)
    assert done(drillctl, "store", "compare", "05", "part.sentences", *RAM) == "the same\n"
    assert done(drillctl, "store", "compare", "05", "01", *RAM, code=1).startswith("   1  6F0100  6C0500\n")
    assert "05  only in RAM\n" in done(drillctl, "store", "compare", *RAM, code=1)
    assert "RAM: 2 workpieces, 7950 cells free\n  05  00C6\n  06  00DC\n" in done(drillctl, "store", "list", *RAM)
    assert "00C0  FF FF FF FF FF FF 6F 01 00 8F 03 00 2F" in done(drillctl, "store", "show", *RAM)


def test_sentences_are_shown_in_both_languages(drillctl: Drillctl) -> None:
    english = done(drillctl, "inspect", "part.sentences", "--lang", "en").splitlines()
    polish = done(drillctl, "inspect", "part.sentences", "--lang", "pl").splitlines()
    assert english[2] == "     3  8F0300  X    10.0  Y   30.0  small carriage on (tool in) by 30.0 mm, gear F (5 m/min)"
    assert polish[2].endswith("sanie poprzeczne w przód (narzędzie w głąb) o 30.0 mm, bieg F (5 m/min)")
    rows = json.loads(done(drillctl, "inspect", "part.sentences", "--json"))["sentences"]
    assert [(row["line"], row["axis"], row["mm"]) for row in rows[:2]] == [(2, "x", 10.0), (3, "y", 30.0)]


def test_a_pattern_becomes_sentences(drillctl: Drillctl, folder: Path) -> None:
    done(drillctl, "convert", "pattern.toml", "--to", "made.sentences")
    rows = decoded((folder / "made.sentences").read_text())
    along, holes, here = [], [], 0
    for x, y, speed in rows:
        here += x
        if y > 0 and speed == 0.315:
            holes.append(here / 50)
        along.append(x)
    assert holes == [10.0, 22.0, 50.0] and sum(along) == 0 == sum(row[1] for row in rows)
    assert json.loads(done(drillctl, "run", "made.sentences", *DRUM, "--json"))["fault"] is None


REFUSED = [
    (["run", "bad.sentences", *DRUM], "drillctl: bad.sentences:2:2: a gear is 0 to 9 or A to F\ndrillctl: bad.sente"),
    (["run", "far.sentences", *DRUM], "drillctl: far.sentences:1: the small carriage would be at 999.9 mm; it goes "),
    (["run", "part.sentences"], "drillctl: pcb-drill: 0.1 mm, the unit of sentences, is no whole number of steps"),
    (["run", "55", *DRUM], "drillctl: 55: no workpiece of this number, in RAM or EPROM; there are 01 02 03 04"),
    (["run", "100", *DRUM], "drillctl: '100' is no workpiece's number from 01 to 99"),
    (["run", "part.sentences", *DRUM, "--rotate", "3", "--peck", "1"],
     "drillctl: part.sentences: only a drill file can be placed and ordered: leave out --rotate --peck"),
    (["run", "03", *DRUM, "--journal", "j"], "drillctl: 03: only a drill file has a journal: "),
    (["run", "55"], "drillctl: 55: No such file or directory"),
    (["run", "04", *DRUM], "drillctl: 04: both a file and the number of a workpiece; give the file another name"),
    (["run", "03", *DRUM, *RAM], "drillctl: ram.hex: can't be read: No such file or directory"),
    (["run", "03", *DRUM, "--store", "torn.hex"], "drillctl: torn.hex:3:1: cut short: there is no end record"),
    (["store", "list", "--machine", "pcb-drill"], "drillctl: pcb-drill: this machine has no stores of workpieces"),
    (["store", "put", "00", "part.sentences"], "drillctl: argument NN: '00' is no workpiece's number from 01 to 99"),
    (["store", "put", "7", "part.sentences"], "drillctl: argument NN: '7' is no workpiece's number from 01 to 99"),
    (["store", "put", "07", "far.sentences", *RAM], "drillctl: far.sentences:1: the small carriage would be at"),
    (["store", "remove", "07", "--store", "x.hex"], "drillctl: x.hex: 07: no workpiece of this number"),
    (["store", "compare", "01"], "drillctl: compare takes two part programs, or none for RAM and EPROM"),
    (["convert", "fine.toml", "--to", "o.sentences"], "drillctl: fine.toml:9: 1.25 mm is no whole number of tenths"),
    (["convert", "gear.toml", "--to", "o.sentences"], "drillctl: gear.toml:5:6: 'G' is no gear; gears are 0 "),
    (["convert", "gears.toml", "--to", "o.sentences"], "drillctl: gears.toml:6:8: 'ff' is no gear; gears are 0 to 9"),
    (["convert", "shallow.toml", "--to", "o.sentences"], "drillctl: shallow.toml:1: approach_mm must be less than "),
]  # fmt: skip


@pytest.mark.parametrize(("call", "said"), REFUSED)
def test_what_is_refused_changes_nothing(drillctl: Drillctl, folder: Path, call: list[str], said: str) -> None:
    texts = {
        "bad.sentences": "6F0001\n6X0001\n1F0001\n",
        "far.sentences": "8F9999\n",
        "04": "M48\n",
        "torn.hex": "drillctl-store 1 crc32 00000000\n:10000000FFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF00\n",
        "fine.toml": PATTERN.replace("start_mm = 10.0", "start_mm = 1.25"),
        "gear.toml": PATTERN.replace('"E"', '"G"'),
        "gears.toml": PATTERN.replace('"E"', "4").replace('"3"', '"ff"'),
        "shallow.toml": PATTERN.replace("30.0", "8.0"),
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    before = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
    found = drillctl(*call)
    assert found.returncode == 2 and found.stderr.replace(f"{folder}/", "").startswith(said) and not found.stdout
    assert {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()} == before


def test_a_damaged_workpiece_is_listed_and_the_others_run(drillctl: Drillctl, folder: Path) -> None:
    done(drillctl, "store", "put", "01", "part.sentences", *RAM)
    done(drillctl, "store", "put", "02", "part.sentences", *RAM)
    cells = bytearray(parse_store((folder / "ram.hex").read_text(), "ram"))
    cells[0xC6] = 0x1F
    (folder / "ram.hex").write_text(store_text(bytes(cells)))
    listed = drillctl("store", "list", *RAM)
    assert listed.returncode == 1
    assert "ram.hex: workpiece 01, cell 00C6: '1F0100' is no sentence: a direction is" in listed.stderr
    assert drillctl("run", "01", *DRUM, *RAM).returncode == 2
    assert drillctl("run", "02", *DRUM, *RAM).returncode == 0
