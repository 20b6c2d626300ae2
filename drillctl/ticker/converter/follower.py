"""Follows the speed that is wanted with a converter, and judges what the converter says.

Rule: run is sent when another speed is wanted, and then until it is answered; never again after that, so that a
converter whose power comes back does not turn by itself. Stop is sent until the motor stands. An answer that can't be
true is none. Whoever calls ``turn`` says what time it is.
"""

from dataclasses import dataclass

from drillctl.language import Message
from drillctl.machine.spindle import Spindle
from drillctl.ticker.converter.lines import ConverterError, Line, Reading

SILENCE_S = 1.0  # without one good answer: the job is held
REOPEN_S = 1.0
HZ_STEP = 0.11  # the coarsest converter counts tenths of a Hz
MOST_DOUBTS = 3  # answers with another set frequency: some take a moment to show a new one
HIGHEST = 1.2  # no motor turns faster than that part of the greatest frequency


@dataclass(frozen=True, slots=True)
class Said:
    """What is known after a turn: the speed in rev/min, why the job is to be held (None: it is not), and whether the
    motor was told to stop, has answered, and stands.
    """

    rev_min: int
    wrong: Message | None
    stopped: bool


class Follower:
    """One converter on its line. ``greatest_hz`` is the highest frequency that is asked of it."""

    def __init__(self, line: Line, spindle: Spindle, greatest_hz: float, now_s: float):
        self._line, self._spindle, self._greatest_hz = line, spindle, greatest_hz
        self._sent: float | None = None  # the frequency that was sent and answered; None: nothing is known
        self._answered_s = self._reopened_s = now_s
        self._failed: Message | None = None
        self._doubts = 0
        self._last = Said(0, None, stopped=False)

    def turn(self, wanted_rev_min: int, now_s: float) -> Said:
        """Sends what is wanted, reads what is, and says what to make of it. Takes an exchange's time for each."""
        hz = wanted_rev_min / self._spindle.rev_min_per_hz
        wrong = self._too_fast(wanted_rev_min, hz)
        hz = 0.0 if wrong else hz
        try:
            self._send(hz)
            reading = self._line.read()
            self._check(reading)
        except ConverterError as error:
            return self._without_answer(error.message, wrong, hz, now_s)
        self._answered_s, self._failed = now_s, None
        rev_min = round(reading.output_hz * self._spindle.rev_min_per_hz)
        stands = not hz and self._spindle.near(0, rev_min)
        self._last = Said(rev_min, wrong or self._judged(reading, hz), stands)
        return self._last

    def _send(self, hz: float) -> None:
        if hz and hz != self._sent:
            self._line.run(hz)
        elif not hz and not self._last.stopped:
            self._line.stop()
        self._sent = hz

    def _check(self, reading: Reading) -> None:
        if not 0 <= reading.output_hz <= HIGHEST * self._greatest_hz:
            raise ConverterError(Message("it says {hz:.1f} Hz, which can't be true", hz=reading.output_hz))

    def _judged(self, reading: Reading, hz: float) -> Message | None:
        """Returns why the job is to be held although the converter answers."""
        if reading.tripped:
            return Message("it has tripped, fault code {code}; look at its display, and reset it", code=reading.tripped)
        doubtful = hz and reading.set_hz is not None and abs(reading.set_hz - hz) > HZ_STEP
        self._doubts = self._doubts + 1 if doubtful else 0
        if self._doubts >= MOST_DOUBTS:
            fields = {"set": reading.set_hz, "hz": hz}
            return Message("it has {set:.1f} Hz set where {hz:.1f} Hz were sent; look at its limits", **fields)
        return None

    def _too_fast(self, rev_min: int, hz: float) -> Message | None:
        if hz <= self._greatest_hz:
            return None
        fields = {"rev_min": rev_min, "hz": hz, "most": self._greatest_hz}
        return Message("{rev_min} rev/min are {hz:.0f} Hz, and it is to give {most:.0f} Hz at the most", **fields)

    def _without_answer(self, why: Message, wrong: Message | None, hz: float, now_s: float) -> Said:
        self._failed = why
        self._last = Said(self._last.rev_min, self._last.wrong, stopped=False)
        if now_s - self._answered_s < SILENCE_S:
            return self._last
        if now_s - self._reopened_s >= REOPEN_S:
            self._reopened_s = now_s
            try:
                self._line.reopen()
            except ConverterError as error:
                self._failed = error.message
        self._sent = hz  # what was not answered in time is not sent once it answers again
        silent = Message("no good answer ({why}); look at its line and its power", why=self._failed)
        self._last = Said(self._last.rev_min, wrong or silent, stopped=False)
        return self._last
