"""What the program says of itself: help for every verb, version, machines, tables, inspect."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from drillctl import __version__
from drillctl.cli import VERBS, main, parser
from drillctl.machine import shipped_tables

Drillctl = Callable[..., "subprocess.CompletedProcess[str]"]
HELPS = [[], ["run"], ["estimate"], ["inspect"], ["convert"], ["replay"], ["machines"], ["tables"], ["tables", "check"]]


@pytest.mark.parametrize("verb", HELPS, ids=" ".join)
def test_help_reads_well(verb: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """A description and a word on everything; no markup; it fits a terminal."""
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit) as left:
        main([*verb, "--help"])
    text = capsys.readouterr().out
    assert left.value.code == 0 and "``" not in text and "%(" not in text
    described = text.split("\n\n")[1]
    assert described[0].isupper() or described.startswith("drillctl ")
    assert described.rstrip().endswith(".")
    assert all(len(line) <= 80 for line in text.splitlines())


def test_the_help_names_every_verb_and_every_exit_code() -> None:
    text = parser().format_help()
    assert len(VERBS) <= len([line for line in text.splitlines() if line.startswith("    ") and line[4].islower()])
    assert all(word in text for word in ("0 done", "1 the machine stopped", "2 refused", "130 or 143 interrupted"))


def test_every_argument_of_every_verb_is_explained() -> None:
    import argparse

    def check(one: argparse.ArgumentParser) -> None:
        for action in one._actions:
            if isinstance(action, argparse._SubParsersAction):
                for inner in action.choices.values():
                    check(inner)
            else:
                assert action.help, f"{one.prog}: {action.dest}"

    check(parser())


def test_version(drillctl: Drillctl) -> None:
    done = drillctl("--version")
    assert (done.returncode, done.stdout, done.stderr) == (0, f"drillctl {__version__}\n", "")


def test_machines_in_json(drillctl: Drillctl) -> None:
    told = json.loads(drillctl("machines", "--json").stdout)
    assert [machine["name"] for machine in told] == [
        "boiler-drum", "cnc-shield", "eight-axis", "mega-28byj48", "pcb-drill", "pcb-drill-ramp-lab",
    ]  # fmt: skip
    assert all(set(machine) == {"name", "axes", "tick_hz", "description", "digest"} for machine in told)
    assert told[4]["axes"] == ["x", "y", "z"] and told[4]["tick_hz"] == 500


def test_tables_check_looks_at_every_file(drillctl: Drillctl, folder: Path) -> None:
    phase = (shipped_tables() / "phase" / "two-phase-forced.toml").read_text()
    (folder / "good.toml").write_text(phase)
    (folder / "odd.toml").write_text(phase.replace("xxxxxx......", "xxxxxxx....."))
    (folder / "bad.toml").write_text(phase.replace("xxxxxx......", "xxxxxx...."))
    done = drillctl("tables", "check", "bad.toml", "odd.toml", "good.toml")
    assert done.returncode == 2
    assert done.stderr == "drillctl: bad.toml:13: wire 1b: 12 columns, the first row has 10\n"
    assert done.stdout.splitlines() == [
        "odd.toml: usable, but",
        "  warning: column 7: 1a and 1b are both on: the halves of one winding cancel",
        "good.toml: ok",
    ]
    assert drillctl("tables", "check", "odd.toml").returncode == 0


def test_inspect_in_json(drillctl: Drillctl) -> None:
    told = json.loads(drillctl("inspect", "kicad.drl", "--json").stdout)
    wanted = "holes slots routs tools bbox_mm units format zeros confidence runner_up reason warnings"
    assert set(wanted.split()) <= set(told)
    assert (told["holes"], told["slots"], told["routs"], told["units"]) == (3, 0, 0, "mm")
    assert told["bbox_mm"] == [10.16, 30.48, 29.21, 52.07]
    assert told["tools"] == [
        {"number": 1, "diameter_mm": 0.8, "count": 2, "slots": 0},
        {"number": 2, "diameter_mm": 1.0, "count": 1, "slots": 0},
    ]


def test_replay_tells_the_first_tick_that_differs(drillctl: Drillctl, folder: Path) -> None:
    drillctl("run", "hole.kmd", "--trace", "h.trace")
    lines = (folder / "h.trace").read_text().splitlines(keepends=True)
    at = next(index for index, line in enumerate(lines) if line.startswith("1") and " out.0 " in line)
    tick = lines[at].split()[0]
    lines[at] = f"{tick} out.0 0x00000001\n"
    (folder / "h.trace").write_text("".join(lines))
    done = drillctl("replay", "h.trace")
    assert done.returncode == 1 and done.stdout.startswith("h.trace: DIFFERS, ")
    assert f"tick {tick}" in done.stdout and "KMD_INICJALIZACJA" in done.stdout
