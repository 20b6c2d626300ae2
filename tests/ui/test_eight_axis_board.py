"""A whole board of four tools on six spindles on the machine's screen, by keys, with automatic tool changes."""

import re
from pathlib import Path

import pytest

from drillctl.cli.screen import EditorScreens
from drillctl.console.machine_console import MachineConsole
from drillctl.machine import Library, shipped_tables
from drillctl.machine.library import user_tables
from drillctl.ticker.launch import RunSettings
from drillctl.ui import app
from tests.support.near_file import near_text
from tests.ui.whole import Paper, Whole, at_home

FOUR = (
    "M48\nMETRIC\nT1C0.3\nT2C0.8\nT3C1.0\nT4C3.2\n%\nG90\nT1\nX1.0Y1.0\nX2.0Y1.0\nT2\nX2.0Y2.0\nT3\nX1.0Y2.0\nX1.5Y1.5\n"
    "T4\nX3.0Y3.0\nM30\n"
)
KEYS = ("4", "end", "enter", "esc", "1", "y")  # Import, the last file of the folder, back, Start, yes
MOST_TURNS = 20_000


class Production(Whole):
    """The whole program on a production drill of the user's own, whose tool changes are its own too."""

    def __init__(self, library: Library):
        self.desk = MachineConsole(library, library.machine("eight-axis"), RunSettings("simulated", "free"))
        self.paper = Paper()
        self.paper.size = (100, 32)
        makers = EditorScreens(library, self.desk, plain=False).makers()
        self.app = app.App(self.desk, makers=makers, terminal=self.paper)


def test_a_board_of_four_tools_is_drilled_by_keys(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    at_home(tmp_path, monkeypatch)
    (user_tables() / "machines").mkdir(parents=True)
    (user_tables() / "machines" / "eight-axis.toml").write_text(near_text())
    (tmp_path / "four.drl").write_text(FOUR)
    program = Production(Library((user_tables(), shipped_tables())))
    program.app.show("drilling")
    program.press(*KEYS)

    seen, shown = set(), set()
    for _ in range(MOST_TURNS):
        program.desk.turn()
        program.app.turn()
        step = program.desk.view().change_step
        seen.add(step)
        if step and not shown:
            shown |= set(map(int, re.findall(r"Command +change, step (\d+)", program.text())))
        if not program.desk.at_work:
            break
    assert {13, 15, 18} <= seen <= set(range(24))  # those that take longest are met for certain
    assert shown and shown <= seen  # its figures are renewed in the cycle of the parameters
    text = program.text()
    assert "Holes     6 of 6, 6 done" in text and "ended: 6 of 6 holes" in text
    assert "1:T6 2:T6 3:T6 4:T6 5:T6 6:T6" in text, "the chucks hold the last tool"
    assert re.search(r"T3 +0\.300 0\.050 +4998", text) and re.search(r"T5 +1\.000 0\.050 +5998", text)
    program.desk.close()
