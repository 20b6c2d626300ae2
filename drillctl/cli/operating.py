"""The operator at the terminal while a job runs: shows progress, asks for tools, hears keys. For run and resume."""

import argparse
import sys
from dataclasses import replace
from typing import TYPE_CHECKING

from drillctl.cli import streams
from drillctl.language import Message

if TYPE_CHECKING:
    from drillctl.jobs.outcome import JobResult
    from drillctl.jobs.session import Session
    from drillctl.ui.terminal.wait import Wait


def operated(session: "Session", arguments: argparse.Namespace) -> "JobResult":
    """Runs the job, with progress on standard error, and with keys where somebody sits at a terminal.

    Raises JobError where tools are to be asked for and there is no terminal; what ``Session.run`` raises.
    """
    from drillctl.jobs.keys import HELP, TerminalKeys
    from drillctl.ticker.launch import REAL, pace_of
    from drillctl.ui.terminal.progress import ProgressView, ToolPrompt

    with waiting() as wait:
        session = session.with_forecast(wait)
    session = replace(session, most_held_s=float(arguments.hold_limit))
    asks, paced = _asks(arguments, session.running.port), pace_of(session.running) == REAL
    with ProgressView(streams.bar(sys.stderr), by_clock=paced) as view:
        if not asks and not (paced and _has_watcher(arguments)):
            return session.run(view.show)
        if paced:
            streams.note(HELP)
        with TerminalKeys(sys.stdin) as keys:
            prompt = ToolPrompt(keys.entered, sys.stderr) if asks else None
            return replace(session, tool_change=prompt, operator=keys if paced else None).run(view.show)


def waiting() -> "Wait":
    """What is done before a verb's answer, shown to a person at a terminal (``with waiting() as wait``)."""
    from drillctl.ui.terminal.wait import Wait

    return Wait(streams.bar(sys.stderr))


def _asks(arguments: argparse.Namespace, spec: str) -> bool:
    """Returns whether a tool change waits for the operator."""
    from drillctl.generation.errors import JobError
    from drillctl.jobs.keys import has_keys
    from drillctl.portio.registry import select

    port, _ = select(spec)
    asks = (arguments.tools or ("ask" if port.real else "assume")) == "ask"
    if asks and not has_keys(sys.stdin):
        raise JobError(
            Message("--tools ask: there is no terminal to ask at; say --tools assume if the right tool is in")
        )
    return asks


def _has_watcher(arguments: argparse.Namespace) -> bool:
    """Returns whether a person started the job, and not a program that reads its JSON."""
    from drillctl.jobs.keys import has_keys

    return not arguments.json and sys.stderr.isatty() and has_keys(sys.stdin)
