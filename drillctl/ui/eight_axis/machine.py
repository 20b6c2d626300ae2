"""The machine's screen: coordinates, tool and magazine, the board in the middle with its progress, and seven buttons.

Rule: the buttons are keys of the table below, so that a click and a key do the same; what the keys of every machine
that drills boards do is in screens/board_controls.py. Figures are renewed in the machine's position detection cycle.
"""

import time

import urwid

from drillctl.language.words import N_, _
from drillctl.ui.eight_axis.buttons import Buttons
from drillctl.ui.eight_axis.parameters import ParameterForm
from drillctl.ui.eight_axis.windows import MachineWindows
from drillctl.ui.screens.board_controls import BOARD_KEYS, BoardControls
from drillctl.ui.screens.jog_controls import JOG_KEYS
from drillctl.ui.screens.shell import Shell
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.sizes import layout
from drillctl.ui.widgets.texts import Size
from drillctl.viewmodel.console import Console, MachineView

BUTTONS = (
    Key(("1",), "1", "start", N_("the button Start: drills the board; asks first"), N_("Start")),
    Key(("2",), "2", "initialise", N_("the button Home: looks for the origin of every axis"), N_("Home")),
    Key(("3",), "3", "park", N_("the button Park: heads up, the table to the parking place"), N_("Park")),
    Key(("4",), "4", "files", N_("the button Import: opens a drill file"), N_("Import")),
    Key(("5",), "5", "tools", N_("the button Tools: the parameters of the tools"), N_("Tools")),
    Key(("6",), "6", "magazine", N_("the button Magazine: its places"), N_("Magazine")),
    Key(("7",), "7", "groups", N_("the button Parameters: axes, system, machining, coordinates"), N_("Parameters")),
)


class MachineScreen(BoardControls, urwid.WidgetWrap[urwid.Widget]):
    """The first screen of the eight-axis drill; ``refresh`` is called with the newest view."""

    title = N_("Machine")
    has_windows = True
    keys = (
        *(key._replace(short="") for key in BUTTONS),
        Key(("s",), "S", "start", N_("drills the board; asks first")),
        Key(("d",), "D", "dry_run", N_("goes to every hole with the drill up"), N_("Dry")),
        Key((" ",), N_("Space"), "hold_or_resume", N_("holds the job, or goes on with it"), N_("Hold")),
        Key(("c",), "C", "tool_changed", N_("the tool that the job waits for is in; asks first"), N_("Tool in")),
        Key(("i",), "I", "initialise", N_("head up, then X=0, Y=0 by the limit sensors")),
        Key(("f",), "F", "files", N_("opens the files")),
        Key(("e",), "E", "examples", N_("the example boards and the lab sheets")),
        *JOG_KEYS,
        *BOARD_KEYS,
        Key(("tab",), "Tab", "turn_page", N_("the next page of the windows at the side"), N_("Page")),
        Key(("g",), "G", "go_to_hole", N_("goes over a hole, by its number")),
        Key(("t",), "T", "type_place", N_("goes to X and Y in mm, typed")),
        Key(("b",), "B", "set_base", N_("takes this place as the working base")),
        Key(("a",), "A", "acknowledge", N_("the fault has been seen")),
    )

    def __init__(self, console: Console, shell: Shell, plain: bool = False):
        self._room = MachineWindows(plain)
        BoardControls.__init__(self, console, shell, self._room)
        self._looked_s = float("-inf")
        foot = urwid.Pile([("pack", Buttons(BUTTONS, self._click)), ("pack", self._footer)])
        urwid.WidgetWrap.__init__(self, urwid.Frame(self._room, footer=foot))
        self.refresh(console.view())

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Lays the windows out for this size."""
        assert len(size) == 2
        self._room.lay_out(layout(*size), size[0])
        return super().render(size, focus)

    def refresh(self, view: MachineView) -> None:
        """Draws what changed, once in the position detection cycle; what comes to rest, and any answer, at once."""
        production = self._console.production()
        records = production.records() if production is not None else None
        now = time.monotonic()
        if records is not None and view.moving and now - self._looked_s < records.cycle_s:
            return
        self._looked_s = now
        self._room.use(records)
        super().refresh(view)

    def park(self) -> None:
        """Moves the table to the parking place, the heads raised."""
        production = self._console.production()
        if production is not None and not self._refused():
            self._answer(production.park(), _("to the parking place"))

    def tools(self) -> None:
        """Opens the form of the tools."""
        self.form("tool")

    def magazine(self) -> None:
        """Opens the form of the places of the magazine."""
        self.form("magazine")

    def groups(self) -> None:
        """Offers the groups of parameters; the one that is chosen is opened as a form."""
        production = self._console.production()
        if production is None:
            return
        groups = production.groups()
        self._shell.choose(
            _("Parameters"), [_(heading) for _name, heading in groups], lambda index: self.form(groups[index][0])
        )

    def form(self, group: str) -> None:
        """Opens the form of a group of parameters."""
        production = self._console.production()
        if production is not None:
            heading = dict(production.groups())[group]
            self._shell.open(ParameterForm(production, self._shell, group, _(heading)))

    def examples(self) -> None:
        """Offers the example boards and the lab sheets, as the Files screen does."""
        files = self._shell.show("files")
        offer = getattr(files, "examples", None)
        if offer is not None:
            offer()

    def _click(self, key: Key) -> None:
        self._note = ("body", "")
        getattr(self, key.method)()
