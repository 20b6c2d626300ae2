"""The screens and menus of the eight-axis production drill, and of every machine that has parameters.

    machine.py     the machine at work: keys and buttons               windows.py   its windows, by size
    lines.py       coordinates, tool, magazine and signals as lines    buttons.py   the seven buttons of the paper
    parameters.py  the form of a group of parameters                   menus.py     the menu Machine

Such a machine drills boards, and has the other screens and menus of those that do: ui/machines.py puts them together.
"""

from drillctl.ui.eight_axis.machine import MachineScreen
from drillctl.ui.eight_axis.menus import MACHINE

__all__ = ["MACHINE", "MachineScreen"]
