"""The plots of the documents, drawn by ``drillctl plot`` and ``sweep`` as a reader would: three SVG files.

Rule: each is the outcome of command lines that its page shows. They need matplotlib, whose version decides the bytes,
so no test compares them. Called by docs/pictures.py.
"""

import os
import tempfile
from pathlib import Path

from drillctl.cli import main

LAB = "pcb-drill-ramp-lab"
BOARD = Path(__file__).resolve().parent.parent / "examples" / "blinker.drl"
COMMANDS = (
    f"run board.drl --machine {LAB} --plant dynamic --seed 1 --trace b.trace --holes b.csv -q",
    "plot b.csv --out board-as-drilled.svg -q",
    "plot b.trace --what motion --axis x --seconds 7.2:8.6 --out speed-and-lag.svg -q",
    f"sweep --board board.drl --machine {LAB} --skip-tools 1,2 --hz 440:680:20 --vary coulomb_nm=0.25:2:0.25 "
    "--ramp seven-state --out s.csv --picture sweep-heat.svg -q",
)


def plotted(folder: Path) -> None:
    """Runs the commands and leaves their SVG files in a folder."""
    folder, here = folder.resolve(), Path.cwd()
    with tempfile.TemporaryDirectory(prefix="drillctl-") as work:
        os.chdir(work)
        try:
            Path("board.drl").write_bytes(BOARD.read_bytes())
            for command in COMMANDS:
                if main(command.split()) != 0:
                    raise RuntimeError(f"refused: drillctl {command}")
            for svg in sorted(Path().glob("*.svg")):
                (folder / svg.name).write_bytes(svg.read_bytes())
        finally:
            os.chdir(here)


if __name__ == "__main__":
    plotted(Path(__file__).resolve().parent / "pictures")
