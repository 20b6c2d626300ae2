"""The scope's keys, and what can be looked for with them: small letters look forwards, capital ones backwards.

Rule: as keys.py has it.
"""

from typing import NamedTuple

from drillctl.language.words import N_
from drillctl.ui.widgets.keys import Key
from drillctl.viewmodel.scope import Find

PAGE_ROWS = 8
CLOSER, FURTHER = -1, 1


class Search(NamedTuple):
    """What can be looked for: forwards by the small letter, backwards by the capital one."""

    letter: str
    what: Find
    on: str
    back: str
    none: str
    short: str = ""


SEARCHES = (
    Search(
        "n",
        "change",
        N_("next change of this row"),
        N_("the change before"),
        N_("no further change of this row"),
        N_("Next"),
    ),
    Search("s", "step", N_("next step of this row's axis"), N_("the step before"), N_("no further step")),
    Search("c", "command", N_("next command"), N_("the command before"), N_("no further command")),
    Search("e", "sensor", N_("next edge of a sensor"), N_("the edge before"), N_("no further edge of a sensor")),
    Search("r", "request", N_("next request"), N_("the request before"), N_("no further request")),
    Search("l", "late", N_("next late tick"), N_("the late tick before"), N_("no further late tick")),
    Search("f", "fault", N_("next fault"), N_("the fault before"), N_("no further fault")),
)
SEARCH_OF = {search.what: search for search in SEARCHES}
SEARCH_KEYS = tuple(
    key
    for search in SEARCHES
    for key in (
        Key((search.letter,), search.letter.upper(), "find_on", search.on, search.short, search.what),
        Key((search.letter.upper(),), f"Shift {search.letter.upper()}", "find_back", search.back, argument=search.what),
    )
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
    Key(("a",), "A", "mark", N_("puts mark A here; there again takes it away"), N_("Mark A"), "A"),
    Key(("b",), "B", "mark", N_("puts mark B here; there again takes it away"), N_("Mark B"), "B"),
    *SEARCH_KEYS,
    Key(("/",), "/", "search", N_("the next command with a text in it"), N_("Find")),
    Key(("y",), "Y", "curve", N_("numbers as a curve, with the speed; or as numbers"), N_("Curve")),
    Key(("up",), N_("Up"), "row", N_("a row up"), argument=-1),
    Key(("down",), N_("Down"), "row", N_("a row down"), argument=1),
    Key(("page up",), "PgUp", "row", N_("eight rows up"), argument=-PAGE_ROWS),
    Key(("page down",), "PgDn", "row", N_("eight rows down"), argument=PAGE_ROWS),
    Key(("h",), "H", "hide", N_("hides this row"), N_("Hide")),
    Key(("k",), "K", "isolate", N_("shows only the rows of this row's group")),
    Key(("v",), "V", "show_all", N_("shows all rows again")),
    Key(("o",), "O", "open_file", N_("opens a trace file"), N_("Open")),
    Key(("m",), "M", "show_machine", N_("the run of the machine at hand again"), N_("Machine")),
)
