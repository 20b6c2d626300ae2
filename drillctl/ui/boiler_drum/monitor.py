"""The six-digit display and what is typed into it, as the machine's monitor program has them; no widget is known here.

Rule: pure. A key that makes no sense now raises WrongKey with the reason and changes nothing.

    -          the prompt
    0 0 C 6    digits typed: MEM takes four as an address, PROG two as the number of a workpiece
    00C6 81    an address and its content; a digit typed now begins a new content, which two digits complete
    0 3        the workpiece that was called
"""

from dataclasses import dataclass
from typing import Literal

from drillctl.language import Message

FIGURES = 6
ADDRESS_DIGITS, CONTENT_DIGITS, NUMBER_DIGITS = 4, 2, 2
LAST_ADDRESS = 0xFFFF
PROMPT = "-"
HEX_DIGITS = "0123456789ABCDEF"
Shows = Literal["prompt", "digits", "cell", "workpiece"]


class WrongKey(Exception):
    """A key that makes no sense now. ``message`` says why, and what does."""

    def __init__(self, message: Message):
        super().__init__(str(message))
        self.message = message


@dataclass
class Monitor:
    """The display. ``shows`` is what stands there: see the table above.

    typed    digits that are typed and not yet taken: of an address or a number, or of a cell's new content
    address  of the cell that is shown, ``content`` what it holds
    number   of the workpiece that was called
    """

    shows: Shows = "prompt"
    typed: str = ""
    address: int = 0
    content: int = 0
    number: int = 0

    def figures(self) -> str:
        """The six figures: hexadecimal digits, ``-`` and spaces."""
        found = {
            "prompt": PROMPT,
            "digits": self.typed,
            "cell": f"{self.address:04X}{self._content()}",
            "workpiece": f"{self.number:02}",
        }[self.shows]
        return f"{found:{FIGURES}}"

    def digit(self, figure: str) -> int | None:
        """Types a hexadecimal digit. Returns the new content of the cell that is shown, once both digits are typed."""
        if self.shows == "cell":
            if len(self.typed) + 1 < CONTENT_DIGITS:
                self.typed += figure
                return None
            return int(self.typed + figure, 16)
        typed = self.typed if self.shows == "digits" else ""
        if len(typed) == ADDRESS_DIGITS:
            raise WrongKey(Message("four digits are typed: MEM shows the cell; Backspace takes one back"))
        self.shows, self.typed = "digits", typed + figure
        return None

    def rub_out(self) -> None:
        """Takes the last digit back; shows the prompt again where no digit of an address or number is left."""
        left = self.typed[:-1]
        if left or (self.shows == "cell" and self.typed):
            self.typed = left
        else:
            self.clear()

    @property
    def at_a_cell(self) -> bool:
        """Whether a cell is shown, and no digit of a new content is typed."""
        return self.shows == "cell" and not self.typed

    def clear(self) -> None:
        """Forgets what was typed and shows the prompt."""
        self.shows, self.typed = "prompt", ""

    def wanted_address(self) -> int:
        """The address that is typed. Raises WrongKey where it is not four digits."""
        if self.shows != "digits" or len(self.typed) != ADDRESS_DIGITS:
            raise WrongKey(Message("MEM takes an address of four digits, 0000 to 1FFF; type it first"))
        return int(self.typed, 16)

    def next_address(self, by: int) -> int:
        """The address beside that of the cell that is shown. Raises WrongKey where no cell is shown, or half a content
        is typed.
        """
        if self.shows != "cell":
            raise WrongKey(Message("ADR+ and ADR- go on from a cell: four digits, then MEM"))
        if self.typed:
            raise WrongKey(Message("a content is two digits: type the second, or take the first back (Backspace)"))
        if not 0 <= self.address + by <= LAST_ADDRESS:
            raise WrongKey(Message("there is no cell beyond {address}", address=f"{self.address:04X}"))
        return self.address + by

    def show_cell(self, address: int, content: int) -> None:
        """Shows an address of four digits and the content of its cell, which the next two digits replace."""
        self.shows, self.typed, self.address, self.content = "cell", "", address, content

    def wanted_number(self) -> int:
        """The number of a workpiece that is typed. Raises WrongKey where it is not 01 to 99."""
        right = self.shows == "digits" and len(self.typed) == NUMBER_DIGITS and self.typed.isdecimal()
        if not right or not int(self.typed):
            raise WrongKey(Message("PROG takes the number of a workpiece, two decimal digits, 01 to 99; type it first"))
        return int(self.typed)

    def show_workpiece(self, number: int) -> None:
        """Shows the number of the workpiece that was called."""
        self.shows, self.typed, self.number = "workpiece", "", number

    def _content(self) -> str:
        return f"{self.typed}{PROMPT}" if self.typed else f"{self.content:02X}"
