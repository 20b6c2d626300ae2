"""The panel's keys that type, show and write cells, and call workpieces.

Rule: nothing here moves the machine. A digit or a key that makes no sense now is refused with its reason, and the
display stays as it is.
"""

from collections.abc import Callable

from drillctl.language import Message
from drillctl.language.words import _
from drillctl.ui.boiler_drum.monitor import HEX_DIGITS, Monitor, WrongKey
from drillctl.ui.screens.shell import Shell
from drillctl.viewmodel.console import Console, MachineView
from drillctl.viewmodel.workpieces import Workpieces, WorkpieceView

HEX_KEYS = (*HEX_DIGITS.lower(),)


class Programming:
    """The part of a panel that has the display. The panel has ``_free``, ``_answer`` and ``_say`` (jog_controls.py)."""

    _free: Callable[[], bool]
    _answer: Callable[..., None]
    _say: Callable[[str, str], None]
    refresh: Callable[[MachineView], None]

    def __init__(self, console: Console, shell: Shell):
        self._of, self._shell = console, shell
        self._monitor, self._pressed = Monitor(), ""

    def typed_digit(self) -> None:
        """Types the digit of the key that was pressed; refused where none was: the finder of actions has no digit."""
        if self._pressed in HEX_KEYS:
            self.digit(self._pressed.upper())
        else:
            self._answer((Message("type the digit itself: 0 to 9, A to F"),))

    def digit(self, figure: str) -> None:
        """Types a digit; the second of a cell's content writes the cell."""
        self._do(lambda: self._digit(figure))

    def rub_out(self) -> None:
        """Takes the last digit back."""
        self._do(self._monitor.rub_out)

    def memory(self) -> None:
        """Shows the cell of the address that is typed; at a cell, the prompt, for another address."""
        if self._monitor.at_a_cell:
            self._do(self._monitor.clear)
        else:
            self._do(lambda: self._show_cell(self._monitor.wanted_address()))

    def next_cell(self, by: int) -> None:
        """Shows the cell beside the one that is shown."""
        self._do(lambda: self._show_cell(self._monitor.next_address(by)))

    def call_workpiece(self) -> None:
        """Calls the workpiece whose number is typed."""
        self._do(lambda: self._call(self._monitor.wanted_number()))

    def list_workpieces(self) -> None:
        """Offers the workpieces of both stores; the one that is chosen is called."""
        self._do(self._list)

    def _do(self, work: Callable[[], object]) -> None:
        """Does what a key asks, where the machine is free for it."""
        if not self._free():
            return
        try:
            work()
        except WrongKey as wrong:
            self._answer((wrong.message,))
            return
        self.refresh(self._of.view())

    def _digit(self, figure: str) -> None:
        content = self._monitor.digit(figure)
        if content is None:
            return
        address = self._monitor.address
        if problems := self._stores().set_cell(address, content):
            self._monitor.typed = ""
            self._answer(problems)
        else:
            self._monitor.show_cell(address, content)
            self._say("body", _("cell {address:04X} is {content:02X}").format(address=address, content=content))

    def _show_cell(self, address: int) -> None:
        content, problems = self._stores().cell(address)
        if problems:
            self._answer(problems)
        else:
            self._monitor.show_cell(address, content)

    def _list(self) -> None:
        found, problems = self._stores().listed()
        if problems or not found:
            self._answer(problems, _("both stores are empty"))
            return
        lines = [_listed(each) for each in found]
        self._shell.choose(_("Workpieces"), lines, lambda index: self._call(found[index].number))

    def _call(self, number: int) -> None:
        problems = self._stores().call(number)
        if not problems:
            self._monitor.show_workpiece(number)
        self._answer(problems, _("workpiece {number:02} is called: S (AUTO) runs it").format(number=number))

    def _stores(self) -> Workpieces:
        stores = self._of.workpieces()
        assert stores is not None, "a machine without stores has other screens"
        return stores


def _listed(each: WorkpieceView) -> str:
    text = _("{number:02}  {store:5}  from cell {cell:04X}")
    return text.format(number=each.number, store=each.store, cell=each.cell)
