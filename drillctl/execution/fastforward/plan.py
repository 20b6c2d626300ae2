"""How many of the commands that wait can be foreseen, and what batch they make.

Rule: all are judged at once. The batch ends before a command that is of another kind, or would be refused, or moves an
axis to where a sensor answers, or is the first stroke of its kind.
"""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.fastforward.axis_batch import AxisBatch
from drillctl.execution.fastforward.batch import Batch, Stroked
from drillctl.execution.fastforward.input_changes import IndexWatch
from drillctl.execution.fastforward.move_profile import MoveProfile
from drillctl.execution.fastforward.strokes import Stroke, Strokes
from drillctl.execution.fastforward.world import PlantFacts
from drillctl.kmd import Op
from drillctl.kmd.commands import MOST_AXES, Flag
from drillctl.ports import with_bits
from drillctl.trace.tapes import Count

MOVES = (Op.GOTO_DXDY, Op.GOTO_X_Y, Op.RUCH, Op.RUCH_D)
STROKES = (Op.WIERTLO_DOL, Op.WIERTLO_GORA)
STILL = (Op.CZEKAJ, Op.PREDKOSC, Op.NARZEDZIE, Op.WYJSCIE, Op.WRZECIONO, Op.KONIEC)

Rows = NDArray[np.bool_]
Records = NDArray[np.void]
ProfileOf = Callable[[int, int, int], MoveProfile]  # by axis, direction and min_interval


def foresee(m: Controller, world: PlantFacts, strokes: Strokes, profile: ProfileOf, commands: Records) -> Batch | None:
    """The batch of as many commands, dtype kmd.RECORD (n,), as can be foreseen; None where that is none."""
    stroked = _stroked(commands, strokes.heads) & m.position_known  # else it matters where a head was before
    commands = commands[: _beginning(_of_a_kind(m, commands, stroked, strokes.heads))]
    heads = strokes.heads if stroked.any() else ()
    axis_batches = [
        None if index in heads else _axis_batch(m, index, partial(profile, index), commands)
        for index in range(len(m.axes))
    ]  # fmt: skip
    clear = [_clear(m, world, index, j) for index, j in enumerate(axis_batches) if j is not None]
    commands = commands[: _beginning(np.logical_and.reduce([*clear, np.ones(len(commands), bool)]))]
    rows, known = _known(strokes, commands, np.flatnonzero(stroked[: len(commands)]))
    commands = commands[: rows[len(known)] if len(known) < len(rows) else len(commands)]
    rows = rows[: len(known)]
    delay = _delay(m, commands, rows, known)
    made = [j and j.upto(len(commands), delay) for j in axis_batches]
    if not len(commands) or not all(j is None or j.timed() for j in made):
        return None
    mask = strokes.mask if len(rows) else 0
    indexed = [(index, j) for index, j in enumerate(made) if j is not None and world.index_mask(index)]
    turning = sum(world.index_mask(index) for index, _ in indexed)
    return Batch(
        commands=commands,
        ticks=_ticks(commands, made, rows, known),
        axis_batches=made,
        stroked=Stroked.of(heads, mask, strokes.here(), rows, known),
        switched=_switched(m, commands),
        tools=_latest(commands["args"][:, 0], commands["opcode"] == Op.NARZEDZIE, m.tool),
        holes=_latest(commands["tag"], _begins_hole(commands), m.hole_begun),
        inputs_before=world.inputs,
        still_inputs=world.inputs & ~(mask | turning),
        indexes=[IndexWatch.of(world, index, axis_batch) for index, axis_batch in indexed],
    )


def is_stroke(commands: Records, heads: Sequence[int]) -> Rows:
    """The commands that heads alone carry out, or begin before other axes start: (n,)."""
    alone = commands["axes"] & ~_mask(heads) == 0
    moves = np.isin(commands["opcode"], MOVES) & (commands["axes"] > 0)
    stroke: Rows = (np.isin(commands["opcode"], STROKES) | moves) & alone | (commands["opcode"] == Op.GORA_X_Y)
    return stroke


def _stroked(commands: Records, heads: Sequence[int]) -> Rows:
    """The strokes; none where the first command that moves a head moves another axis too."""
    stroke, moves = is_stroke(commands, heads), np.isin(commands["opcode"], (*MOVES, *STROKES, Op.GORA_X_Y))
    touching = np.flatnonzero(stroke | (moves & (commands["axes"] & _mask(heads) > 0)))
    return stroke if len(touching) and stroke[touching[0]] else np.zeros(len(commands), bool)


def _mask(axes: Sequence[int]) -> np.uint16:
    return np.uint16(sum(1 << axis for axis in axes))


def _of_a_kind(m: Controller, commands: Records, stroked: Rows, heads: Sequence[int]) -> Rows:
    """Moves of axes that don't stroke, strokes, and what moves nothing; not discarded, and with an output that is."""
    ops, first = commands["opcode"], commands["args"][:, 0]
    busy = _mask(heads if stroked.any() else ())
    moves = np.isin(ops, MOVES) & (commands["axes"] & busy == 0) & (commands["flags"] & Flag.LINKED == 0)
    there = np.array([m.output_mask >> bit & 1 for bit in range(256)], bool)[first & 0xFF]
    still = np.isin(ops, STILL) & (there | (ops != Op.WYJSCIE))
    acted_on = (ops == Op.WYJSCIE) & np.array([m.answered >> bit & 1 for bit in range(256)], bool)[first & 0xFF]
    still &= ~_turns_spindle(m, commands) & ~acted_on  # else the plant changes inputs
    return (moves | stroked | still) & (commands["epoch"] == m.epoch)


def _turns_spindle(m: Controller, commands: Records) -> Rows:
    """The commands after which a machine's measured spindle speed, an input, changes."""
    ops, bit = commands["opcode"], m.spindle_mask.bit_length() - 1
    switched = (ops == Op.WYJSCIE) & (commands["args"][:, 0] & 0xFF == bit)
    return (switched | (ops == Op.WRZECIONO)) & bool(m.machine.output_words or m.machine.input_words)


def _axis_batch(m: Controller, index: int, profiles: Callable[[int, int], MoveProfile], commands: Records) -> AxisBatch:
    sent = np.isin(commands["opcode"], (*MOVES, Op.GORA_X_Y)) & (commands["axes"] >> index & 1 > 0)
    absolute = commands["flags"] & Flag.ABSOLUTE > 0
    given, min_interval = commands["args"][:, index].astype(np.int64), commands["floor_ticks"].astype(np.int64)
    return AxisBatch.of(m.axes[index], profiles, given, absolute, sent, min_interval)


def _clear(m: Controller, world: PlantFacts, index: int, axis_batch: AxisBatch) -> Rows:
    """Nothing would be refused, and no sensor answers on the way or is already met."""
    axis, absolute = m.axes[index], axis_batch.absolute & axis_batch.sent
    allowed = _in_reach(axis, axis_batch) if m.position_known else ~absolute & _within_travel(axis, axis_batch)
    travel = axis.travelled + (axis_batch.position - axis.position) * axis.columns_per_step
    low, high = world.free_of_switches(index)
    met = (world.inputs ^ m.polarity) & (axis.limits[1] | axis.limits[-1])
    free = (low < travel * axis.direction_sign) & (travel * axis.direction_sign < high) & (met == 0)
    clear: Rows = (allowed | ~axis_batch.sent) & ((free[1:] & free[:-1]) | (axis_batch.steps == 0))
    return clear


def _in_reach(axis: Axis, axis_batch: AxisBatch) -> Rows:
    """Says for every command what Axis.in_reach says for one."""
    (low, high), before, target = axis.reach, axis_batch.position[:-1], axis_batch.position[1:]
    within: Rows = (np.minimum(low, before) <= target) & (target <= np.maximum(high, before))
    return within


def _within_travel(axis: Axis, axis_batch: AxisBatch) -> Rows:
    """Axis.within_travel for every command: each adds to where the axis was."""
    before, target = axis_batch.position[:-1], axis_batch.position[1:]
    least = np.minimum(axis.least, np.minimum.accumulate(before))
    most = np.maximum(axis.most, np.maximum.accumulate(before))
    within: Rows = np.maximum(most, target) - np.minimum(least, target) <= axis.span
    return within | ((least <= target) & (target <= most))


def _known(strokes: Strokes, commands: Records, rows: NDArray[np.intp]) -> tuple[NDArray[np.intp], list[Stroke]]:
    """All rows of strokes, and what the first of them do, as far as that is known: from place to place."""
    place, known = strokes.here(), []
    for command in signatures(commands[rows], _mask(strokes.heads)):
        stroke = place.known.get(command)
        if stroke is None:
            break
        known.append(stroke)
        place = stroke.after
    return rows, known


def signatures(commands: Records, heads: np.uint16) -> list[bytes]:
    """All that a stroke's motion depends on, for each command; ``heads`` is the mask of what strokes."""
    plain = commands.copy()
    for name in ("sequence", "epoch", "tag"):
        plain[name] = 0
    plain["axes"] &= heads
    plain["args"][:, [not int(heads) >> index & 1 for index in range(MOST_AXES)]] = 0
    data, size = plain.tobytes(), plain.itemsize
    return [data[begin : begin + size] for begin in range(0, len(data), size)]


def _ticks(
    commands: Records, axis_batches: Sequence[AxisBatch | None], rows: NDArray[np.intp], known: list[Stroke]
) -> Count:
    """The longest of what a command waits for, and at least 1."""
    waits = np.where(commands["opcode"] == Op.CZEKAJ, commands["args"][:, 0], 1).astype(np.int64)
    ticks = np.maximum.reduce([np.maximum(waits, 1), *(j.ends() for j in axis_batches if j is not None)])
    ticks[rows] = np.maximum(ticks[rows], [stroke.ticks for stroke in known])
    return ticks


def _delay(m: Controller, commands: Records, rows: NDArray[np.intp], known: list[Stroke]) -> Count:
    """The ticks of each command before the axes that don't stroke start: 0, but where they wait for the heads."""
    delay, clear = np.zeros(len(commands), np.int64), m.machine.drill_clear_steps
    lifts = commands["opcode"][rows] == Op.GORA_X_Y
    lifting = [stroke for stroke, lifts_too in zip(known, lifts.tolist(), strict=True) if lifts_too]
    after = {stroke: stroke.clear_after(clear) for stroke in set(lifting)}
    delay[rows[lifts]] = [after[stroke] for stroke in lifting]
    return delay


def _switched(m: Controller, commands: Records) -> NDArray[np.uint64]:
    """The output bits that are no axis's, as each command leaves them."""
    switched, values = m.switched, np.zeros(len(commands) + 1, np.uint64)
    changes = np.flatnonzero(np.isin(commands["opcode"], (Op.WYJSCIE, Op.WRZECIONO)))
    values[0] = switched
    for row in changes.tolist():
        op, (first, second) = commands["opcode"][row], commands["args"][row, :2].tolist()
        bits, on = (1 << (first & 0xFF), second) if op == Op.WYJSCIE else (m.spindle_mask, first > 0)
        switched = with_bits(switched, bits, on)
        values[row + 1] = switched
    latest = np.zeros(len(commands), np.intp)
    latest[changes] = changes + 1
    return values[np.maximum.accumulate(latest)]


def _begins_hole(commands: Records) -> Rows:
    return np.isin(commands["opcode"], (*MOVES, Op.WIERTLO_DOL)) & (commands["tag"] != 0)


def _latest(values: NDArray[np.int32], rows: Rows, before: int) -> Count:
    """The value of the last of these rows so far, (n,)."""
    all_values = np.concatenate(([before], values))
    return all_values[np.maximum.accumulate(np.where(rows, np.arange(1, len(rows) + 1), 0))]


def _beginning(good: Rows) -> int:
    """How many rows from the first are good."""
    return len(good) if good.all() else int(np.argmin(good))
