"""The menus that every machine has: Tests, Configuration and Help. A machine's own menus stand beside its screens.

Rule: a new entry is a new row; the program does the rest. ui/machines.py names the menus of each family of machines.
"""

from drillctl.language.words import N_
from drillctl.ui.widgets.menus import Item

TESTS = Item(N_("&Tests"), items=(
    Item(N_("&Phase tables"), "phase_editor"),
    Item(N_("&Ramp tables"), "ramp_editor"),
    Item(N_("&Queue of commands"), "queue_editor"),
    Item(N_("&Signals"), "signals"),
    Item(N_("P&lant and faults"), "plant"),
    Item(N_("S&cope"), items=(
        Item(N_("&The machine's run"), "scope", "show_machine"),
        Item(N_("&Open a trace..."), "scope", "open"),
    )),
))  # fmt: skip
HELP = Item(N_("&Help"), items=(
    Item(N_("&Keys"), "", "help"),
    Item(N_("&Find an action..."), "", "find_action"),
    Item(N_("&Copy of the screen"), "", "copy_screen"),
    Item(N_("&Notices"), "", "notices"),
    Item(N_("&About"), "", "about"),
))  # fmt: skip


def configuration(first_screen: str) -> Item:
    """The Configuration menu. ``first_screen`` is the machine's screen that asks for the interrupt frequency."""
    return Item(N_("&Configuration"), items=(
        Item(N_("&Parameters"), "configuration"),
        Item(N_("&Machine..."), "", "choose_machine"),
        Item(N_("Interrupt &frequency..."), first_screen, "type_tick_hz"),
        Item(N_("P&ort"), "port"),
        Item(N_("&Colours"), items=(
            Item(N_("&Blue, as in 1996"), "", "set_theme", "blue"),
            Item(N_("&Dark"), "", "set_theme", "dark"),
            Item(N_("&Light"), "", "set_theme", "light"),
            Item(N_("&High contrast"), "", "set_theme", "contrast"),
            Item(N_("&Monochrome"), "", "set_theme", "mono"),
        )),
    ))  # fmt: skip
