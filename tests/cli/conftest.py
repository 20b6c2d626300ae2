"""The program as its user has it: in an empty folder, files beside it."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.language import words

COMMAND = (sys.executable, "-m", "drillctl")
Done = subprocess.CompletedProcess[str]

QUEUE = """\
# a hole at 100, 50 and a wait
KMD_INICJALIZACJA
KMD_GOTO_X_Y 100 50
KMD_WIERTLO_DOL
KMD_WIERTLO_GORA
KMD_CZEKAJ 3
KMD_KONIEC
"""
# One board as CAD programs write it: T1 (0.8 mm) at 0.4, 1.2 and 1.15, 1.2 inch, T2 (1 mm) at 0.65, 2.05 inch.
BOARDS = {
    "kicad.drl": "M48\n; DRILL file {KiCad} date 2022\n; FORMAT={-:-/ absolute / metric / decimal}\nFMAT,2\nMETRIC\n"
    "; #@! TA.AperFunction,Plated,PTH,ComponentDrill\nT1C0.800\nT2C1.000\n%\nG90\nG05\n"
    "T1\nX10.16Y30.48\nX29.21Y30.48\nT2\nX16.51Y52.07\nT0\nM30\n",
    "inch.drl": "M48\nINCH\nT1C0.0315\nT2C0.0394\n%\nT1\nX0.4Y1.2\nX1.15Y1.2\nT2\nX0.65Y2.05\nM30\n",
    "lz.drl": "M48\nINCH,LZ\nT1C0.0315\nT2C0.0394\n%\nT1\nX004Y012\nX0115Y012\nT2\nX0065Y0205\nM30\n",
    "tz.drl": "M48\nINCH,TZ\nT1C0.0315\nT2C0.0394\n%\nT1\nX4000Y12000\nX11500Y12000\nT2\nX6500Y20500\nM30\n",
    "metric-tz.drl": "M48\nMETRIC,TZ,000.000\nT1C0.8\nT2C1.0\n%\n"
    "T1\nX10160Y30480\nX29210Y30480\nT2\nX16510Y52070\nM30\n",
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Holds the queue and the boards."""
    for name, text in {"hole.kmd": QUEUE, **BOARDS}.items():
        (tmp_path / name).write_text(text)
    return tmp_path


@pytest.fixture
def drillctl(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Iterator[Callable[..., Done]]:
    """Runs the program there to its end, in this process: that costs a tenth of a process of its own."""
    monkeypatch.chdir(folder)

    def run(*arguments: str) -> Done:
        capsys.readouterr()
        try:
            code = main(arguments)
        except SystemExit as left:
            code = int(left.code or 0)
        out, err = capsys.readouterr()
        return subprocess.CompletedProcess(arguments, code, out, err)

    yield run
    words.use("en")


@pytest.fixture
def own_process(folder: Path) -> Callable[..., Done]:
    """Runs the program there to its end, as a shell would."""

    def run(*arguments: str) -> Done:
        call = [*COMMAND, *arguments]
        return subprocess.run(call, cwd=folder, capture_output=True, text=True, timeout=60, check=False)

    return run


@pytest.fixture
def started(folder: Path) -> Callable[..., "subprocess.Popen[str]"]:
    """Starts the program there; its output goes into pipes."""

    def start(*arguments: str, stdin: int | None = None) -> "subprocess.Popen[str]":
        pipe = subprocess.PIPE
        call = [*COMMAND, *arguments]
        return subprocess.Popen(call, cwd=folder, stdin=stdin, stdout=pipe, stderr=pipe, text=True)

    return start
