"""What the machine says unasked, wherever the operator is: faults, and the tool that a job waits for.

Rule: each is told once; a box whose matter is settled otherwise goes by itself. The first button of a question changes
nothing, so that an Enter meant for something else moves nothing.
"""

from collections.abc import Callable

from drillctl.language.words import _, translated
from drillctl.ui.layers import Layers
from drillctl.ui.screens.machine_lines import tool_name
from drillctl.ui.widgets import dialogs
from drillctl.ui.widgets.texts import Text
from drillctl.viewmodel.console import Console, MachineView, ToolWanted
from drillctl.viewmodel.records import FaultReport

TOOL_KEY = "c"  # as on the screens that drill boards


class Alerts:
    """Opens and closes the boxes on faults, tool changes and mode REAL, over whatever screen is on top.

    initialise  returns what to initialise means on the machine in use, where that has to be said
    """

    def __init__(self, console: Console, layers: Layers, initialise: Callable[[], str]):
        self._console, self._layers, self._initialise = console, layers, initialise
        self._fault_shown = 0
        self._was_known = True  # the position, before the newest view
        self._tool_shown: ToolWanted | None = None
        self._tool_box: dialogs.Dialog | None = None
        self._real_shown = ""

    def show(self, view: MachineView) -> None:
        """Opens a box for what is new in the view. The fault comes last, so that it lies on top."""
        self._show_tool(view.tool_wanted)
        self._show_real(view)
        fault = view.fault if view.condition != "returning" else None
        if fault and fault.code and fault.code != self._fault_shown:
            lines = [*_fault_lines(fault, self._was_known), *filter(None, [_(self._initialise())])]
            lines.append(_("Enter acknowledges it; Esc only closes this box."))
            box = dialogs.message(_fault_title(fault), lines, self._layers.pop, self._acknowledge, "acknowledge")
            self._layers.push_dialog(box)
        self._fault_shown = fault.code if fault else 0
        self._was_known = view.position_known

    def _show_tool(self, tool: ToolWanted | None) -> None:
        if tool == self._tool_shown:
            return
        self._tool_shown = tool
        if self._tool_box is not None:
            self._layers.drop(self._tool_box)
            self._tool_box = None
        if tool is not None:
            self._tool_box = self._tool_question(tool)
            self._layers.push_dialog(self._tool_box)

    def _tool_question(self, tool: ToolWanted) -> dialogs.Dialog:
        lines = [
            _("The job waits for {tool}; the machine is at rest.").format(tool=tool_name(tool)),
            _("Put it in, then say so with {key}, here or later.").format(key=TOOL_KEY.upper()),
        ]
        buttons: list[tuple[str, Callable[[], object]]] = [
            (_("Not yet"), dialogs.nothing),
            (_("It is in"), self._console.tool_changed),
            (_("Hold"), self._console.hold),
            (f"{_('Stop')} (X)", self._console.stop),
        ]
        body = [Text(line) for line in lines]
        return dialogs.Dialog(_("Tool change"), body, buttons, self._layers.pop, answers=True, yes=TOOL_KEY)

    def _show_real(self, view: MachineView) -> None:
        """A machine whose file says REAL is driven on its port after a yes, and simulated until then."""
        wanted = f"{view.machine} {view.real_wanted}" if view.real_wanted else ""
        if wanted and wanted != self._real_shown:
            question = _("{machine} is set to REAL. Drive the real machine on {port}?")
            question = question.format(machine=view.machine, port=view.real_wanted)
            self._layers.push_dialog(dialogs.question(question, self._go_real, self._layers.pop))
        self._real_shown = wanted

    def _go_real(self) -> None:
        if problems := self._console.go_real():
            lines = [translated(problem) for problem in problems]
            self._layers.push_dialog(dialogs.message(_("Still simulated"), lines, self._layers.pop))

    def _acknowledge(self) -> None:
        self._console.acknowledge()


def _fault_title(fault: FaultReport) -> str:
    return f"{_('FAULT')} {fault.title}"


def _fault_lines(fault: FaultReport, was_known: bool) -> list[str]:
    """The text of a fault's box. ``was_known``: the position was known before it, so it can have been lost."""
    lost = _("position lost: initialise again") if was_known else _("position not known: initialise")
    position = _("position kept") if fault.position == "kept" else lost
    return [_("Cause: ") + _(fault.cause), "", _("Remedy: ") + _(fault.remedy), "", position]
