"""The menus of the PCB drill: Files and Drilling, beside those that every machine has."""

from drillctl.language.words import N_
from drillctl.ui.pcb_drill.typed import FORMATS
from drillctl.ui.screens.menus import HELP, TESTS, configuration
from drillctl.ui.widgets.menus import Item

FORMAT_ITEMS = (
    *(Item(entry.name, "files", "set_format", entry.option) for entry in FORMATS),
    Item(N_("&Typed..."), "files", "type_format"),
)
PLACING_ITEMS = (
    Item(N_("&Mirror"), "files", "cycle", "mirror"),
    Item(N_("&Turn"), "files", "cycle", "rotate_deg"),
    Item(N_("&Origin"), "files", "cycle", "origin"),
    Item(N_("O&ffset..."), "files", "offset"),
    Item(N_("&Panel..."), "files", "panel"),
    Item(N_("Measured &holes..."), "files", "align"),
)
BASING_ITEMS = (
    Item(N_("Type X and &Y..."), "drilling", "type_place"),
    Item(N_("Go to a &hole..."), "drilling", "go_to_hole"),
    Item(N_("Set the &base here"), "drilling", "set_base"),
)
FILES = Item(N_("&Files"), items=(
    Item(N_("&Open..."), "files"),
    Item(N_("&Last opened..."), "files", "recent"),
    Item(N_("&Examples..."), "drilling", "examples"),
    Item(N_("&Interrupted jobs..."), "files", "unfinished"),
    Item(N_("&Format"), items=FORMAT_ITEMS),
    Item(N_("&Placing"), items=PLACING_ITEMS),
    Item(N_("O&rder of the holes"), "files", "cycle", "order"),
    Item(N_("How to &drill..."), "files", "how_to_drill"),
    Item(N_("&Quit"), "", "leave"),
))  # fmt: skip
DRILLING = Item(N_("&Drilling"), items=(
    Item(N_("&Start"), "drilling", "start"),
    Item(N_("&Dry run, drill up"), "drilling", "dry_run"),
    Item(N_("&Hold or go on"), "drilling", "hold_or_resume"),
    Item(N_("S&top"), "drilling", "stop"),
    Item(N_("The t&ool is in"), "drilling", "tool_changed"),
    Item(N_("&Basing"), items=BASING_ITEMS),
    Item(N_("&Initialisation"), "drilling", "initialise"),
    Item(N_("&Return to zero"), "drilling", "return_to_zero"),
    Item(N_("&Acknowledge a fault"), "drilling", "acknowledge"),
))  # fmt: skip
MENUS = (FILES, DRILLING, TESTS, configuration("drilling"), HELP)
