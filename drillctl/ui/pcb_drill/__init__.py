"""The screens and menus of the PCB drill, and of every machine that drills a board.

    drilling.py    the machine at work: its keys (what they do: screens/board_controls.py)
    drilling_windows.py its windows, by the size of the terminal
    side_window.py the paper's window at the right of it
    machine_window.py the same with large figures, where there is room     tool_list.py    the tools of the board
    motor_strip.py the motors side by side
    files.py       find a drill file, see what it says, place it           browser.py      its list of files
    typed.py       number formats, and what is typed into its dialogs      board_facts.py  a board in words
    alignment.py   placing a board by holes measured on it                 measuring.py    what the holes say
    files_layout.py where its parts stand, by the size of the terminal
    job_forms.py   the boxes that ask for options
    examples.py    the example boards and the lab sheets
    menus.py       the menus Files and Drilling

PCB_DRILL is the row of ui/machines.py. Each screen is imported when it is first made.
"""

import urwid

from drillctl.ui.pcb_drill.menus import MENUS
from drillctl.ui.screens.board_steps import next_step
from drillctl.ui.screens.shell import MachineScreens, Shell
from drillctl.ui.screens.unfinished import offer_unfinished
from drillctl.viewmodel.console import Console


def _drilling(console: Console, shell: Shell, plain: bool) -> urwid.Widget:
    from drillctl.ui.pcb_drill.drilling import Drilling

    return Drilling(console, shell, plain)


def _files(console: Console, shell: Shell, plain: bool) -> urwid.Widget:
    from drillctl.ui.pcb_drill.files import Files

    return Files(console, shell, plain)


PCB_DRILL = MachineScreens(
    recognises=lambda view: True,
    menus=MENUS,
    makers={"drilling": _drilling, "files": _files},
    first="drilling",
    at_start=offer_unfinished,
    next_step=next_step,
)
