"""The rows of a sweep's results, one for each machine, worked out chunk by chunk: the moves of a chunk run in fleets,
boards one after the other.

Rule: the size of a chunk depends on the question alone, so that its rows are the same bytes on any number of processes.
"""

from functools import cache

import numpy as np

from drillctl.lab.board import Board
from drillctl.lab.moves import Move, move, starts
from drillctl.lab.question import Question, Variant
from drillctl.lab.trials import LANES, Trial, errors_full_steps, lost
from drillctl.machine import AxisTable
from drillctl.viewmodel.fault_texts import FAULT_WORDS

FIXED_HEAD = ("phase", "ramp", "tick_hz")
MOVES_TAIL = ("load_nm", "draw", "moves", "lost", "worst_full_steps")
BOARD_TAIL = ("draw", "holes", "lost", "lost_steps", "worst_mm", "seconds", "fault")
QUESTION = "question"  # the last column: which question the row answers
MARK = "sweep2-"  # before its digest, so that nobody takes sixteen digits for a number
BOARDS_A_CHUNK = 4
FAULT_NAMES = {int(fault): fault.name for fault in FAULT_WORDS}


def head(question: Question) -> str:
    """The first line of the table: the names of its columns."""
    tail = MOVES_TAIL if question.board is None else BOARD_TAIL
    return ",".join((*FIXED_HEAD, *(name for name, _ in question.times), *tail, QUESTION))


def mark(question: Question) -> str:
    """The value of the last column, the same in every row of a question."""
    return MARK + question.digest


def moves_a_machine(question: Question) -> int:
    """How many moves are tried with each machine."""
    return len(question.steps) * 2 * len(starts(question.axis))


def chunk_size(question: Question) -> int:
    """How many machines make a chunk: as many as fill a fleet of LANES, or a few boards."""
    if question.board is not None:
        return BOARDS_A_CHUNK
    return max(1, LANES // moves_a_machine(question))


def chunks(question: Question, begin: int = 0) -> list[range]:
    """The machine numbers of each chunk, from the chunk with machine ``begin`` on; empty where none is left."""
    if begin == question.machines:
        return []
    size = chunk_size(question)
    firsts = range(begin - begin % size, question.machines, size)
    return [range(first, min(first + size, question.machines)) for first in firsts]


def answer(question: Question, chunk: range) -> list[str]:
    """The rows of a chunk, in the order of its machines."""
    variants = [question.variant(number) for number in chunk]
    if question.board is not None:
        return [_board_row(question, question.board, variant) for variant in variants]
    rows: dict[int, str] = {}
    for phase in dict.fromkeys(variant.phase for variant in variants):
        places = [place for place, variant in enumerate(variants) if variant.phase == phase]
        found = _tried(question, [variants[place] for place in places])
        rows.update(zip(places, found, strict=True))
    return [rows[place] for place in sorted(rows)]


def _tried(question: Question, variants: list[Variant]) -> list[str]:
    """The rows of machines with the same phase table, tried in one fleet."""
    moves = cache(_moves)
    trials = [
        Trial(each, variant.tick_hz, variant.dynamics, variant.load_nm)
        for variant in variants
        for each in moves(variant.axis, question.steps)
    ]
    errors = errors_full_steps(variants[0].axis, trials).reshape(len(variants), -1)
    return [_row(question, *each) for each in zip(variants, lost(errors), np.abs(errors).max(axis=1), strict=True)]


def _moves(axis: AxisTable, steps: tuple[int, ...]) -> list[Move]:
    return [move(axis, way * distance, start) for distance in steps for way in (1, -1) for start in starts(axis)]


def _board_row(question: Question, board: Board, variant: Variant) -> str:
    """The row of one machine that drills the board; each draw has its own seed of what scatters."""
    axis, own = variant.axis, question.axis
    ramp = None if axis.ramp == own.ramp else axis.ramp
    phase = None if axis.phase == own.phase else axis.phase
    machine = board.on(variant.tick_hz, ramp, phase, variant.scales)
    found = board.drilled(machine, question.seed + variant.draw)
    parameters = (repr(getattr(variant.dynamics, name)) for name, _ in question.times)
    seconds = f"{found.ticks / variant.tick_hz:.3f}"
    counted = (variant.draw, found.holes, int(not found.sound), found.lost_steps, f"{found.worst_mm:.4f}", seconds)
    head = (variant.phase, variant.axis.ramp.name, str(variant.tick_hz))
    return ",".join((*head, *parameters, *map(str, counted), FAULT_NAMES.get(found.fault, ""), mark(question)))


def _row(question: Question, variant: Variant, losing: np.ndarray, worst: np.float64) -> str:
    parameters = (repr(getattr(variant.dynamics, name)) for name, _ in question.times)
    tried = (repr(variant.load_nm), str(variant.draw), str(len(losing)), str(losing.sum()), f"{worst:.4f}")
    return ",".join((variant.phase, variant.axis.ramp.name, str(variant.tick_hz), *parameters, *tried, mark(question)))
