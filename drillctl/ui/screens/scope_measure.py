"""What lies between the scope's cursors A and B: ticks, milliseconds, steps; and where a command is."""

from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase
from glob import escape

from drillctl.language.words import _, ngettext
from drillctl.viewmodel.scope import ScopeSignal, ScopeSource

COMMANDS = "kmd"  # the group of the signal that names the command in execution
POSITION = "position"  # the name of each axis's signal that counts its steps
PLANT = "plant"  # the group of where the simulated carriages are


def is_place(signal: ScopeSignal) -> bool:
    """Whether a signal is a place, which no tick changes by more than a step."""
    return signal.name == POSITION or signal.group == PLANT


def between(source: ScopeSource, marks: Sequence[tuple[str, int]], cursor: int) -> str:
    """The interval from A to B; from either of them to the cursor while there is only one."""
    if not marks:
        return _("A and B: not set")
    names = " ".join(f"{name} {tick}" for name, tick in marks)
    first, last = sorted((marks[0][1], marks[1][1] if len(marks) > 1 else cursor))
    ticks = last - first
    rate = f", {source.tick_hz / ticks:.4g} Hz" if ticks else ""
    ms = f"{ticks * 1000 / source.tick_hz:.10g}"
    counted = ngettext("{count} tick", "{count} ticks", ticks).format(count=ticks)
    measured = _("{marks}: {ticks}, {ms} ms{rate}").format(marks=names, ticks=counted, ms=ms, rate=rate)
    moved = [f"{axis.upper()} {steps:+d}" for axis, steps in steps_between(source, first, last) if steps]
    return measured + (_(", steps: {moved}").format(moved=" ".join(moved)) if moved else _(", no steps"))


def steps_between(source: ScopeSource, first: int, last: int) -> Iterator[tuple[str, int]]:
    """Each axis and how far its position changed from one tick to the other; axes not known there are left out."""
    for number, signal in enumerate(source.signals()):
        if signal.name == POSITION and source.first_tick <= first and last < source.known_to(number):
            begin, end = (int(source.window(number, tick, tick + 1).values[0]) for tick in (first, last))
            yield signal.group, end - begin


def command_after(source: ScopeSource, tick: int, text: str) -> int | None:
    """The first tick after ``tick`` in which a command begins that has the text in it (a glob where it has ``*``)."""
    row = next((number for number, signal in enumerate(source.signals()) if signal.group == COMMANDS), None)
    if row is None or not text or tick >= source.last_tick:
        return None
    found = source.window(row, tick, source.last_tick + 1)
    pattern = f"*{text if '*' in text else escape(text)}*".lower()
    begun = zip(found.ticks[1:].tolist(), found.values[1:].tolist(), strict=True)
    texts = ((at, source.shown(row, value, at).lower()) for at, value in begun if value)
    return next((at for at, shown in texts if fnmatchcase(shown, pattern)), None)
