"""``drillctl sweep``: thousands of machines on the dynamic plant, tick rate x ramp x friction x phase table: which lose
steps, in single moves or on a whole board. A row a machine; an interrupted sweep goes on where it was when it is asked
for again.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import board_trials, drawing, options, streams
from drillctl.language import Message
from drillctl.viewmodel.choices import GREATEST_SPREAD, MOST_DRAWS, MOST_WORKERS

if TYPE_CHECKING:
    from drillctl.lab.question import Question
    from drillctl.lab.sweep import Results, WorkerPool
    from drillctl.machine import Library, Machine

VALUES = "N,N,... or FROM:TO:STEP"
STEPS = "1,10,100"


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("sweep", help="try thousands of variants of a machine", description=__doc__)
    verb.add_argument(
        "--machine", default=options.DEFAULT_MACHINE, metavar="NAME|FILE", help="machine; default: %(default)s"
    )
    options.add_tables(verb)
    verb.add_argument("--axis", metavar="NAME", help="axis to try; default: the first; with --board: X and Y")
    verb.add_argument("--hz", metavar="VALUES", help=f"rates, {VALUES}; default: the machine's")
    verb.add_argument("--ramp", metavar="NAME,...", help="names; direct-start: no ramp; default: the axis's")
    phases = "phase tables, by name, or broken on purpose ('forcing removed'; 'broken': all such); default: the axis's"
    verb.add_argument("--phase", metavar="NAME,...", help=phases)
    vary = "factors for a parameter of the axis's dynamics: coulomb_nm=0.5:2:0.25; repeatable"
    verb.add_argument("--vary", action="append", default=[], metavar="NAME=VALUES", help=vary)
    verb.add_argument("--load-nm", metavar="VALUES", help="resisting torque in N m; default: 0")
    verb.add_argument("--steps", metavar="VALUES", help=f"lengths of the moves; default: {STEPS}")
    _add_draws(verb)
    verb.add_argument(
        "--out", type=Path, required=True, metavar="F.csv", help="file of results; one that was begun is continued"
    )
    verb.add_argument("--picture", type=Path, metavar="F.png|.svg", help="draw into this file, not in the terminal")
    heat = "draw the two factors with most values as a heat map, as with --board"
    verb.add_argument("--heat", action="store_true", help=heat)
    drawing.add_theme(verb)
    verb.add_argument("--workers", type=options.up_to(MOST_WORKERS), metavar="N", help="processes; default: all cores")
    verb.add_argument("--cluster", metavar="ADDRESS", help="send the work to a dask scheduler, tcp://HOST:PORT")
    board_trials.add_board(verb)
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Runs or continues the sweep and draws it; the question is checked whole before the first machine is tried."""
    from drillctl.lab.sweep import Results, WorkerPool
    from drillctl.lab.sweep_picture import losing, sweep_picture
    from drillctl.lab.workers import cores

    library = options.library(arguments)
    machine = library.machine(arguments.machine)
    question = _question(arguments, machine, library)
    with drawing.drawn(arguments.picture, (arguments.out,), arguments.theme) as draw:
        with Results(arguments.out, question) as results:
            _work(question, results, WorkerPool(arguments.workers or cores(), arguments.cluster))
        draw(sweep_picture(question, losing(arguments.out, question), machine.name, arguments.heat))
    return 0


def _add_draws(verb: argparse.ArgumentParser) -> None:
    draws = "machines at each point, with parameters drawn at random within --spread; default: %(default)s"
    verb.add_argument("--draws", type=options.up_to(MOST_DRAWS), default=1, metavar="N", help=draws)
    verb.add_argument("--spread", type=_share, default=0.0, metavar="F", help="0.03: within 3 %%; default: %(default)s")
    verb.add_argument("--seed", type=int, default=0, metavar="N", help="seed of the draws; default: %(default)s")


def _question(arguments: argparse.Namespace, machine: "Machine", library: "Library") -> "Question":
    from drillctl.cli.number_lists import numbers, whole_numbers
    from drillctl.lab.question import FASTEST_HZ, GREATEST_LOAD_NM, LONGEST_STEPS, SLOWEST_HZ, Question
    from drillctl.lab.tables import axis_of, phases, ramps

    board_trials.check_only_with_board(arguments)
    rates_hz = whole_numbers(arguments.hz or str(machine.tick_hz), "--hz", SLOWEST_HZ, FASTEST_HZ)
    axis, board = axis_of(machine, arguments.axis), None
    if arguments.board is not None:
        _check_no_moves(arguments)
        axes = board_trials.varied_axes(arguments, machine)
        axis, board = machine.axes[axes[0]], board_trials.board_of(arguments, machine, axes, rates_hz)
    return Question(
        axis,
        rates_hz,
        ramps(arguments.ramp, axis, library),
        phases(arguments.phase, axis, library),
        tuple(_varied(text) for text in arguments.vary),
        numbers(arguments.load_nm or "0", "--load-nm", 0, GREATEST_LOAD_NM),
        () if board else whole_numbers(arguments.steps or STEPS, "--steps", 1, LONGEST_STEPS),
        arguments.draws,
        arguments.spread,
        arguments.seed,
        board,
    )


def _check_no_moves(arguments: argparse.Namespace) -> None:
    """Raises LabError for options of single moves beside a board."""
    from drillctl.lab.errors import LabError

    for option, value in (("--load-nm", arguments.load_nm), ("--steps", arguments.steps)):
        if value is not None:
            raise LabError(Message("is for single moves; with --board leave it out").at(option))


def _varied(text: str) -> tuple[str, tuple[float, ...]]:
    from drillctl.cli.number_lists import numbers
    from drillctl.lab.question import FACTORS

    name, _, values = text.partition("=")
    return name, numbers(values, f"--vary {name}", *FACTORS)


def _work(question: "Question", results: "Results", pool: "WorkerPool") -> None:
    """Runs the sweep, with a progress bar on a terminal."""
    from tqdm import tqdm

    from drillctl.lab.sweep import sweep

    if results.rows:
        streams.note(f"{results.path}: {results.rows} of {question.machines} machines are done")
    stream = streams.bar(sys.stderr)
    with tqdm(total=question.machines, initial=results.rows, unit="machine", disable=None, file=stream) as bar:
        for rows in sweep(question, results, pool):
            bar.update(rows - bar.n)


def _share(text: str) -> float:
    return options.number(text, 0.0, GREATEST_SPREAD)
