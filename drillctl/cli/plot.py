"""``drillctl plot RUN``: pictures of a run. Of a trace: speed, lag, both, currents, the board as drilled, the pull-out
curve of its motors. Of a holes CSV: the board, with true diameters. In the terminal, or with ``--out`` as PNG or SVG.
"""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import drawing, options
from drillctl.language import Message

if TYPE_CHECKING:
    from drillctl.lab.dynamic_rerun import AxisRun
    from drillctl.lab.pictures import Window
    from drillctl.viewmodel.reports import Picture

WHAT = ("speed", "lag", "motion", "board", "currents", "pull-out")
HOLES = ".csv"
MOST_TICKS = 10**12
MOST_SECONDS = 10**9


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("plot", help="draw what the motors did in a run", description=__doc__)
    what = "what run --trace wrote; or what run --holes wrote (.csv)"
    verb.add_argument("trace", type=Path, metavar="RUN", help=what)
    verb.add_argument("--what", choices=WHAT, help="what to draw; motion: speed and lag; default: lag, of a CSV board")
    verb.add_argument("--axis", metavar="NAME", help="axis to draw; default: the one that moved farthest")
    verb.add_argument("--from-tick", type=_tick, metavar="N", help="first tick drawn; default: 0")
    verb.add_argument("--to-tick", type=_tick, metavar="N", help="draw up to this tick")
    verb.add_argument("--seconds", type=_seconds, metavar="FROM:TO", help="draw from one time to another, e.g. 1.8:2.4")
    add_holes(verb)
    verb.add_argument("--out", type=Path, metavar="F.png|.svg", help="a file (needs matplotlib); default: the terminal")
    drawing.add_theme(verb)
    options.add_tables(verb)
    verb.set_defaults(call=call)


def add_holes(verb: argparse.ArgumentParser) -> None:
    """Adds ``--holes`` to a verb that draws a board from a trace, which knows no diameters."""
    verb.add_argument("--holes", type=Path, metavar="F.csv", help="the run's holes CSV: true diameters on the board")


def call(arguments: argparse.Namespace) -> int:
    """The output is reserved before the run is made again."""
    inputs = (arguments.trace, *filter(None, [arguments.holes]))
    with drawing.drawn(arguments.out, inputs, arguments.theme) as draw:
        draw(_board(arguments) if arguments.trace.suffix.lower() == HOLES else _of_trace(arguments))
    return 0


def _board(arguments: argparse.Namespace) -> "Picture":
    """The picture of a holes CSV. Raises LabError for what it knows nothing of."""
    from drillctl.lab.errors import LabError
    from drillctl.lab.hole_table import read_holes
    from drillctl.lab.pictures import board_picture

    if arguments.what not in (None, "board"):
        reason = Message("--what {what} needs a trace: run --trace F", what=arguments.what)
        raise LabError(reason.at(arguments.trace))
    return board_picture(f"{arguments.trace.name}: board as drilled", read_holes(arguments.trace))


def _of_trace(arguments: argparse.Namespace) -> "Picture":
    from dataclasses import replace

    from drillctl.lab.dynamic_rerun import rerun_axis
    from drillctl.lab.hole_table import diameters, read_holes, with_diameters
    from drillctl.lab.pictures import PICTURES

    sizes = diameters(read_holes(arguments.holes)) if arguments.holes else {}
    run = rerun_axis(arguments.trace, options.library(arguments), arguments.axis)
    if sizes:
        run = replace(run, holes=with_diameters(run.holes, sizes))
    return PICTURES[arguments.what or "lag"](run, _window(arguments, run))


def _window(arguments: argparse.Namespace, run: "AxisRun") -> "Window":
    """Ticks of ``--seconds``, else of ``--from-tick`` and ``--to-tick``. Raises LabError for both."""
    from drillctl.lab.errors import LabError
    from drillctl.lab.pictures import Window

    if arguments.seconds is None:
        return Window(arguments.from_tick or 0, arguments.to_tick)
    if arguments.from_tick is not None or arguments.to_tick is not None:
        raise LabError(Message("--seconds, or --from-tick and --to-tick: one of both"))
    return Window(*(round(seconds * run.machine.tick_hz) for seconds in arguments.seconds))


def _tick(text: str) -> int:
    return options.whole_number(text, 0, MOST_TICKS)


def _seconds(text: str) -> tuple[float, float]:
    begin, _, end = text.partition(":")
    return options.number(begin or "0", 0, MOST_SECONDS), options.number(end or str(MOST_SECONDS), 0, MOST_SECONDS)
