"""``drillctl plot TRACE``: pictures of a recorded run on the dynamic plant: speed, lag, currents, the board as drilled,
the pull-out curve of its motors. In the terminal, or with ``--out`` as PNG or SVG.
"""

import argparse
from pathlib import Path

from drillctl.cli import drawing, options

WHAT = ("speed", "lag", "board", "currents", "pull-out")
MOST_TICKS = 10**12


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("plot", help="draw what the motors did in a run", description=__doc__)
    verb.add_argument("trace", type=Path, metavar="TRACE", help="what run --trace wrote")
    verb.add_argument("--what", choices=WHAT, default="lag", help="what to draw; default: %(default)s")
    verb.add_argument("--axis", metavar="NAME", help="axis to draw; default: the one that moved farthest")
    verb.add_argument("--from-tick", type=_tick, default=0, metavar="N", help="first tick drawn; default: 0")
    verb.add_argument("--to-tick", type=_tick, metavar="N", help="draw up to this tick")
    verb.add_argument("--out", type=Path, metavar="F.png|.svg", help="a file (needs matplotlib); default: the terminal")
    options.add_tables(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """The output is reserved before the run is made again."""
    with drawing.drawn(arguments.out, (arguments.trace,)) as draw:
        from drillctl.lab.dynamic_rerun import rerun_axis
        from drillctl.lab.pictures import PICTURES, Window

        run = rerun_axis(arguments.trace, options.library(arguments), arguments.axis)
        draw(PICTURES[arguments.what](run, Window(arguments.from_tick, arguments.to_tick)))
    return 0


def _tick(text: str) -> int:
    return options.whole_number(text, 0, MOST_TICKS)
