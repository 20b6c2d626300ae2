"""A ticker that goes through its queue as fast as may be, on the ideal plant, with the same result to the byte.

Rule: what execution/fastforward can work out is taken over in whole batches of commands; every other command is run by
``tick``, but for ticks in which axes only count. Holes, trace and status come out as if every tick had been run. Only
where nothing live is attached.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.fastforward.batch import Batch
from drillctl.execution.fastforward.engine import Engine
from drillctl.execution.fastforward.quiet import Quiet, foresee_quiet, leave_quiet
from drillctl.kmd import Condition, Queue
from drillctl.machine import Machine
from drillctl.plant import IdealPlant
from drillctl.plant.forecast import PlantForecast
from drillctl.portio.simulated import SimulatedCard
from drillctl.ticker.sampler import Sampler, signals
from drillctl.ticker.tape_recorder import TapeRecorder
from drillctl.ticker.ticker import NEVER, Ticker, axes_met
from drillctl.trace import Recorder, Segments, Trace
from drillctl.trace.tapes import Images, Tape, images

MOST_KEPT_TICKS = 1 << 32  # in one turn: 4096 of rest take 16 bytes of a record, whose room is looked at between turns
MOST_TICKS = 1 << 22  # of a batch whose images are put together at once; a command that is longer is ticked
FAR_SIGHT = 4096  # commands that may wait: a look ahead costs the same for few as for many

Records = NDArray[np.void]


@dataclass
class FastTicker(Ticker):
    """A Ticker with a simulated card and the ideal plant behind it.

    rotors      the derived signals have the plant's lanes too
    in_batches  False: every tick of every command is run by itself
    taped       the record is kept in the segment form, in place of a trace
    """

    rotors: bool = False
    in_batches: bool = True
    taped: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        assert isinstance(self.plant, IdealPlant) and isinstance(self.queue, Queue)
        self.forecast = PlantForecast(self.machine, self.plant)
        self.engine = Engine(self.controller, self.forecast)
        if self.derived:
            self.sampler = Sampler(self.controller, self.plant if self.rotors else None, True, self.keeper)
        if self.taped:
            kept = signals(self.machine, (), derived=False)
            recorder = TapeRecorder(kept, self.engine.pool, len(self.machine.axes) + 1)
            self.sampler = Sampler(self.controller, self.plant, False, recorder)

    def load(self, machine: Machine) -> None:
        """Like the method of Ticker; what was worked out by the old tables is dropped."""
        super().load(machine)
        self._new_engine()

    def follow_rate(self) -> None:
        """Like the method of Ticker; what was worked out by the old limits of time is dropped."""
        super().follow_rate()
        self._new_engine()

    def _new_engine(self) -> None:
        assert isinstance(self.plant, IdealPlant)
        self.forecast = PlantForecast(self.machine, self.plant)
        self.engine = Engine(self.controller, self.forecast, self.engine.pool)

    @classmethod
    def ideal(cls, machine: Machine, traced: bool = False, capacity: int = FAR_SIGHT, in_batches: bool = True,
              taped: bool = False, keeper: Recorder | None = None, rotors: bool = False) -> "FastTicker":  # fmt: skip
        """The machine on the simulated card, with the ideal plant behind it, and a queue of this capacity.

        keeper  takes every signal, derived ones too, with ``rotors`` also the plant's lanes; whoever made it empties it
        """
        plant = IdealPlant(machine)
        return cls(
            machine, SimulatedCard(plant), plant, traced, keeper is not None, Queue(capacity), keeper=keeper,
            rotors=rotors, in_batches=in_batches, taped=taped,
        )  # fmt: skip

    def turn(self, until: Callable[[], bool] | None = None, before: int = NEVER) -> int:
        """Runs all that waits in the queue; where no batch can be made, as many ticks as the queue is sure to last, or
        until one can be made again. Ticks that were passed at once may be more.
        """
        m = self.controller
        first = m.tick
        for _ in self.batches(before):
            if (until is not None and until()) or (self.taped and m.tick - first > MOST_KEPT_TICKS):
                break
        if m.tick > first:
            return m.tick - first
        if self.gate.paused:
            return super().turn(until, before)
        for _ in range(max(1, len(self.queue))):
            if m.tick >= before:
                break
            self._step(before)
            if self._may_stop(until):
                break
        return m.tick - first

    def _may_stop(self, until: Callable[[], bool] | None) -> bool:
        return self.engine.between or (until is not None and until())

    def batches(self, before: int = NEVER) -> Iterator[Batch | None]:
        """Runs what waits in the queue while nothing else goes on; yields each batch, or None after a command that was
        run tick by tick.
        """
        assert isinstance(self.queue, Queue)
        while len(self.queue) and not self.gate.paused and self.engine.between:
            waiting, left = self.queue.waiting(), before - self.controller.tick
            if self.traced and not self.taped:
                left = min(left, MOST_TICKS)
            batch = self.engine.foresee(waiting) if self.in_batches else None
            if batch is not None and self.taped and batch.end > MOST_KEPT_TICKS:
                batch = self.engine.foresee(waiting[: np.searchsorted(batch.starts, MOST_KEPT_TICKS, side="right")])
            if batch is not None and batch.end > left:
                batch = self.engine.foresee(waiting[: np.searchsorted(batch.starts, left, side="right") - 1])
            if batch is not None:
                self.queue.drop(len(batch.commands))
                self._pass(batch)
            elif left > 0:
                self._tick_through(waiting[:1], before)
            else:
                return
            yield batch

    def _pass(self, batch: Batch) -> None:
        """Takes a batch over as if it had been ticked: into the record, the holes and the state of the machine."""
        first, tapes = self.controller.tick, batch.tapes(self.engine.pool) if self.sampler is not None else []
        if self.sampler is not None:
            images = None if self.taped else self._images(batch, tapes)
            self.sampler.sample_batch(batch, images, first, self.forecast)
        for touch in batch.touches:
            self.touch(*touch)
        self.engine.leave(batch)
        assert self.plant is not None
        self._touches, self._met = self.plant.touches, self.plant.met.copy()
        if self.sampler is not None and isinstance(self.sampler.recorder, TapeRecorder):
            self.sampler.recorder.lay(first, tapes, self.controller.tick, self.controller.image)

    def _images(self, batch: Batch, tapes: list[Tape]) -> Images:
        pool = self.engine.pool.images
        return images(pool, tapes, np.empty(batch.end, pool.dtype))

    def record(self, header: Iterable[tuple[str, str]]) -> Trace | Segments | None:
        """The record of the run so far: segments where it is taped, else a trace."""
        if self.sampler is None or not isinstance(self.sampler.recorder, TapeRecorder):
            return super().record(header)
        return self.sampler.recorder.segments(self.controller.tick, header)

    def _tick_through(self, command: Records, before: int) -> None:
        """Runs one command by tick, column by column, and notes how it went where such a command may come again."""
        m = self.controller
        recording = self.engine.recording(command)
        going_on = True
        while going_on:
            met, first = self._met, m.tick
            quiet = foresee_quiet(m, self.forecast, before - first) if self.in_batches else None
            if quiet is not None:
                self._pass_quiet(quiet)
            else:
                self._step(before)
            if recording is not None and quiet is not None:
                recording.note_quiet(quiet)
            elif recording is not None:
                now_met = axes_met(met, self._met)
                recording.note(now_met, self.places() if now_met else (), m.tick - first)
            going_on = self._goes_on() and m.tick < before
        if recording is not None and self._undisturbed() and not m.busy:
            recording.end()

    def _pass_quiet(self, quiet: Quiet) -> None:
        """Takes a stretch over as if it had been ticked: into the record and the state of the machine."""
        if self.sampler is not None:
            self.sampler.sample_quiet(quiet, self.controller.tick, self.forecast)
            if isinstance(self.sampler.recorder, TapeRecorder):
                self.sampler.recorder.lay_strip(self.controller.tick, quiet.shown())
        leave_quiet(self.controller, self.forecast, quiet)

    def _step(self, before: int) -> None:
        """Passes the ticks before the next column together, as nothing of the record changes in them; or runs one."""
        if not self.in_batches or not self.pass_counting(before - self.controller.tick):
            self.run(1)

    def _goes_on(self) -> bool:
        return self.controller.busy and self._undisturbed()

    def _undisturbed(self) -> bool:
        """Whether there was no stop, no fault, no gap and no request in this tick."""
        m = self.controller
        return m.condition == Condition.READY and not (m.served or m.late)
