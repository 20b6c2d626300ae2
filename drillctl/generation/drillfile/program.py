"""Runs the text of a drill file. Rule: a faulty line is noted and passed over, so that a person sees
several faults at once; the first one refuses the file.

`reader` calls `run` with the text from intake.py.
"""

from __future__ import annotations

import re

from drillctl.generation.waits import Advance, ignored
from drillctl.language import Message

from . import afterend, comments
from .commands import execute
from .errors import PROBLEM_LIMIT, Complaint, Remark, shorten
from .facts import Facts
from .intake import LINE_LIMIT
from .lexer import split_comment, split_run
from .machine import Machine

LONG_MESSAGE = re.compile(r"\s*M45(?!\d)", re.I)  # for the operator; it goes on while a line ends with a backslash
COMMAND_LIMIT = 40_000  # lines that are no plain holes; a drill file has dozens, a milled panel thousands


def run(
    text: str, facts: Facts, after_end: str = afterend.REFUSE, advance: Advance = ignored
) -> tuple[Machine, list[Remark]]:
    """The machine after the whole text, and the problems found on the way (at most PROBLEM_LIMIT).

    after_end: what becomes of holes behind M30, one of afterend.CHOICES; advance: is called with how much of
    the text is read.
    """
    machine = Machine(facts)
    tail = afterend.Tail(after_end)
    problems: list[Remark] = []
    torn = not text.endswith("\n")
    text += "\n" * torn
    at, machine.line, commands = 0, 1, 0
    while at < len(text) and len(problems) < PROBLEM_LIMIT:
        end, columns = split_run(text, at) if machine.drilling else (at, [])
        end = end if columns else text.index("\n", at) + 1
        try:
            if columns:
                machine.recognised = True
                machine.drill(columns)
            elif not (machine.ended and tail.takes(machine, text[at:end])):
                commands += end - at > 1
                _line(machine, text[at:end], commands)
        except Complaint as refusal:
            problems.append(_problem(machine, refusal, text[at:end]))
            if refusal.fatal:
                break
        machine.line += text.count("\n", at, end)
        at = end
        advance(at, len(text))
    _finish(machine, tail, text[text.rfind("\n", 0, -1) + 1 :] if torn else "", problems)
    return machine, problems


def _line(machine: Machine, line: str, commands: int) -> None:
    if commands > COMMAND_LIMIT:
        raise Complaint("file-too-large", Message("more than {count} commands", count=COMMAND_LIMIT), fatal=True)
    if machine.in_message or LONG_MESSAGE.match(line):
        machine.in_message = line.rstrip().endswith("\\")
        return
    command, comment = split_comment(line)
    if len(line) > LINE_LIMIT:
        if command:
            raise Complaint("line-too-long", command[:LINE_LIMIT])
        machine.remark("line-too-long")
    if comment:
        comments.hear(comment, machine.line, machine.facts)
    if command:
        execute(machine, command)


def _problem(machine: Machine, refusal: Complaint, sentence: str) -> Remark:
    """The refusal with its line. Before anything was understood, it is the file that is wrong."""
    text = refusal.text or shorten(sentence)
    if refusal.code == "unknown-command" and not machine.recognised:
        refusal.code, refusal.fatal = "not-a-drill-file", True
    return Remark(refusal.code, machine.line, text)


def _finish(machine: Machine, tail: afterend.Tail, torn: str, problems: list[Remark]) -> None:
    """Close the program at its last line; a file of comments alone holds nothing.

    torn: the last line where it has no line end. If it is a command, and M30 is missing, a part of it may be missing.
    """
    machine.line = max(1, machine.line - 1)
    try:
        tail.finish(machine)
        machine.finish()
        if not (machine.recognised or problems):
            raise Complaint("empty-file")
        if torn and split_comment(torn)[0] and not (machine.ended or machine.stopped):
            raise Complaint("cut-short", torn)
    except Complaint as refusal:
        problems.append(Remark(refusal.code, machine.line, refusal.text))
