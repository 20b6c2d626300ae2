"""The Port screen (Configuration): which port is in use, which is configured, a test of it, and the step to REAL.

Rule: a test moves nothing; a real machine is driven after a question only.
"""

from collections.abc import Sequence

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.screens.folded_screen import FoldedScreen
from drillctl.ui.screens.own_steps import PORT_STEPS
from drillctl.ui.screens.shell import Shell, choose_another
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.panel import BORDER_COLUMNS, panel_columns, with_panel
from drillctl.ui.widgets.texts import Line, Size, boxed
from drillctl.viewmodel.console import Console, MachineView, Problems
from drillctl.viewmodel.signals import PortControl, PortReport, PortView

LABEL_COLUMNS, LEAST_LEFT = 14, 74
PORTS_THERE_ARE = N_("Ports that a machine's file can name")
WORDS = {True: N_("REACHED"), False: N_("clear")}


class PortScreen(FoldedScreen):
    """Shows the port of the machine in use, and the report of the last test."""

    title = N_("Port")
    own_steps = PORT_STEPS
    keys = (
        Key(("f5",), "F5", "test", N_("opens the configured port and asks it; nothing moves"), N_("Test")),
        Key(("f6",), "F6", "choose_port", N_("the real machine or the simulated one; asks first"), N_("Real or not")),
    )

    def __init__(self, console: Console, shell: Shell, control: PortControl):
        self._shell, self._control = shell, control
        self._report: PortReport | None = None
        self._port, self._ports = control.port(), control.ports()

    def refresh(self, view: MachineView) -> None:
        """Redraws if the port is another one; the report of the one before goes."""
        port = self._control.port()
        if port != self._port:
            self._port, self._report = port, None
            self._invalidate()

    def lines(self) -> Sequence[Line]:
        """The port, then the report of its test."""
        return port_lines(self._port, self._report)

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the port, and the ports that there are: beside it where there is room, else below it, or not at all."""
        assert len(size) == 2
        columns, rows = size
        beside = panel_columns(columns, LEAST_LEFT)
        lines = folded(self.lines(), columns - beside)
        if beside >= LEAST_LEFT:
            panel = folded(self._each_port(further=True), beside - BORDER_COLUMNS)
            return with_panel(boxed(lines, columns - beside, rows), _(PORTS_THERE_ARE), panel, beside, rows)
        below = folded([[""], [("title", _(PORTS_THERE_ARE))], *self._each_port(further=False)], columns)
        return boxed([*lines, *below] if len(lines) + len(below) <= rows else lines, columns, rows)

    def _each_port(self, further: bool) -> list[Line]:
        """A line for each port; ``further``: below it what it needs, and why it can't be used."""
        name = self._port.configured.partition(":")[0]
        lines: list[Line] = []
        for port in self._ports:
            mark = ">" if port.name == name else " "
            label = ("key" if mark == ">" else "title", f"{mark}{port.name:{LABEL_COLUMNS - 1}}")
            if not further:
                lines.append([label, translated(port.summary)])
                continue
            missing = port.missing and _("can't be used here: {why}").format(why=translated(port.missing))
            usable = ("warning", missing) if missing else ("good", _("can be used here"))
            needs = _("it needs: {what}").format(what=translated(port.needs))
            lines += [[label], [translated(port.summary)], [needs], [usable], [""]]
        return lines

    def test(self) -> None:
        """Tests the configured port; takes some seconds where opening the line resets a board."""
        self._report = self._control.test()
        self._invalidate()

    def choose_port(self) -> None:
        """Offers the simulated machine and the real one on the configured port."""
        real = _("the real machine on {port}").format(port=self._port.configured or "-")
        ways = (self._go_simulated, self._go_real)
        lines = (_("the simulated machine"), real)
        choose_another(self._shell, _("Port"), lines, int(self._port.real), lambda index: ways[index]())

    def _go_real(self) -> None:
        """Asks, then changes to the real machine; its position is not known then."""
        if not self._port.configured:
            self._changed(self._control.go_real())
            return
        question = _("Drive the real machine on {port}? It may move from now on.")
        self._shell.ask(question.format(port=self._port.configured), lambda: self._changed(self._control.go_real()))

    def _go_simulated(self) -> None:
        """Asks, then changes to the simulated machine; the outputs of the real one go off."""
        question = _("Go back to the simulated machine? The outputs go off, the position is lost.")
        self._shell.ask(question, lambda: self._changed(self._control.go_simulated()))

    def _changed(self, problems: Problems) -> None:
        if problems:
            self._shell.message(_("Nothing changed"), [translated(problem) for problem in problems])


def port_lines(port: PortView, report: PortReport | None) -> list[Line]:
    """The port in use and the configured one, a line for each fact; then the report."""
    in_use = _("{port}, a real machine").format(port=port.in_use) if port.real else _("simulated")
    won = _(" (--port was given and wins)") if port.overridden else ""
    lines: list[Line] = [
        _labelled(_("In use"), in_use),
        _labelled(_("Mode"), port.mode + won),
        _labelled(_("Card"), port.card),
        _labelled(_("Its port"), port.configured or _("none drives this card")),
        [""],
    ]
    return [*lines, *(_report_lines(report) if report else [[_("F5 tests the configured port: nothing moves.")]])]


def _report_lines(report: PortReport) -> list[Line]:
    heading: Line = [("title", _("Test of {port}").format(port=report.port or "-"))]
    if report.problem:
        return [heading, [("danger", _("can't be used: {why}").format(why=translated(report.problem)))]]
    facts: list[Line] = [[translated(fact)] for fact in report.facts]
    inputs = [_input(name, reached) for name, reached in report.inputs]
    return [heading, *facts, [("good", _("It can be used. Inputs now:"))], *inputs]


def _input(name: str, reached: bool) -> Line:
    return [("lit" if reached else "body", f"{name:{LABEL_COLUMNS}}{_(WORDS[reached])}")]


def _labelled(label: str, text: str) -> Line:
    return [("title", f"{label:{LABEL_COLUMNS}}"), text]
