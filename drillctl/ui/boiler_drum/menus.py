"""The menus of the boiler-drum drill: Panel and Program, beside those that every machine has."""

from drillctl.language.words import N_
from drillctl.ui.screens.menus import HELP, TESTS, configuration
from drillctl.ui.widgets.menus import Item

PROGRAM = Item(N_("&Program"), items=(
    Item(N_("&Workpieces..."), "panel", "list_workpieces"),
    Item(N_("&Call the number typed"), "panel", "call_workpiece"),
    Item(N_("&Show the cell typed"), "panel", "memory"),
    Item(N_("&Quit"), "", "leave"),
))  # fmt: skip
OPERATION = Item(N_("&Operation"), items=(
    Item(N_("&Automatic run"), "panel", "start"),
    Item(N_("&Pause"), "panel", "pause"),
    Item(N_("&Go on"), "panel", "resume"),
    Item(N_("S&top"), "panel", "stop"),
    Item(N_("Return to &zero"), "panel", "return_to_zero"),
    Item(N_("This place is zero (&initialise)..."), "panel", "initialise"),
    Item(N_("&Reset..."), "panel", "reset"),
    Item(N_("Ac&knowledge a fault"), "panel", "acknowledge"),
))  # fmt: skip
MENUS = (PROGRAM, OPERATION, TESTS, configuration("panel"), HELP)
