"""The signals of a machine as cells side by side, in sections, with a cursor; as many a line as there is room for.

Rule: pure: from signals, cursor and width to lines. What is on stands in capitals, whatever its colour.
"""

from collections.abc import Sequence
from itertools import groupby

from drillctl.language.words import N_, _
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.signals import SignalKind, SignalView

CELL_COLUMNS = 39
NAME_COLUMNS = 15
TITLES: dict[SignalKind, str] = {"input": N_("Inputs"), "output": N_("Outputs"), "coil": N_("Motor")}
# Kind: the words for on and off.
STATES: dict[SignalKind, tuple[str, str]] = {
    "input": (N_("REACHED"), N_("clear")),
    "output": (N_("ON"), N_("off")),
    "coil": (N_("ON"), N_("off")),
}
LEVELS = (N_("low"), N_("high"))
CARD_BITS, BYTE, IMAGE_LABEL = 32, 8, 16
RULER = "31    24 23    16 15     8 7      0"  # above the bits of a card, in bytes


def per_line(columns: int) -> int:
    """How many cells fit side by side into these columns."""
    return max(1, columns // CELL_COLUMNS)


def section(signal: SignalView) -> tuple[str, str]:
    """The section that a signal belongs to: its kind, and for a coil its axis."""
    return (signal.kind, signal.name.partition(".")[0] if signal.kind == "coil" else "")


def grid_rows(signals: Sequence[SignalView], columns: int) -> list[list[int]]:
    """The indices of the signals, line by line. A section begins with an empty line for its heading."""
    rows: list[list[int]] = []
    width = per_line(columns)
    for _key, members in groupby(range(len(signals)), lambda place: section(signals[place])):
        places = list(members)
        rows += [[], *(places[start : start + width] for start in range(0, len(places), width))]
    return rows


def grid_lines(signals: Sequence[SignalView], cursor: int, columns: int) -> list[Line]:
    """A line of text for each of ``grid_rows``; the empty ones become headings."""
    rows = grid_rows(signals, columns)
    lines: list[Line] = []
    for row, after in zip(rows, [*rows[1:], []], strict=True):
        lines.append([_cell(signals[place], place == cursor) for place in row] or [_heading(signals[after[0]])])
    return lines


def moved(signals: Sequence[SignalView], cursor: int, columns: int, by: int) -> int:
    """The index under the cursor after moving it down by so many lines, in its column; it stops at the ends."""
    rows = [row for row in grid_rows(signals, columns) if row]
    at = next((number for number, row in enumerate(rows) if cursor in row), 0)
    if not rows or not 0 <= at + by < len(rows):
        return cursor
    target = rows[at + by]
    return target[min(rows[at].index(cursor), len(target) - 1)]


def about(signal: SignalView) -> str:
    """The line below the grid: name, bit, card and meaning of one signal."""
    card, bit = signal.card_and_bit
    place = _("{name}: bit {bit} of card {card}").format(name=signal.name, bit=bit, card=card)
    if signal.kind == "input":
        reached = _("reached when {level}").format(level=_(LEVELS[signal.active_level]))
        return ", ".join([place, reached, *([_("held by hand")] if signal.held else [])])
    if signal.kind == "coil":
        return f"{place}, " + (_("forcing wire") if signal.forcing else _("motor's wire"))
    return place


def image_lines(signals: Sequence[SignalView]) -> list[Line]:
    """The words of each card, bit 31 first, and as numbers: ``x`` high, ``.`` low, blank where no wire is."""
    lines: list[Line] = [[("title", f"{_('Port'):{IMAGE_LABEL}}"), ("dark", RULER)]]
    for card in sorted({signal.card_and_bit[0] for signal in signals}):
        for word, inputs in ((N_("Outputs"), False), (N_("Inputs"), True)):
            wires = [signal for signal in signals if (signal.kind == "input") == inputs]
            places = [(*signal.card_and_bit, signal.level) for signal in wires]
            levels = {bit: level for of_card, bit, level in places if of_card == card}
            bits = "".join(" .x"[levels.get(bit, -1) + 1] for bit in reversed(range(CARD_BITS)))
            value = sum(level << bit for bit, level in levels.items())
            label = f"{_(word)} {card}"
            lines.append([("title", f"{label:{IMAGE_LABEL}}"), ("lit", _in_bytes(bits)), f"  0x{value:08x}"])
    return lines


def _in_bytes(bits: str) -> str:
    return " ".join(bits[start : start + BYTE] for start in range(0, len(bits), BYTE))


def _heading(first: SignalView) -> tuple[str, str]:
    axis = section(first)[1]
    return ("title", f"{_(TITLES[first.kind])} {axis.upper()}".rstrip())


def _cell(signal: SignalView, here: bool) -> tuple[str, str]:
    word = _(STATES[signal.kind][0 if signal.on else 1])
    level = _(LEVELS[signal.level])
    name = f"{signal.name[:NAME_COLUMNS]:{NAME_COLUMNS}}"
    text = f"{'>' if here else ' '}{name}{signal.bit:4}  {level:7}{word}"
    return ("focus" if here else "lit" if signal.on else "body", f"{text[: CELL_COLUMNS - 1]:{CELL_COLUMNS}}")
