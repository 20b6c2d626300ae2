"""The wheel carries the tables, and a program installed from it finds them."""

import os
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest

from drillctl.ui.pcb_drill import examples

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--wheel-dir", str(folder), str(ROOT)]
    uncompiled = {**os.environ, "DRILLCTL_KERNEL": "plain"}  # quick, and what the clone has compiled stays as it is
    subprocess.run(command, check=True, timeout=110, capture_output=True, env=uncompiled)
    return next(folder.glob("drillctl-*.whl"))


@pytest.mark.timeout(120)
def test_every_table_is_in_the_wheel(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    tables = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "tables").rglob("*.toml"))
    assert len(tables) > 10
    assert {f"drillctl/{name}" for name in tables} <= names


@pytest.mark.timeout(120)
def test_the_example_boards_and_the_lab_sheets_are_in_the_wheel(wheel: Path) -> None:
    """Where drillctl/ui/pcb_drill/examples.py looks for them."""
    names = set(zipfile.ZipFile(wheel).namelist())
    for inside, files in (("examples", examples.boards()), ("sheets", examples.sheets())):
        assert files and {f"drillctl/{inside}/{file.name}" for file in files} <= names


@pytest.mark.timeout(120)
def test_an_installed_program_finds_its_tables(wheel: Path, tmp_path: Path) -> None:
    """Without the checkout: the wheel unpacked into a bare environment that borrows our dependencies."""
    venv.create(tmp_path / "env", system_site_packages=False)
    site = next((tmp_path / "env").glob("lib/python*/site-packages"))
    zipfile.ZipFile(wheel).extractall(site)
    dependencies = [path for path in sys.path if path.endswith("site-packages")]
    code = (
        f"import sys; sys.path += {dependencies!r}; import drillctl.machine as m; "
        "tables = m.shipped_tables(); assert 'env' in str(tables), tables; "
        "print(*m.Library.standard().machine_names())"
    )
    python = tmp_path / "env" / "bin" / "python"
    done = subprocess.run([python, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    shipped = (ROOT / "tables" / "machines").glob("*.toml")
    assert done.stdout.split() == sorted(file.stem for file in shipped)
