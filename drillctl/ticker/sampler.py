"""What of a run is recorded: looks at the controller after each tick and writes changes into a recorder.

Rule: tick() knows no trace; this module alone knows which number becomes which signal (docs/SPEC.md, section 3).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from drillctl.execution import Controller
from drillctl.kmd import Fault, Op, Request, RequestBit
from drillctl.kmd.commands import BY_OP
from drillctl.kmd.queue import pace_of
from drillctl.machine import Machine
from drillctl.machine.shape import MOST_CARDS
from drillctl.plant import Plant
from drillctl.plant.base import CURRENT_LANES, PLACE_LANES
from drillctl.ports import CARD_BITS, CARD_MASK, word
from drillctl.trace import Recorder, Signal, VcdVar, pack_command

if TYPE_CHECKING:
    from drillctl.execution.fastforward.batch import Batch
    from drillctl.execution.fastforward.quiet import Quiet
    from drillctl.plant.forecast import PlantForecast

HAND_WORDS = ("-", *(f"{bit}={value}" for bit in range(MOST_CARDS * CARD_BITS) for value in (0, 1)))
EVERY_LANE = (*PLACE_LANES, *CURRENT_LANES)
OF_AXIS = ("column", "position", "state")
QUIET = 5  # signals in which a batch has nothing: request, hand, late, fault, pace
_OUTPUT, _PACE = int(RequestBit.OUTPUT), int(RequestBit.PACE)  # plain integers: compared in every tick
_REQUESTS = [request.name for request in Request if request]
REQUEST_WORDS = tuple(
    "+".join(name for bit, name in enumerate(_REQUESTS) if mask >> bit & 1) or "-"
    for mask in range(1 << len(_REQUESTS))
)
_FAULT_NAMES = {0: "-", **{fault.value: fault.name for fault in Fault if fault}}
_FAULT_WORDS = tuple(_FAULT_NAMES.get(code, str(code)) for code in range(max(Fault) + 1))  # codes have gaps
_COMMAND_NAMES = {0: "-", **{op.value: spec.name for op, spec in BY_OP.items()}}
_COMMAND_WORDS = tuple(_COMMAND_NAMES.get(code, str(code)) for code in range(max(Op) + 1))


class Keeper(Protocol):
    """What a sampler writes to: a trace.Recorder, or a ring that another process empties."""

    def set(self, index: int, tick: int, value: int) -> None:
        """Notes that signal ``index`` has ``value`` in ``tick``, if that is a change."""


class Sampler:
    """Fills a recorder from one controller; with ``derived`` also with columns, positions, states and plant lanes."""

    def __init__(self, controller: Controller, plant: Plant | None, derived: bool, recorder: Keeper | None = None):
        self._m = controller
        self._cards = range(controller.machine.cards)
        self._plant = plant
        self._derived = derived
        self.signals = signals(controller.machine, plant.lanes if plant else (), derived)
        self.recorder = Recorder(self.signals) if recorder is None else recorder

    def follow(self, controller: Controller) -> None:
        """Samples this controller from now on, which has the same axes and wires."""
        self._m = controller

    def sample(self) -> None:
        """Samples the tick that was run last; its index is one below the controller's count."""
        m, put = self._m, self.recorder.set
        tick = m.tick - 1
        index = 0
        for card in self._cards:
            put(index, tick, word(m.inputs, card))
            put(index + 1, tick, word(m.image, card))
            index += 2
        put(index, tick, pack_command(m.running, m.command.opcode) if m.running else 0)
        put(index + 1, tick, m.served >> 1)
        put(index + 2, tick, m.requests.hand if m.served & _OUTPUT else 0)
        put(index + 3, tick, m.late)
        put(index + 4, tick, m.fault)
        put(index + 5, tick, pace_of(m.requests.hand) if m.served & _PACE else 0)
        if self._derived:
            self._sample_axes(index + 1 + QUIET, tick)

    def sample_inputs(self) -> None:
        """Before a tick that has other inputs than the last one, and is within a stretch."""
        for card in self._cards:
            self.recorder.set(2 * card, self._m.tick, word(self._m.inputs, card))

    def sample_outputs(self, images: NDArray[np.uint64], first: int) -> None:
        """After ticks from ``first`` on that have these output images (ticks,), in which nothing else has changed."""
        assert isinstance(self.recorder, Recorder)
        changes = np.flatnonzero(np.append(True, images[1:] != images[:-1]))
        for card in self._cards:
            words = images[changes] >> np.uint64(CARD_BITS * card) & np.uint64(CARD_MASK)
            self.recorder.extend(2 * card + 1, first + changes, words.astype(np.int64))

    def sample_quiet(self, quiet: Quiet, first: int, forecast: PlantForecast) -> None:
        """Before a stretch that begins at tick ``first`` is left, as ``sample_batch``; tapes take its outputs."""
        from drillctl.ticker.tape_recorder import TapeRecorder

        if not isinstance(self.recorder, TapeRecorder):
            self.sample_outputs(quiet.shown(), first)
        for number, axis in enumerate(self._m.axes if self._derived else ()):
            motion = quiet.motion[number]
            if motion is not None:
                turns = np.full(motion.shape[1], axis.direction * axis.direction_sign)
                self._extend_axis(self._first_of(number), number, motion, turns, first, forecast)

    def _first_of(self, number: int) -> int:
        """Returns the index of an axis's first signal."""
        lanes = len(self._plant.lanes) if self._plant is not None else 0
        return 2 * len(self._cards) + 1 + QUIET + number * (len(OF_AXIS) + lanes)

    def sample_batch(self, batch: Batch, images: NDArray[np.unsignedinteger] | None, first: int,
                     forecast: PlantForecast) -> None:  # fmt: skip
        """Before a batch that begins at tick ``first`` is taken over; into a Recorder. Without its ``images`` (ticks,)
        the outputs are kept elsewhere. ``forecast`` knows the plant as it is now.
        """
        from drillctl.execution.fastforward.axis_batch import turns_of

        assert isinstance(self.recorder, Recorder)
        index = 0
        input_ticks, inputs = batch.inputs()
        for card in self._cards:
            self.recorder.extend(index, first + input_ticks, inputs >> CARD_BITS * card & CARD_MASK)
            if images is not None:
                put_out = images >> np.array(CARD_BITS * card, images.dtype) & np.array(CARD_MASK, images.dtype)
                changes = np.flatnonzero(np.append(True, put_out[1:] != put_out[:-1]))
                self.recorder.extend(index + 1, first + changes, put_out[changes].astype(np.int64))
            index += 2
        running = pack_command(batch.commands["sequence"].astype(np.int64), batch.commands["opcode"])
        self.recorder.extend(index, first + batch.starts[:-1], running)
        index += 1
        for quiet in range(index, index + QUIET):
            self.recorder.set(quiet, first, 0)
        for number, axis in enumerate(self._m.axes if self._derived else ()):
            motion = batch.motion(number)
            _, column, position, _ = motion
            turns = turns_of(axis, column, position, (axis.column, axis.position))
            self._extend_axis(self._first_of(number), number, motion, turns, first, forecast)

    def _extend_axis(self, index: int, number: int, motion: NDArray[np.int64], turns: NDArray[np.int64], first: int,
                     forecast: PlantForecast) -> None:  # fmt: skip
        """Notes an axis's signals, the first of which is at ``index``, from its motion (4, k), as Batch.motion has it.

        turns  columns put out in each row, as the wires have it, (k,)
        """
        assert isinstance(self.recorder, Recorder)
        ticks, column, position, state = motion
        axis = self._m.axes[number]
        travel = axis.travelled * axis.direction_sign
        lanes = forecast.lanes(number, travel, turns, column) if self._plant is not None else []
        for offset, values in enumerate((column + 1, position, state, *lanes)):
            self.recorder.extend(index + offset, first + ticks, values)

    def _sample_axes(self, index: int, tick: int) -> None:
        put = self.recorder.set
        for number, axis in enumerate(self._m.axes):
            put(index, tick, axis.column + 1)
            put(index + 1, tick, axis.position)
            put(index + 2, tick, axis.state)
            index += 3
            if self._plant is not None:
                for value in self._plant.lane_values(number, axis.travelled):
                    put(index, tick, value)
                    index += 1


def signals(machine: Machine, plant_lanes: Sequence[str], derived: bool) -> list[Signal]:
    """The signals of a machine's traces, in the order in which Sampler counts them. ``plant_lanes``: as a plant has
    them, none without one.
    """
    found = []
    for card in range(machine.cards):
        found += [Signal(f"in.{card}", "word", True), Signal(f"out.{card}", "word", False)]
    found += [
        Signal("kmd", "command", False, names=_COMMAND_WORDS),
        Signal("request", "name", True, names=REQUEST_WORDS),
        Signal("hand", "name", True, names=HAND_WORDS),
        Signal("late", "count", True),
        Signal("fault", "name", False, names=_FAULT_WORDS),
        Signal("pace", "count", True, optional=True),
    ]
    if derived:
        for name in machine.axis_names:
            found += [Signal(f"{name}.{field}", "count", False, True) for field in OF_AXIS]
            found += [Signal(f"plant.{name}{lane}", "count", False, True) for lane in plant_lanes]
    return found


def wire_names(machine: Machine) -> dict[str, list[str]]:
    """The bits of each card's output word by name, from bit 0: ``x.2a`` as the phase table calls the wire, an output as
    the machine's file does; empty where nothing is connected.
    """
    names = {f"out.{card}": [""] * CARD_BITS for card in range(machine.cards)}
    wires = [
        (f"{axis.name}.{wire}", bit)
        for axis in machine.axes
        for wire, bit in zip(axis.phase.wire_names(), axis.wire_bits, strict=True)
    ]
    for name, bit in (*wires, *machine.outputs):
        names[f"out.{bit // CARD_BITS}"][bit % CARD_BITS] = name
    for number in machine.output_words:
        for place in range(number.bits):
            card, bit = divmod(number.bit + place, CARD_BITS)
            names[f"out.{card}"][bit] = f"{number.name}.{place}"
    return names


def vcd_layout(machine: Machine) -> list[VcdVar]:
    """Scopes of the VCD form: an axis's wires as its phase table names them, then sensors, kmd, and all that any plant
    has.
    """
    layout = []
    for axis in machine.axes:
        for wire, bit in zip(axis.phase.wire_names(), axis.wire_bits, strict=True):
            layout.append(VcdVar(axis.name, wire, "wire", f"out.{bit // CARD_BITS}", bit=bit % CARD_BITS))
        for field in OF_AXIS:
            layout.append(VcdVar(axis.name, field, "integer", f"{axis.name}.{field}"))
    for line in machine.input_lines:
        card, bit = divmod(line.bit, CARD_BITS)
        inverted = line.active_level == 0
        layout.append(VcdVar("sensors", line.name, "wire", f"in.{card}", bit=bit, invert=inverted))
    for side, scope, words in (("out", "outputs", machine.output_words), ("in", "sensors", machine.input_words)):
        for number in words:
            card, bit = divmod(number.bit, CARD_BITS)
            layout.append(VcdVar(scope, number.name, "integer", f"{side}.{card}", bit=bit, bits=number.bits))
    layout += [
        VcdVar("kmd", "seq", "integer", "kmd", part="seq"),
        VcdVar("kmd", "opcode", "integer", "kmd", part="opcode"),
        VcdVar("kmd", "running", "string", "kmd", part="running"),
    ]
    fields = [f"{name}{lane}" for name in machine.axis_names for lane in EVERY_LANE]
    return [*layout, *(VcdVar("plant", field, "integer", f"plant.{field}") for field in fields)]
