"""The program as a stranger has it: the wheel, made where there is no C compiler, in an environment of its own with
what the wheel declares and pytest, in a folder far from the clone.
"""

import os
import shutil
import subprocess
import sys
import venv
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKED = ("drillctl", "tables", "examples", "docs", "hatch_build.py", "pyproject.toml", "README.md", "LICENSE",
          "CITATION.cff")  # fmt: skip
NOT_PACKED = shutil.ignore_patterns("*.so", "*.pyd", "__pycache__")
PIP = (sys.executable, "-m", "pip", "--disable-pip-version-check", "-q")
Done = subprocess.CompletedProcess[str]


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Made from a copy of the sources, so that what the clone has compiled stays; the compiler is ``false``."""
    source = tmp_path_factory.mktemp("source")
    for name in PACKED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, source / name, ignore=NOT_PACKED)
        else:
            shutil.copy(ROOT / name, source)
    command = [*PIP, "wheel", "--no-deps", "--wheel-dir", "wheels", "."]
    without_compiler = {**os.environ, "CC": "false", "CXX": "false"}
    run_pip(command, source, without_compiler)
    return next((source / "wheels").glob("drillctl-*.whl"))


@pytest.fixture(scope="session")
def bin_folder(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of the environment into which the wheel is installed, by the name that its user would type."""
    place = tmp_path_factory.mktemp("stranger") / "env"
    try:
        venv.create(place, with_pip=False, symlinks=True)
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"no virtual environment can be made here: {error}")
    programs = place / ("Scripts" if os.name == "nt" else "bin")
    install = [*PIP, "--python", str(place), "install", f"{wheel}[plot]", "pytest"]
    run_pip(install, place, dict(os.environ))
    return programs


def run_pip(command: Sequence[str], folder: Path, surroundings: dict[str, str]) -> None:
    """Skips the tests where the libraries that are needed can't be fetched."""
    done = subprocess.run(
        command, cwd=folder, env=surroundings, capture_output=True, text=True, timeout=250, check=False
    )
    if done.returncode and "connection" in done.stderr.lower():
        pytest.skip("the libraries that are needed can't be fetched here")
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="session")
def surroundings(bin_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Of a new user's shell: a home without anything in it, the environment's programs first."""
    kept = {name: os.environ[name] for name in ("LANG", "TMPDIR", "SYSTEMROOT") if name in os.environ}
    path = os.pathsep.join((str(bin_folder), os.environ["PATH"]))
    return {**kept, "PATH": path, "HOME": str(tmp_path_factory.mktemp("home")), "MPLBACKEND": "agg", "TERM": "xterm"}


@pytest.fixture
def stranger(bin_folder: Path, surroundings: dict[str, str], tmp_path: Path) -> Callable[..., Done]:
    """Runs a program of the environment in the test's folder, or below it; returns what it printed."""

    def run(program: str, *arguments: str, below: str = ".") -> Done:
        call = [str(bin_folder / program), *arguments]
        folder = tmp_path / below
        return subprocess.run(
            call, cwd=folder, env=surroundings, capture_output=True, text=True, timeout=200, check=False
        )

    return run
