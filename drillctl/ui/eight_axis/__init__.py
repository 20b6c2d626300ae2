"""The screens and menus of the eight-axis production drill, and of every machine that has parameters.

    machine.py     the machine at work: keys and buttons               windows.py   its windows, by size
    lines.py       coordinates, tool, magazine and signals as lines    buttons.py   the seven buttons of the paper
    parameters.py  the form of a group of parameters                   menus.py     the menu Machine

Such a machine drills boards, and has the other screens and menus of those that do: ui/machines.py puts them together.
The screen is imported when it is first made.
"""

import urwid

from drillctl.ui.eight_axis.menus import MACHINE
from drillctl.ui.screens.shell import Shell
from drillctl.viewmodel.console import Console

__all__ = ["MACHINE", "machine_screen"]


def machine_screen(console: Console, shell: Shell, plain: bool) -> urwid.Widget:
    """Makes the first screen."""
    from drillctl.ui.eight_axis.machine import MachineScreen

    return MachineScreen(console, shell, plain)
