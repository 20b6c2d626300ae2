"""The scope's keys, and what can be looked for with them: Tab chooses a kind of event, N and Shift N go to them.

Rule: as keys.py has it.
"""

from typing import NamedTuple

from drillctl.language.words import N_
from drillctl.ui.widgets.keys import Key
from drillctl.viewmodel.scope import Find

PAGE_ROWS = 8
CLOSER, FURTHER = -1, 1


class Search(NamedTuple):
    """A kind of event that can be looked for: how the next one is called, and what is said where there is none."""

    what: Find
    on: str
    none: str


SEARCHES = (
    Search("change", N_("next change of this row"), N_("no further change of this row")),
    Search("step", N_("next step of this row's axis"), N_("no further step")),
    Search("command", N_("next command"), N_("no further command")),
    Search("sensor", N_("next edge of a sensor"), N_("no further edge of a sensor")),
    Search("request", N_("next request"), N_("no further request")),
    Search("late", N_("next late tick"), N_("no further late tick")),
    Search("fault", N_("next fault"), N_("no further fault")),
)
SEARCH_OF = {search.what: search for search in SEARCHES}
KINDS = tuple(SEARCH_OF)
SEARCH_KEYS = (
    Key(("tab",), "Tab", "next_kind", N_("the next kind of event, to be looked for with N"), N_("Kind")),
    Key(("n",), "N", "find_on", N_("goes to the next event of the kind"), N_("Next")),
    Key(("N",), "Shift N", "find_back", N_("goes to the event of the kind before")),
    *(Key((), "Tab, N", "look_for", search.on, argument=search.what) for search in SEARCHES),
)  # fmt: skip
SCOPE_KEYS = (
    Key(("left",), N_("Left"), "step", N_("the cursor a column to the left"), argument=-1),
    Key(("right",), N_("Right"), "step", N_("the cursor a column to the right"), argument=1),
    Key((",",), ",", "pan", N_("half a screen to the left"), argument=-1),
    Key((".",), ".", "pan", N_("half a screen to the right"), argument=1),
    Key(("+", "="), "+", "zoom", N_("closer, around the cursor"), N_("Closer"), CLOSER),
    Key(("-",), "-", "zoom", N_("further away"), N_("Further"), FURTHER),
    Key(("w",), "W", "whole", N_("the whole run"), N_("Whole")),
    Key(("home",), "Home", "start", N_("to the first tick")),
    Key(("end",), "End", "end", N_("to the last tick")),
    Key((" ",), N_("Space"), "follow", N_("follows the run as it goes on, or stays"), N_("Follow")),
    Key(("g",), "G", "go_to", N_("goes to a tick, typed"), N_("Go to")),
    Key(("[",), "[", "mark", N_("puts mark A here; there again takes it away"), N_("Mark A"), "A"),
    Key(("]",), "]", "mark", N_("puts mark B here; there again takes it away"), N_("Mark B"), "B"),
    *SEARCH_KEYS,
    Key(("/",), "/", "search", N_("the next command with a text in it"), N_("Find")),
    Key(("y",), "Y", "curve", N_("numbers as a curve, with the speed; or as numbers"), N_("Curve")),
    Key(("up",), N_("Up"), "row", N_("a row up"), argument=-1),
    Key(("down",), N_("Down"), "row", N_("a row down"), argument=1),
    Key(("page up",), "PgUp", "row", N_("eight rows up"), argument=-PAGE_ROWS),
    Key(("page down",), "PgDn", "row", N_("eight rows down"), argument=PAGE_ROWS),
    Key(("delete",), "Del", "hide", N_("hides this row"), N_("Hide")),
    Key(("enter",), "Enter", "isolate", N_("shows only the rows of this row's group")),
    Key(("insert",), "Ins", "show_all", N_("shows all rows again")),
    Key(("ctrl o",), "Ctrl-O", "open", N_("opens a trace file"), N_("Open")),
    Key(("f6",), "F6", "choose_run", N_("another run: the machine's own, or a trace file"), N_("Runs")),
)
