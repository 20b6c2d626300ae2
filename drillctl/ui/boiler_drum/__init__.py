"""The screens and menus of the boiler-drum drill, and of every machine whose jobs are workpieces in stores.

    panel.py       the machine at its keys: run, pause, return to zero, single steps
    programming.py its keys for cells and workpieces       monitor.py      the display, and what is typed into it
    keypad.py      the 28 keys and the switches            segments.py     figures of seven segments
    panel_windows.py display, keys, program and wall, by the size of the terminal
    program_list.py the program with its sentence in work  wall.py         the drum wall with its row of holes
    menus.py       the menus Program and Operation         next_step.py    what the machine waits for

BOILER_DRUM is the row of ui/machines.py. The screen is imported when it is first made.
"""

import urwid

from drillctl.language.words import N_
from drillctl.ui.boiler_drum.menus import MENUS
from drillctl.ui.boiler_drum.next_step import next_step
from drillctl.ui.screens.shell import MachineScreens, Shell
from drillctl.viewmodel.console import Console


def _panel(console: Console, shell: Shell, plain: bool) -> urwid.Widget:
    from drillctl.ui.boiler_drum.panel import Panel

    return Panel(console, shell, plain)


BOILER_DRUM = MachineScreens(
    recognises=lambda view: view.stores,
    menus=MENUS,
    makers={"panel": _panel},
    first="panel",
    at_start=lambda console, shell: False,
    next_step=next_step,
    initialise=N_("To initialise means here: set the tool, and take that place as zero."),
)
