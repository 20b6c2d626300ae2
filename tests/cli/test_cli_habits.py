"""What people expect of a command line: examples at hand, tables by name, folders told, completion, -q and -v."""

import argparse
import json
import logging
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from drillctl.cli import main, verbosity
from drillctl.files.shipped import shipped

BASH = shutil.which("bash")
Captured = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def own_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.chdir(tmp_path)


def test_examples_are_listed_and_copied_and_nothing_is_replaced(tmp_path: Path, capsys: Captured) -> None:
    assert main(["examples"]) == 0
    listed = capsys.readouterr().out.splitlines()
    names = {line.split()[0] for line in listed}
    assert {"blinker.drl", "square.kmd", "01-phase-sequences"} <= names
    assert main(["examples", "mine"]) == 0
    board = shipped("examples", "examples") / "blinker.drl"
    assert (tmp_path / "mine/blinker.drl").read_bytes() == board.read_bytes()
    assert (tmp_path / "mine/docs/lab/01-phase-sequences/sheet.toml").is_file()
    assert not (tmp_path / "mine/docs/lab/INSTRUCTOR.md").exists()  # it has the solutions' figures
    (tmp_path / "mine/blinker.drl").write_text("changed")
    assert main(["examples", "mine"]) == 2
    assert "is there already" in capsys.readouterr().err and (tmp_path / "mine/blinker.drl").read_text() == "changed"


def test_the_links_of_copied_pages_lead_somewhere(tmp_path: Path) -> None:
    assert main(["examples", "mine"]) == 0
    pages = sorted((tmp_path / "mine").rglob("*.md"))
    assert len(pages) > 40
    links = {
        (page, target)
        for page in pages
        for target in re.findall(r"\]\((?!https?:)([^)#\s]+)[^)]*\)", page.read_text("utf-8"))
    }
    lost = sorted(f"{page.name}: {target}" for page, target in links if not (page.parent / target).exists())
    assert lost and all("INSTRUCTOR.md" in each for each in lost)


def test_a_table_is_shown_copied_and_then_in_use(tmp_path: Path, capsys: Captured) -> None:
    assert main(["tables", "copy", "phase/two-phase-forced"]) == 0
    own = tmp_path / "config/drillctl/tables/phase/two-phase-forced.toml"
    capsys.readouterr()
    assert main(["tables", "show", "phase/two-phase-forced"]) == 0
    assert capsys.readouterr().out == own.read_text()
    own.write_text(own.read_text().replace("xxxxxx......", "xxxxx......."))
    assert main(["tables", "where", "phase/two-phase-forced"]) == 0
    assert capsys.readouterr().out.strip() == str(own)
    assert main(["tables", "list", "phase"]) == 0
    assert f"phase/two-phase-forced  {own}" in capsys.readouterr().out.splitlines()
    assert main(["tables", "copy", "phase/two-phase-forced"]) == 2
    assert "is there already" in capsys.readouterr().err
    for wrong, words in (("phase/nope", "no phase table is named 'nope'"), ("nope", "KIND/NAME")):
        assert main(["tables", "show", wrong]) == 2
        assert words in capsys.readouterr().err


def test_a_copy_says_how_it_is_used_and_a_failed_one_that_it_failed(tmp_path: Path, capsys: Captured) -> None:
    for folder, used in (("mine", " with --tables mine\n"), ("tables", "two-phase-forced.toml\n")):
        assert main(["tables", "copy", "phase/two-phase-forced", "--to", folder]) == 0
        assert capsys.readouterr().err.endswith(used)
    (tmp_path / "mine" / "ramp").symlink_to("/proc")
    assert main(["tables", "copy", "ramp/seven-state", "--to", "mine"]) == 2
    assert "mine/ramp/seven-state.toml: can't be written" in capsys.readouterr().err


@pytest.mark.parametrize("folder", ["", "a file"])
def test_what_is_no_folder_is_not_written_to(folder: str, tmp_path: Path, capsys: Captured) -> None:
    """Least of all the current one, for a variable of a shell that is empty."""
    (tmp_path / "a file").write_text("mine")
    for command in (["examples", folder], ["tables", "copy", "phase/two-phase-forced", "--to", folder]):
        assert main(command) == 2
        assert f"{folder!r} is no folder" in capsys.readouterr().err
    assert [file.name for file in tmp_path.iterdir()] == ["a file"]


def test_where_names_the_folders(tmp_path: Path, capsys: Captured) -> None:
    assert main(["where", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["settings"] == [str(tmp_path / "config/drillctl/screen.toml")]
    assert found["journals"] == [str(tmp_path / "state/drillctl")]
    assert main(["where"]) == 0
    assert "(not there yet)" in capsys.readouterr().out


@pytest.mark.skipif(BASH is None, reason="no bash here")
def test_bash_completes_verbs_options_and_choices(tmp_path: Path, capsys: Captured) -> None:
    assert main(["completion", "bash"]) == 0
    (tmp_path / "complete.bash").write_text(capsys.readouterr().out)
    ask = (
        'source ./complete.bash; COMP_WORDS=($1); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); '
        '_shtab_drillctl "" "${COMP_WORDS[COMP_CWORD]}" ""; echo "${COMPREPLY[@]}"'
    )

    def completed(line: str) -> list[str]:
        call = [str(BASH), "-c", ask, "bash", line]
        return subprocess.run(call, capture_output=True, text=True, check=True, timeout=60).stdout.split()

    assert {"replay", "report", "resume"} <= set(completed("drillctl re"))
    assert "--machine" in completed("drillctl run --mac")
    assert set(completed("drillctl run --plant d")) == {"dynamic"}


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_get_their_scripts(shell: str, capsys: Captured) -> None:
    assert main(["completion", shell]) == 0
    assert "drillctl" in capsys.readouterr().out


def test_quiet_says_nothing_that_need_not_be_read_and_verbose_says_more(tmp_path: Path, capsys: Captured) -> None:
    (tmp_path / "job.kmd").write_text("KMD_GOTOdXdY 3 0\n")
    convert = ["convert", str(shipped("examples", "examples") / "blinker.drl"), "--to", "out.drl"]
    assert main(convert) == 0 and "is written" in capsys.readouterr().err
    assert main([*convert, "-q"]) == 0 and "is written" not in capsys.readouterr().err
    assert main(convert) == 0 and "is written" in capsys.readouterr().err
    assert main(["run", "job.kmd", "-v"]) == 0
    told = capsys.readouterr().err
    assert "machine pcb-drill is read from" in told and "plant ideal" in told
    assert main(["run", "job.kmd"]) == 0 and "plant ideal" not in capsys.readouterr().err
    logging.getLogger("drillctl").setLevel(logging.NOTSET)


def test_nothing_is_said_across_a_screen(capsys: Captured) -> None:
    verbosity.set_from(argparse.Namespace(verbose=0))
    with verbosity.held_back():
        logging.getLogger("drillctl").warning("later")
        assert not capsys.readouterr().err
    assert capsys.readouterr().err == "drillctl: later\n"


def test_quiet_hides_no_error(capsys: Captured) -> None:
    assert main(["run", "missing.kmd", "-q"]) == 2
    assert "missing.kmd" in capsys.readouterr().err


def test_version(capsys: Captured) -> None:
    for option in ("-V", "--version"):
        with pytest.raises(SystemExit) as left:
            main([option])
        assert left.value.code == 0 and capsys.readouterr().out.startswith("drillctl ")


def test_the_man_page_is_roff(tmp_path: Path) -> None:
    man = shutil.which("groff")
    if man is None:
        pytest.skip("no groff here")
    page = Path(__file__).resolve().parents[2] / "docs" / "drillctl.1"
    call = [man, "-man", "-ww", "-Tutf8", str(page)]
    done = subprocess.run(call, capture_output=True, text=True, timeout=60, check=True)
    assert done.stderr == ""
