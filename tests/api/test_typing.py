"""What mypy says of a script that uses the library, from outside."""

from pathlib import Path

import pytest

SCRIPT = """\
import numpy as np

import drillctl
from drillctl.api.fixture import Drill


def test_it(drill: Drill) -> None:
    assert drill.run("KMD_KONIEC") == drillctl.run(np.array(["KMD_KONIEC"]), tick_hz=np.int64(500))


drillctl.sweep(hz=np.arange(300, 900, 100), ramp="seven-state", vary={"coulomb_nm": np.linspace(0.5, 2, 4)})
reveal_type(drillctl.run("KMD_KONIEC").positions("x"))
drillctl.runn("KMD_KONIEC")
drillctl.run(5)
"""


def test_a_script_is_checked_as_it_is_meant(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    api = pytest.importorskip("mypy.api")
    (tmp_path / "script.py").write_text(SCRIPT)
    monkeypatch.chdir(tmp_path)
    said, _, _ = api.run(["--strict", "--no-incremental", "--no-error-summary", "script.py"])
    lines = said.splitlines()
    assert [line.split(": ", 2)[:2] for line in lines] == [
        ["script.py:12", "note"], ["script.py:13", "error"], ["script.py:14", "error"],
    ]  # fmt: skip
    assert "signedinteger" in lines[0] and 'no attribute "runn"' in lines[1] and 'incompatible type' in lines[2]
