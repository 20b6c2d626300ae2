"""``convert`` says what it wrote, in every form; not where it is to be quiet, and not where nothing was written."""

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.mark.parametrize("to", ["job.kmd", "clean.drl", "run.seg"])
def test_it_says_what_it_wrote(to: str, folder: Path, drillctl: Run) -> None:
    source = "inch.drl"
    if to == "run.seg":
        source = "run.trace"
        (folder / "wait.kmd").write_text("KMD_CZEKAJ 1\nKMD_KONIEC\n")
        assert drillctl("run", "wait.kmd", "--trace", source).returncode == 0
    done = drillctl("convert", source, "--to", to)
    assert (done.returncode, done.stdout) == (0, "") and (folder / to).exists()
    assert done.stderr.splitlines()[-1] == f"drillctl: {to} is written"
    (folder / to).unlink()
    quiet = drillctl("convert", source, "--to", to, "-q")
    assert (quiet.returncode, quiet.stderr) == (0, "") and (folder / to).exists()


def test_what_is_refused_is_not_said_to_be_written(folder: Path, drillctl: Run) -> None:
    (folder / "kept.drl").write_text("kept")
    done = drillctl("convert", "inch.drl", "--to", "kept.drl", "--style", "furlongs")
    assert done.returncode == 2 and "written" not in done.stderr
    assert (folder / "kept.drl").read_text() == "kept"
