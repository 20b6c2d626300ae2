"""Runs the text of a drill file. Rule: a faulty line is noted and passed over, so that a person sees
several faults at once; the first one refuses the file.

`reader` calls `run` with the text from intake.py.
"""

from __future__ import annotations

from . import comments
from .commands import execute
from .errors import PROBLEM_LIMIT, Refusal, Remark, shorten
from .facts import Facts
from .intake import LINE_LIMIT
from .lexer import split_comment, split_run
from .machine import Machine

COMMAND_LIMIT = 40_000  # lines that are no plain holes; a drill file has dozens, a milled panel thousands


def run(text: str, facts: Facts) -> tuple[Machine, list[Remark]]:
    """The machine after the whole text, and the problems found on the way (at most PROBLEM_LIMIT)."""
    machine = Machine(facts)
    problems: list[Remark] = []
    if not text.endswith("\n"):
        text += "\n"
    at, machine.line, commands = 0, 1, 0
    while at < len(text) and len(problems) < PROBLEM_LIMIT:
        end, columns = split_run(text, at) if machine.drilling else (at, [])
        end = end if columns else text.index("\n", at) + 1
        try:
            if columns:
                machine.recognised, machine.stopped = True, False
                machine.drill(columns)
            else:
                commands += end - at > 1
                _line(machine, text[at:end], commands)
        except Refusal as refusal:
            problems.append(_problem(machine, refusal, text[at:end]))
            if refusal.fatal:
                break
        machine.line += text.count("\n", at, end)
        at = end
    _finish(machine, problems)
    return machine, problems


def _line(machine: Machine, line: str, commands: int) -> None:
    if commands > COMMAND_LIMIT:
        raise Refusal("file-too-large", f"more than {COMMAND_LIMIT} commands", fatal=True)
    command, comment = split_comment(line)
    if len(line) > LINE_LIMIT:
        if command:
            raise Refusal("line-too-long", command[:LINE_LIMIT])
        machine.remark("line-too-long")
    if comment:
        comments.hear(comment, machine.line, machine.facts)
    if not command:
        return
    if machine.ended:
        _after_end(machine, command)
        return
    machine.stopped = False
    execute(machine, command)


def _after_end(machine: Machine, command: str) -> None:
    if command != "%" and not any(remark.code == "data-after-end" for remark in machine.remarks):
        machine.remark("data-after-end", shorten(command))


def _problem(machine: Machine, refusal: Refusal, sentence: str) -> Remark:
    """The refusal with its line. Before anything was understood, it is the file that is wrong."""
    text = refusal.text or shorten(sentence)
    if refusal.code == "unknown-command" and not machine.recognised:
        refusal.code, refusal.fatal = "not-a-drill-file", True
    return Remark(refusal.code, machine.line, text)


def _finish(machine: Machine, problems: list[Remark]) -> None:
    """Close the program at its last line; a file of comments alone holds nothing."""
    machine.line = max(1, machine.line - 1)
    try:
        machine.finish()
        if not (machine.recognised or problems):
            raise Refusal("empty-file")
    except Refusal as refusal:
        problems.append(Remark(refusal.code, machine.line, refusal.text))
