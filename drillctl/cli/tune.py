"""``drillctl tune MACHINE``: finds the fastest ramp of an axis that loses no steps, on the dynamic plant, with a torque
margin; proves that it lands exactly, and writes it as a table with the evidence in its comments. With ``--board`` the
fastest tick rate and ramp for one board, of those at hand.
"""

import argparse
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import board_trials, options, streams
from drillctl.language import Message

if TYPE_CHECKING:
    from drillctl.files.outputs import Output

LEAST_MARGIN, GREATEST_MARGIN = 1.0, 5.0
FASTEST_HZ = 20_000
FOR_A_BOARD = (("--hz", "hz"), ("--ramp", "ramp"))
FOR_A_RAMP = (("--tick-hz", "tick_hz"), ("--name", "name"), ("--out", "out"))


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("tune", help="find the fastest ramp that loses no steps", description=__doc__)
    verb.add_argument("machine", metavar="MACHINE", help="its name, or its file")
    options.add_tables(verb)
    axis = "axis to tune; default: the first, with --board those that carry the board"
    verb.add_argument("--axis", metavar="NAME", help=axis)
    margin = "the ramp must hold with a load F times as heavy; default: %(default)s"
    verb.add_argument("--margin", type=_margin, default=1.3, metavar="F", help=margin)
    verb.add_argument("--tick-hz", type=options.up_to(FASTEST_HZ), metavar="N", help="default: the machine's own")
    verb.add_argument("--name", metavar="NAME", help="name of the ramp; default: tuned-MACHINE-AXIS")
    where = "default: NAME.toml among the user's own ramps; an existing file is never overwritten"
    verb.add_argument("--out", type=Path, metavar="F.toml", help=where)
    rates = "with --board: rates to try, N,N,... or FROM:TO:STEP; default: from half to twice the machine's, by 5 %%"
    verb.add_argument("--hz", metavar="VALUES", help=rates)
    ramps = "with --board: ramps to try beside the machine's own; default: direct-start"
    verb.add_argument("--ramp", metavar="NAME,...", help=ramps)
    board_trials.add_board(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Tunes for single moves, or for a board. Raises LabError for options of the other one."""
    _check_options(arguments)
    return _ramp(arguments) if arguments.board is None else _board(arguments)


def _check_options(arguments: argparse.Namespace) -> None:
    from drillctl.lab.errors import LabError

    board_trials.check_only_with_board(arguments)
    given = arguments.board is not None
    for option, value in FOR_A_BOARD if not given else FOR_A_RAMP:
        if getattr(arguments, value) is not None:
            where = "not with" if given else "only with"
            raise LabError(Message("{where} --board", where=where).at(option))


def _board(arguments: argparse.Namespace) -> int:
    """Prints the setting that was found; nothing is written."""
    from drillctl.cli.number_lists import whole_numbers
    from drillctl.lab.question import FASTEST_HZ, SLOWEST_HZ
    from drillctl.lab.tables import DIRECT_START, ramps
    from drillctl.lab.tune_board import board_lines, tune_board

    library = options.library(arguments)
    machine = library.machine(arguments.machine)
    axes = board_trials.varied_axes(arguments, machine)
    own = {round(machine.tick_hz * 1.05**power) for power in range(-14, 15)}
    rates_hz = whole_numbers(arguments.hz, "--hz", SLOWEST_HZ, FASTEST_HZ) if arguments.hz else sorted(own)
    kept = [hz for hz in rates_hz if SLOWEST_HZ <= hz <= FASTEST_HZ]
    tried = ramps(arguments.ramp or DIRECT_START, machine.axes[axes[0]], library)
    board = board_trials.board_of(arguments, machine, axes, sorted({*kept, machine.tick_hz}))
    tuned = tune_board(board, tried, arguments.margin, lambda line: streams.tell(f"{line}"))
    print("\n".join(board_lines(tuned, board, arguments.margin)))
    return 0


def _ramp(arguments: argparse.Namespace) -> int:
    """The table is named and its place looked at before the search, and written after the proof."""
    from drillctl.lab.ramp_trials import Bench
    from drillctl.lab.tables import axis_of, check_name
    from drillctl.lab.tune import evidence_lines, ramp_text, tune
    from drillctl.machine.library import user_tables

    machine = options.library(arguments).machine(arguments.machine)
    axis = axis_of(machine, arguments.axis)
    name = check_name(arguments.name or f"tuned-{machine.name}-{axis.name}")
    out = arguments.out or user_tables() / "ramp" / f"{name}.toml"
    bench = Bench(axis, arguments.tick_hz or machine.tick_hz, arguments.margin)
    with _new(out) as output:
        tuned = tune(bench, name, lambda line: streams.tell(f"{line}"))
        text = ramp_text(tuned, bench, machine)
        output.write(lambda file: file.write(text))
    print("\n".join(evidence_lines(tuned, bench, machine)))
    print(f'{out}: to use it, say ramp = "{name}" for axis {axis.name} in the file of {machine.name}')
    return 0


@contextmanager
def _new(out: Path) -> "Iterator[Output]":
    """A place for a file that is not there yet, in a folder made where need be. Raises OutputError, OSError."""
    from drillctl.files.outputs import OutputError, reserved

    if os.path.lexists(out):
        raise OutputError(Message("{out}: is there already; give another --name or --out", out=out))
    out.parent.mkdir(parents=True, exist_ok=True)
    with reserved([out], []) as (output,):
        assert output is not None
        yield output


def _margin(text: str) -> float:
    return options.number(text, LEAST_MARGIN, GREATEST_MARGIN)
