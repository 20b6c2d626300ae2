"""The registry of screens and menus by family of machines: a package beside ``pcb_drill`` and a row here for each.

Rule: a family recognises its machines by what they have, never by their name. A family's package imports ui/screens,
ui/models and ui/widgets, and nothing of the program around it; the program reaches a family through this table alone.
"""

from collections.abc import Sequence

from drillctl.ui.boiler_drum import BOILER_DRUM
from drillctl.ui.eight_axis import MACHINE, machine_screen
from drillctl.ui.pcb_drill import PCB_DRILL
from drillctl.ui.screens.shell import MachineScreens
from drillctl.viewmodel.console import MachineView

FILES, DRILLING, *OTHERS = PCB_DRILL.menus
# A machine with parameters drills boards too: it has a first screen and an entry of its own, and all else of those.
EIGHT_AXIS = PCB_DRILL._replace(
    recognises=lambda view: view.production,
    menus=(FILES, DRILLING._replace(items=(*DRILLING.items, MACHINE)), *OTHERS),
    makers={**PCB_DRILL.makers, "drilling": machine_screen},
)
FAMILIES = (BOILER_DRUM, EIGHT_AXIS, PCB_DRILL)  # asked from the first on; the last takes every machine


def screens_of(view: MachineView, families: Sequence[MachineScreens] = FAMILIES) -> MachineScreens:
    """The screens and menus for a machine: those of the first family that recognises it, else of the last."""
    return next((family for family in families if family.recognises(view)), families[-1])
