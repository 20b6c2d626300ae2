"""The Drilling screen: the board in the middle, the paper's window at the right, and the machine at the keys.

Rule: the keys and the layout of the screen; what the keys do is in screens/board_controls.py.
"""

from pathlib import Path

import urwid

from drillctl.language.words import N_
from drillctl.ui.pcb_drill.drilling_windows import DrillingWindows
from drillctl.ui.pcb_drill.examples import offer_examples
from drillctl.ui.screens.board_controls import BOARD_KEYS, BoardControls
from drillctl.ui.screens.jog_controls import JOG_KEYS
from drillctl.ui.screens.shell import Shell
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.sizes import layout
from drillctl.ui.widgets.texts import Size
from drillctl.viewmodel.console import Console


class Drilling(BoardControls, urwid.WidgetWrap[urwid.Widget]):
    """The screen of the machine at work; ``refresh`` is called with the newest view."""

    title = N_("Drilling")
    has_windows = True
    keys = (
        Key(("s",), "S", "start", N_("drills the board; asks first"), N_("Start")),
        Key(("d",), "D", "dry_run", N_("goes to every hole with the drill up"), N_("Dry")),
        Key((" ",), N_("Space"), "hold_or_resume", N_("holds the job, or goes on with it"), N_("Hold")),
        Key(("c",), "C", "tool_changed", N_("the tool that the job waits for is in; asks first")),
        Key(("i",), "I", "initialise", N_("head up, then X=0, Y=0 by the limit sensors"), N_("Init")),
        Key(("f",), "F", "files", N_("opens the files"), N_("Files")),
        Key(("e",), "E", "examples", N_("the example boards and the lab sheets")),
        *JOG_KEYS,
        *BOARD_KEYS,
        Key(("tab",), "Tab", "turn_page", N_("the next page of the window at the right")),
        Key(("g",), "G", "go_to_hole", N_("goes over a hole, by its number")),
        Key(("t",), "T", "type_place", N_("goes to X and Y in mm, typed")),
        Key(("b",), "B", "set_base", N_("takes this place as the working base")),
        Key(("a",), "A", "acknowledge", N_("the fault has been seen")),
    )

    def __init__(self, console: Console, shell: Shell, plain: bool = False):
        self._room = DrillingWindows(plain)
        BoardControls.__init__(self, console, shell, self._room)
        urwid.WidgetWrap.__init__(self, urwid.Frame(self._room, footer=self._footer))
        self.refresh(console.view())

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Lays the windows out for this size."""
        assert len(size) == 2
        self._room.lay_out(layout(*size), size[0])
        return super().render(size, focus)

    def examples(self) -> None:
        """Offers the example boards and the lab sheets; a board that is chosen is loaded."""
        offer_examples(self._shell, self._load_example)

    def _load_example(self, file: Path) -> None:
        """Loads a board as the Files screen does, which then has it too."""
        from drillctl.ui.pcb_drill.files import Files  # here alone: the first frame is quicker without it

        files = self._shell.show("files")
        if isinstance(files, Files):
            files.open_example(file)
