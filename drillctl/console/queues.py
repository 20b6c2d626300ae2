"""Queues of commands as the queue editor sees them (viewmodel/tables.py).

Rule: a queue is checked by the parser that runs it.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

from drillctl.files.inputs import read_bytes
from drillctl.files.outputs import write_text
from drillctl.generation.job import names_of
from drillctl.kmd import COMMANDS, KmdError, Names, Op, parse_program
from drillctl.kmd.commands import BY_OP, ArgumentForm
from drillctl.language import Counted, Message, message_of
from drillctl.machine import Machine
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.tables import CommandHelp, TextFinding

MOVES = (ArgumentForm.XY, ArgumentForm.MOVES)  # their arguments are steps, by axis
LARGEST_QUEUE_BYTES = 256 * 1024  # more than a person writes by hand; all of it is checked at every key


class QueueFiles:
    """A QueueEditing. ``machine`` returns the machine in use, for whose axes and wires queues are checked."""

    def __init__(self, machine: Callable[[], Machine]):
        self._machine = machine

    def commands(self) -> list[CommandHelp]:
        """Every command with its usage and meaning, from the table of kmd."""
        return [CommandHelp(spec.name, spec.usage, spec.meaning) for spec in COMMANDS.values()]

    def words(self) -> list[str]:
        """The names that may stand in a queue: of axes, outputs and sensors."""
        names = self._names()
        return [*names.axes, *names.outputs, *names.inputs]

    def check_queue(self, text: str) -> tuple[TextFinding, ...]:
        """All wrong lines, each checked alone; where there are none, what is wrong with the queue as a whole."""
        return tuple(_wrong_lines(text, self._names())) or tuple(_wrong(text, self._names(), 0))

    def too_far(self, text: str) -> tuple[TextFinding, ...]:
        """Moves of a sound queue that are longer than the axis: they can't fit, wherever they begin."""
        return tuple(_too_far(text, self._machine())) if text.strip() else ()

    def open_queue(self, file: str) -> tuple[str, Problems]:
        """The text of a queue file, which is UTF-8; or an empty text and why it can't be read."""
        try:
            data = read_bytes(file, LARGEST_QUEUE_BYTES, Message("a queue to be edited; run it as it is"))
            return data.decode("utf-8-sig"), ()
        except UnicodeDecodeError:
            return "", (Message("not UTF-8 text, so not a queue").at(file),)
        except OSError as error:
            return "", (Message("can't be read: {why}", why=message_of(error)).at(file),)

    def save_queue(self, file: str, text: str) -> Problems:
        """Writes a queue to a file, sound or not: it may be finished later."""
        return write_text(Path(file), text)

    def _names(self) -> Names:
        return names_of(self._machine())


def _lines(text: str) -> Iterator[tuple[int, str]]:
    """The lines that hold a command, with their numbers from 1."""
    lines = enumerate(text.split("\n"), start=1)
    return ((number, line) for number, line in lines if line.partition("#")[0].strip())


def _wrong_lines(text: str, names: Names) -> Iterator[TextFinding]:
    for number, line in _lines(text):
        yield from _wrong(line, names, number - 1)


def _too_far(text: str, machine: Machine) -> Iterator[TextFinding]:
    for number, line in _lines(text):
        command = parse_program(line, names_of(machine))[0]
        if BY_OP[Op(int(command["opcode"]))].form not in MOVES:
            continue
        for axis, steps in zip(machine.axes, command["args"].tolist(), strict=False):
            if abs(steps) > (span := axis.span_steps):
                name = axis.name.upper()
                yield TextFinding(
                    number,
                    Counted(
                        "{count} step reaches beyond the work range, which is {span} long",
                        "{count} steps reach beyond the work range, which is {span} long",
                        steps,
                        span=span,
                    ).at(name),
                )


def _wrong(text: str, names: Names, lines_before: int) -> Iterator[TextFinding]:
    try:
        parse_program(text, names)
    except KmdError as error:
        yield TextFinding(lines_before + error.line, error.reason, error.column)
