"""What a program will take on the ideal plant, to the tick, from the machine file's start position.

Rule: exact or not at all. Moves of X and Y follow from the ramp's travel table; what ends on a sensor (initialisation,
strokes of the head) is run by the tick itself, once for each place it begins from, since the ideal plant always
answers alike. A program that holds anything else is run whole. Called by estimate and by run, for the time left.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd import Op
from drillctl.kmd.commands import Flag
from drillctl.machine import Machine, travel_table
from drillctl.wiring.ticker import Ticker

Ticks = NDArray[np.int64]
LONGEST_COMMAND_TICKS = 100_000_000
MOVES = (Op.GOTO_X_Y, Op.GOTO_DXDY)
HEAD = (Op.WIERTLO_DOL, Op.WIERTLO_GORA, Op.RUCH)
STILL = (Op.NARZEDZIE, Op.WYJSCIE, Op.WRZECIONO, Op.PREDKOSC, Op.CZEKAJ, Op.KONIEC)


@dataclass(frozen=True, eq=False)
class Forecast:
    """``ticks`` (n,) of each command, as far as they are run; ``fault`` is the code that ends the program, or 0."""

    ticks: Ticks
    fault: int

    @property
    def total_ticks(self) -> int:
        """Ticks of the whole program."""
        return int(self.ticks.sum())


def forecast(program: NDArray[np.void], machine: Machine) -> Forecast:
    """The ticks of a program, dtype kmd.RECORD, numbered from 1. A board's is quick, any other is run."""
    if _is_board(program, machine):
        waits = program["opcode"] == Op.CZEKAJ
        ticks = np.where(waits, np.maximum(program["args"][:, 0], 1), 1).astype(np.int64)
        _fill_moves(program, machine, ticks)
        if _fill_heads(program, machine, ticks):
            return Forecast(ticks, 0)
    return _run_whole(program, machine)


def _is_board(program: NDArray[np.void], machine: Machine) -> bool:
    """Initialised first; then moves of X and Y at full speed, strokes of the heads alone, switches."""
    ops = program["opcode"]
    heads = sum(1 << axis for axis in machine.drill_axes)
    head_alone = (program["axes"] & ~np.uint8(heads)) == 0
    allowed = np.isin(ops, (*MOVES, *STILL)) | (np.isin(ops, HEAD) & head_alone)
    linked = program["flags"] & Flag.LINKED
    absolute = (program["flags"] & Flag.ABSOLUTE).astype(bool) == np.isin(ops, (Op.GOTO_X_Y, Op.RUCH))
    begins = len(program) > 0 and ops[0] == Op.INICJALIZACJA
    plain = not linked.any() and not program["floor_ticks"].any() and absolute.all()
    return bool(begins and plain and allowed[1:].all())


def _fill_moves(program: NDArray[np.void], machine: Machine, ticks: Ticks) -> None:
    """A move takes the greater of its axes' times, at least 1 tick; X and Y start at machine zero."""
    moves = np.flatnonzero(np.isin(program["opcode"], MOVES))
    absolute = program["opcode"][moves] == Op.GOTO_X_Y
    longest = np.ones(len(moves), np.int64)
    for name in ("x", "y"):
        index = machine.axis_names.index(name)
        axis = machine.axes[index]
        given = program["args"][moves, index].astype(np.int64)
        distance = np.abs(_distances(given, absolute))
        table = travel_table(axis.ramp, int(distance.max(initial=0)), columns_per_step=axis.columns_per_step)
        longest = np.maximum(longest, table[distance])
    ticks[moves] = longest


def _distances(given: Ticks, absolute: NDArray[np.bool_]) -> Ticks:
    """Signed steps of each move, from places and from distances mixed, beginning at 0."""
    if absolute.all():
        return np.diff(given, prepend=0)
    here, made = 0, np.empty(len(given), np.int64)
    for move, (value, is_place) in enumerate(zip(given.tolist(), absolute.tolist(), strict=True)):
        made[move] = value - here if is_place else value
        here += made[move]
    return made


def _fill_heads(program: NDArray[np.void], machine: Machine, ticks: Ticks) -> bool:
    """Initialisation and strokes, run one by one until they repeat. False where that can't be carried through."""
    rig = _Rig(machine)
    known: dict[tuple[object, ...], tuple[int, object]] = {}
    place: object = None
    for index in np.flatnonzero(np.isin(program["opcode"], (Op.INICJALIZACJA, *HEAD))).tolist():
        record = program[index]
        key = (place, int(record["opcode"]), int(record["axes"]), record["args"].tobytes())
        if key not in known:
            if rig.place() != place and place is not None:
                return False  # the shortcut has left the rig behind, and something new is asked from here
            known[key] = (rig.run(record), rig.place())
        ticks[index], place = known[key]
        if rig.faulty():
            return False
    return True


class _Rig:
    """A machine of its own on which single commands are tried."""

    def __init__(self, machine: Machine):
        self._ticker = Ticker.simulated(machine)
        self._heads = machine.drill_axes

    def run(self, record: np.void) -> int:
        """Ticks that one command takes from here."""
        m = self._ticker.controller
        self._ticker.queue.put(np.array([record]))
        return self._ticker.run(LONGEST_COMMAND_TICKS, lambda: not m.busy and not m.moving)

    def place(self) -> tuple[object, ...]:
        """All that the next stroke depends on: where the heads are, what their rotors and sensors say."""
        m, plant = self._ticker.controller, self._ticker.plant
        assert plant is not None
        axes = [(m.axes[i].position, m.axes[i].column, plant.rotors[i].degrees) for i in self._heads]
        return (*axes, m.sensors, plant.inputs)

    def faulty(self) -> bool:
        """A command has ended in a fault."""
        return self._ticker.controller.fault != 0


def _run_whole(program: NDArray[np.void], machine: Machine) -> Forecast:
    """The program as it would be run, feeding the queue as the desk does."""
    ticker = Ticker.simulated(machine)
    ticks = np.zeros(len(program), np.int64)
    m, put = ticker.controller, 0

    def counted() -> bool:
        if m.running:
            ticks[m.running - 1] += 1
        return ticker.over()

    over = False
    while not over:
        put += ticker.queue.put(program[put:][: ticker.queue.room])
        ticker.run(max(1, len(ticker.queue)), counted)
        over = ticker.over()
    return Forecast(ticks, m.fault)


