"""Options that several verbs share, and what they stand for."""

import argparse
import json
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drillctl.machine import Library, Machine
    from drillctl.wiring.desk import Run, ToolChange, Watcher
    from drillctl.wiring.outputs import Output

DEFAULT_MACHINE = "pcb-drill"


def add_machine(verb: argparse.ArgumentParser) -> None:
    """``--machine``, ``--tables`` and ``--tick-hz``."""
    verb.add_argument("--machine", default=DEFAULT_MACHINE, metavar="NAME|FILE", help="default: %(default)s")
    add_tables(verb)
    verb.add_argument("--tick-hz", type=_rate, metavar="N", help="interrupt frequency; default: the machine's own")


def add_tables(verb: argparse.ArgumentParser) -> None:
    """``--tables``."""
    verb.add_argument("--tables", type=Path, metavar="DIR", help="look for tables here first")


def library(arguments: argparse.Namespace) -> "Library":
    """The tables to be searched. Raises TableError for a folder that is not there."""
    from drillctl.machine import Library, TableError

    if arguments.tables is not None and not arguments.tables.is_dir():
        raise TableError(arguments.tables, "no such folder")
    return Library.standard(arguments.tables)


def machine(arguments: argparse.Namespace) -> "Machine":
    """The machine asked for, at the rate asked for. Raises TableError."""
    found = library(arguments).machine(arguments.machine)
    return found if arguments.tick_hz is None else found.at_rate(arguments.tick_hz)


def _rate(text: str) -> int:
    from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ

    return whole_number(text, SLOWEST_TICK_HZ, FASTEST_TICK_HZ)


def whole_number(text: str, least: int, most: int) -> int:
    """An option's value. Raises ArgumentTypeError for anything but a whole number within the bounds."""
    if not text.isdecimal() or not least <= int(text[:20]) <= most:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is not a whole number from {least} to {most}")
    return int(text)


def add_running(verb: argparse.ArgumentParser) -> None:
    """``--port`` and ``--pace``."""
    where = "default: %(default)s; see drillctl ports"
    verb.add_argument("--port", default="simulated", metavar="NAME[:ADDRESS]", help=where)
    pace = "real: by the clock, in a process of its own; default: as the port wants"
    verb.add_argument("--pace", choices=("free", "real"), help=pace)


def add_tools(verb: argparse.ArgumentParser) -> None:
    """``--tools``."""
    verb.add_argument(
        "--tools", choices=("ask", "assume"),
        help="at a tool change: ask on the terminal, or take it as made; default: ask on a real port",
    )  # fmt: skip


def tool_change(arguments: argparse.Namespace) -> "ToolChange | None":
    """What desk asks at a tool change. Raises JobError where it should ask and nobody sits at a terminal."""
    from drillctl.generation.errors import JobError
    from drillctl.portio.registry import select
    from drillctl.ui.tools import on_terminal

    port, _ = select(arguments.port)
    if (arguments.tools or ("ask" if port.real else "assume")) == "assume":
        return None
    prompt = on_terminal()
    if prompt is None:
        raise JobError(["--tools ask: there is no terminal to ask at; say --tools assume if the right tool is in"])
    return prompt


def add_results(verb: argparse.ArgumentParser) -> None:
    """``--holes`` and ``--json``."""
    verb.add_argument("--holes", type=Path, metavar="F", help="write the holes as the plant made them (CSV)")
    verb.add_argument("--json", action="store_true", help="print the outcome as one JSON object")


def shown(run: "Callable[[Watcher], Run]") -> "Run":
    """Runs with the progress on standard error."""
    from drillctl.ui.progress import ProgressView

    with ProgressView(sys.stderr) as view:
        return run(view.show)


def write_holes(done: "Run", output: "Output | None") -> None:
    """The holes CSV (docs/SPEC.md, section 3), where one was asked for."""
    if output is not None:
        output.write(lambda file: file.writelines(_holes_csv(done)))


def _holes_csv(done: "Run") -> "Iterator[str]":
    yield "tool,diameter_mm,x_mm,y_mm\n"
    for hole in done.holes:
        diameter = "" if hole.diameter_mm is None else f"{hole.diameter_mm:.4f}"
        yield f"{hole.tool},{diameter},{hole.x_mm:.4f},{hole.y_mm:.4f}\n"


def told(done: "Run", as_json: bool) -> int:
    """Prints how a run ended; returns its exit code."""
    from drillctl.ui.summary import summary_lines
    from drillctl.wiring.interrupts import exit_code

    for notice in done.notices:
        print(f"drillctl: {notice}", file=sys.stderr)
    if as_json:
        print(json.dumps(done.outcome.as_dict(), indent=2))
    else:
        print("\n".join(summary_lines(done.outcome)))
    if done.trouble:
        print(f"drillctl: {done.trouble}", file=sys.stderr)
    if done.signal is not None:
        return exit_code(done.signal)
    return 1 if done.outcome.fault or done.trouble else 0
