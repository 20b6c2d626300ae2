"""Single ticks of a queue as a picture: the port's bits and the sensors as waves, a column a tick, the phases above.

Rule: pure but for the log, which is given what the machine shows after each stop of its clock. A column stands for the
ticks up to it: where more than one was let through, a sign says so.
"""

from collections import deque
from collections.abc import Iterator, Sequence

from drillctl.language.words import N_, _
from drillctl.ui.models.signal_grid import CARD_BITS
from drillctl.ui.screens.machine_lines import phase_line
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import AxisView
from drillctl.viewmodel.signals import SignalView

MOST_TICKS = 256  # that are kept
NAME_COLUMNS = 13
HIGH, LOW, SKIPPED = "▔", "▁", "┊"
PLAIN_HIGH, PLAIN_LOW, PLAIN_SKIPPED = "-", "_", ":"
SENSORS, BITS = N_("sensors"), N_("port")


class TickLog:
    """The ticks at which the clock stopped, with the signals then; the oldest are forgotten."""

    def __init__(self) -> None:
        self._ticks: deque[tuple[int, tuple[SignalView, ...]]] = deque(maxlen=MOST_TICKS)

    def __len__(self) -> int:
        return len(self._ticks)

    def add(self, tick: int, signals: Sequence[SignalView]) -> bool:
        """Takes the signals after a tick; False for a tick that was taken already. An earlier one begins anew."""
        if self._ticks and tick <= self._ticks[-1][0]:
            if tick == self._ticks[-1][0]:
                return False
            self._ticks.clear()
        self._ticks.append((tick, tuple(signals)))
        return True

    def lines(self, axes: Sequence[AxisView], size: tuple[int, int], plain: bool) -> list[Line]:
        """The picture in columns and rows: phases, bits, then as many waves as there is room for."""
        if not self._ticks:
            return []
        columns, rows = size
        head = [*map(phase_line, axes), port_line(self._ticks[-1][1]), self._ruler()]
        return [*head, *self._waves(columns - NAME_COLUMNS, max(rows - len(head), 0), plain)]

    def _ruler(self) -> Line:
        first, last = self._ticks[0][0], self._ticks[-1][0]
        return [("dark", _("ticks {first}..{last}, the newest at the right").format(first=first, last=last))]

    def _waves(self, columns: int, rows: int, plain: bool) -> Iterator[Line]:
        newest = self._ticks[-1][1]
        shown = [*self._ticks][-max(columns, 1) :]
        for index in self._chosen(rows):
            signal = newest[index]
            wave = "".join(_sign(shown, place, index, plain) for place in range(len(shown)))
            name = f"[{signal.name}]" if signal.on else f" {signal.name}"
            yield [("lit" if signal.on else "dark", f"{name:{NAME_COLUMNS}}"[:NAME_COLUMNS]), ("lit", wave)]

    def _chosen(self, rows: int) -> list[int]:
        """The signals that are drawn: all where there is room, else those that changed or are on, then the others."""
        signals = range(len(self._ticks[-1][1]))
        if len(signals) <= rows:
            return [*signals]
        once_on = [index for index in signals if any(signals_then[index].on for _tick, signals_then in self._ticks)]
        return sorted([*once_on, *(index for index in signals if index not in once_on)][:rows])


def _sign(shown: Sequence[tuple[int, tuple[SignalView, ...]]], place: int, index: int, plain: bool) -> str:
    tick, signals = shown[place]
    if place and tick != shown[place - 1][0] + 1:
        return PLAIN_SKIPPED if plain else SKIPPED
    high, low = (PLAIN_HIGH, PLAIN_LOW) if plain else (HIGH, LOW)
    return high if signals[index].on else low


def port_line(signals: Sequence[SignalView]) -> Line:
    """The outputs of each card as a number, and the sensors that are reached."""
    outputs = [signal for signal in signals if signal.kind != "input"]
    images = [0] * (max((signal.bit for signal in outputs), default=0) // CARD_BITS + 1)
    for signal in outputs:
        images[signal.bit // CARD_BITS] |= signal.level << signal.bit % CARD_BITS
    words = " ".join(f"0x{image:08X}" for image in images)
    reached = " ".join(f"[{signal.name}]" for signal in signals if signal.kind == "input" and signal.on)
    return [("title", f"{_(BITS)} "), words, "  ", ("title", f"{_(SENSORS)} "), reached or "-"]
