"""No screen draws a character that a terminal would obey, or not show: file names, comments, tables, names, answers."""

import ast
import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import msgspec
import numpy as np
import pytest
from msgspec.structs import replace

from drillctl import ui
from drillctl.cli.screen import EditorScreens
from drillctl.console import signals as handbench
from drillctl.console.machine_console import MachineConsole
from drillctl.language import visible
from drillctl.machine import Library, shipped_tables
from drillctl.ticker.launch import RunSettings
from drillctl.ui import app
from drillctl.ui.terminal.charts import COLOURS, NO_COLOUR, ChartLook, picture_lines
from drillctl.ui.terminal.image_file import picture_bytes
from drillctl.ui.widgets import texts
from drillctl.ui.widgets.dialogs import Field
from drillctl.viewmodel.job_options import JobOptions
from drillctl.viewmodel.jobs import RecentJob, Site, UnfinishedJob
from drillctl.viewmodel.reports import Chart, Curve, Picture, Style
from tests.ui.fake_console import BOARD, FAULT, VIEW, FakeConsole, Paper, Program
from tests.ui.whole import BLINKER, SCREENS, at_home, show

NASTY = "n\x1b[31m\x07\x9b2J\r\u202e\u200b\udcff"
THERE = Site(NASTY, NASTY, NASTY)
PAINT = re.compile("|".join(map(re.escape, (*COLOURS, NO_COLOUR))))
KEPT = {"condition", "reason_code", "kept"}  # words of a table, not of a person
PLAIN_HANDS = handbench.MachineSignals  # before ``at_home`` puts one that takes notes in its place


def checked(text: str) -> None:
    """Every row, its blanks and frames included, is printed as it is."""
    for row in text.split("\n"):
        assert visible(row) == row, ascii(row)


def nasty(record: Any) -> Any:
    """The record with every text in it made nasty, however deep."""
    if isinstance(record, str):
        return NASTY
    if isinstance(record, tuple) and not hasattr(record, "_fields"):
        return tuple(map(nasty, record))
    if isinstance(record, msgspec.Struct):
        told = {name: getattr(record, name) for name in record.__struct_fields__ if name not in KEPT}
        return replace(record, **{name: nasty(value) for name, value in told.items()})
    return record


def test_whatever_the_console_says() -> None:
    """Machine, axes, wires, sensors, outputs, command, fault, notices, board, tools, warnings, jobs, answers."""
    view = nasty(replace(VIEW, notices=("a", "b"), command="KMD_BAZA"))
    console = FakeConsole(view, nasty(BOARD), answer=(NASTY, NASTY))
    console.recent_jobs = [RecentJob(NASTY, JobOptions())]
    console.unfinished_jobs = [UnfinishedJob(NASTY, NASTY, NASTY, 1, 4, (2,), True, True, None, THERE, THERE)]
    program = Program(console)
    for keys in ((), ("i",), ("esc",), ("f1",), ("esc",), ("f9", "down"), ("esc",), ("f2",), ("l",), ("esc",)):
        program.press(*keys)
        checked(program.text())
    console.now = replace(view, condition="latched", fault=nasty(replace(FAULT)))
    program.app.turn()
    checked(program.text())


@pytest.mark.parametrize(
    "box",
    [
        lambda shell: shell.message(NASTY, [NASTY, NASTY]),
        lambda shell: shell.message(NASTY, [NASTY] * 40),
        lambda shell: shell.ask(NASTY, lambda: None),
        lambda shell: shell.ask_text(NASTY, NASTY, NASTY, lambda text: None),
        lambda shell: shell.ask_fields(NASTY, [Field(NASTY, NASTY)], lambda texts, answered: answered((NASTY,))),
        lambda shell: shell.choose(NASTY, [NASTY, NASTY], lambda index: None),
        lambda shell: shell.offer(NASTY, [NASTY], [(NASTY, lambda: None)]),
    ],
)
def test_every_box(box: Callable[[app.App], None]) -> None:
    program = Program(FakeConsole())
    box(program.app)
    checked(program.text())
    program.press("tab", "tab", "enter")
    checked(program.text())


def test_a_field_keeps_what_stands_in_it() -> None:
    edit = texts.Edit("name ", NASTY)
    canvas = edit.render((40,), focus=True)
    checked("\n".join(row.decode() for row in canvas.text))
    assert edit.edit_text == NASTY
    edit.keypress((40,), "backspace")
    assert edit.edit_text == NASTY[:-1]


@pytest.fixture
def hostile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder whose name, files, tables and queue are nasty; the user's folders are in it."""
    home = tmp_path / NASTY
    home.mkdir()
    at_home(home, monkeypatch)
    monkeypatch.setattr(handbench, "MachineSignals", PLAIN_HANDS)
    board = BLINKER.read_text().replace("M48\n", "M48\n;\u202e\u200b\n", 1)
    (home / f"a{NASTY}.drl").write_text(board)
    (home / f"b{NASTY}.drl").write_bytes(b"\x1b[31m\x9b\xff\n" * 5)
    (home / f"{NASTY}.kmd").write_bytes(f"# {NASTY}\nKMD_{NASTY}\n".encode("utf-8", "surrogateescape"))
    (home / "c.kmd").write_text("# \u202e\x1b[31m\t\nKMD_\u202eX\nKMD_CZEKAJ 3\n")
    for kind, name in (("machines", "pcb-drill"), ("phase", "two-phase-forced"), ("ramp", "seven-state")):
        (home / "tables" / kind).mkdir(parents=True)
        text = (shipped_tables() / kind / f"{name}.toml").read_text()
        (home / "tables" / kind / f"{NASTY}.toml").write_text(text)
        (home / "tables" / kind / f"{name}.toml").write_text(f"# \u202e\u200b\n{text}")
    own = (home / "tables" / "machines" / "pcb-drill.toml").read_text()
    before, _, after = own.partition("description = ")
    described = f"{before}description = {json.dumps(NASTY[:-1])}\n{after.partition(chr(10))[2]}"
    (home / "tables" / "machines" / "pcb-drill.toml").write_text(described)
    return home


class WholeProgram:
    """The whole program, its console on tables of the folder it was started in."""

    def __init__(self) -> None:
        library = Library((Path("tables"), shipped_tables()))
        self.console = MachineConsole(
            library, library.machine("pcb-drill"), RunSettings("simulated", "free"), tools="ask"
        )
        self.paper = Paper()
        self.paper.size = (100, 40)
        makers = EditorScreens(library, self.console, plain=False).makers()
        self.app = app.App(self.console, makers=makers, terminal=self.paper)

    def press(self, *keys: str) -> None:
        for key in keys:
            self.app.loop.screen_size = self.paper.size
            self.app.loop.process_input(self.app.filtered([key], []))
            self.app.turn()
            checked(self.text())

    def text(self) -> str:
        canvas = self.app.loop.widget.render(self.paper.size, focus=True)
        return "\n".join(row.decode() for row in canvas.text)


@pytest.mark.parametrize("screen", SCREENS)
def test_every_screen(screen: str, hostile: Path) -> None:
    whole = WholeProgram()
    try:
        show(whole.app, screen)
        whole.press("down", "enter", "down", "enter", "f1", "esc", "s", "esc", "esc")
        show(whole.app, screen)
        whole.press("end", "down", "down", "enter", "enter", "esc", "f9", "down", "right", "esc")
    finally:
        whole.console.close()


def test_a_board_whose_name_is_no_utf_8_is_loaded_and_drilled(hostile: Path) -> None:
    whole = WholeProgram()
    try:
        files: Any = whole.app.show("files")
        files._browser.stand_on(hostile.resolve() / f"a{NASTY}.drl")
        whole.press("enter")
        board = whole.console.board()
        assert board is not None and os.fsencode(board.file).endswith(b"\xff.drl")
        assert not whole.console.start(False)
        whole.press("l", "esc", "f2")
    finally:
        whole.console.close()


def test_a_queue_with_comments_is_shown_and_kept(hostile: Path) -> None:
    whole = WholeProgram()
    try:
        editor: Any = whole.app.show("queue_editor")
        editor._open("c.kmd")
        whole.press("down", "down")
        assert editor.text == (hostile / "c.kmd").read_text()
    finally:
        whole.console.close()


def picture() -> Picture:
    points = np.arange(4.0)
    label = f"$\\frac{NASTY}"
    curves = (Curve(label, points, points, Style.LINE), Curve(label, points, points * 2, Style.POINTS))
    return Picture(label, (Chart(label, label, curves, False),), (label, label))


def test_a_chart_paints_escaped_words() -> None:
    for line in picture_lines(picture(), ChartLook(60, 10, coloured=True)):
        checked(PAINT.sub("", line))


@pytest.mark.parametrize("kind", ["svg", "png"])
def test_a_picture_is_drawn(kind: str) -> None:
    content = picture_bytes(picture(), kind)
    if kind == "svg":
        ElementTree.fromstring(content)


def test_every_text_is_a_widget_of_ours() -> None:
    """urwid's own widgets draw what they are given."""
    bare = {"Text", "Edit", "IntEdit", "SelectableIcon", "Button", "CheckBox", "RadioButton", "LineBox", "BigText"}
    for file in Path(ui.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func).startswith("urwid."):
                assert ast.unparse(node.func).removeprefix("urwid.") not in bare, f"{file}:{node.lineno}"
            if isinstance(node, ast.ClassDef) and file.name != "texts.py":
                bases = [base.attr for base in node.bases if isinstance(base, ast.Attribute)]
                assert not bare.intersection(bases), f"{file}:{node.lineno}"
