"""What stands behind the end of the program (M30). Rule: holes there are never lost in silence.

A line or two that drill nothing are what editors leave. One stray line of coordinates is left out with a warning: the
machine stops at M30, and it is the rest of an older text. More than that, or a tool, a header or another end, is a
program of its own: refused, unless a person says what to do with it. `program` asks for every line behind M30.
"""

from __future__ import annotations

import re

from .errors import Complaint, shorten
from .lexer import split_comment
from .machine import Machine

REFUSE, IGNORE, DRILL = CHOICES = ("refuse", "ignore", "drill")
STRAY_LINES = 1
DRILLS = re.compile(r"[XYR]|G8\d|M0?2|M9[789]")  # words that make holes, wherever they stand in a line
PROGRAM = re.compile(r"[TR]\d|M48|M0?[02]|M30|M25")
SILENT = frozenset({"", "%"})


class Tail:
    """The lines behind M30 of one file."""

    def __init__(self, choice: str) -> None:
        self._choice = choice
        self._first: tuple[int, str] | None = None
        self._drilling_lines = 0
        self._is_program = False

    def takes(self, machine: Machine, line: str) -> bool:
        """Whether the line belongs to the tail; False where it begins the next program that shall be drilled too."""
        command, _ = split_comment(line)
        if command in SILENT:
            return True
        if self._choice == DRILL and (DRILLS.search(command) or PROGRAM.search(command)):
            machine.begin_next_program()
            return False
        self._first = self._first or (machine.line, command)
        self._drilling_lines += bool(DRILLS.search(command))
        self._is_program = self._is_program or bool(PROGRAM.search(command))
        return True

    def finish(self, machine: Machine) -> None:
        """Warn of the tail, or refuse it; at its first line."""
        if not self._first:
            return
        last, (machine.line, command) = machine.line, self._first
        program = self._drilling_lines and (self._is_program or self._drilling_lines > STRAY_LINES)
        if program and self._choice == REFUSE:
            raise Complaint("holes-after-end", f"{shorten(command)}; lines that drill: {self._drilling_lines}")
        machine.remark("data-after-end", shorten(command))
        machine.line = last
