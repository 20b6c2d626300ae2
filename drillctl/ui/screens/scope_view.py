"""The scope as lines: names, waves and values side by side, the machine at the cursor below or beside them.

Rule: a function of a source and of what is looked at. The cursor and the marks A and B stand as signs in the ruler, so
that nothing is told by colour alone.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from drillctl.language import Message
from drillctl.language.words import N_, _, ngettext, translated
from drillctl.ui.models.viewport import SignalRows, Viewport
from drillctl.ui.screens.machine_lines import phase_line, phase_table
from drillctl.ui.screens.scope_curve import curve_lines
from drillctl.ui.screens.scope_measure import between, is_place
from drillctl.ui.screens.scope_wave import SIGNS, fitted, number_line, ruler, wire_line, word_line
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.texts import Line, packed
from drillctl.viewmodel.scope import AxisMoment, Ints, Lack, Moment, ScopeSignal, ScopeSource

WIDE = 116  # columns from which the phase tables stand beside the waves
TABLES = 36
VALUES = 10
MOST_NAME = 16
BESIDE_NAME = ("sensors", "outputs", "kmd", "run")  # groups that a name does without
UNKNOWN = "?"
LACKS: Mapping[Lack, str] = {
    "forgotten": N_("what was before tick {value} was forgotten"),
    "behind": N_("changes are missing: the screen fell behind the machine"),
    "running": N_("columns, positions and states are being found: {value} %"),
    "underivable": N_("columns, positions and states can't be found: {value}"),
    "too long": N_("columns, positions and states are known to tick {value}: more would take too much memory"),
    "other rate": N_("the tick rate was changed in tick {value}; seconds are counted by the rate shown above"),
    "other tables": N_("recorded with other tables: columns, positions and states are computed with the present ones"),
}


@dataclass(frozen=True)
class ScopeLook:
    """What is drawn: ticks, rows, the marks A and B, and the last message."""

    view: Viewport
    rows: SignalRows
    marks: tuple[tuple[str, int], ...] = ()
    following: bool = False
    said: str = ""
    plain: bool = False


@dataclass(frozen=True)
class ScopeLayout:
    """How many columns names, waves and phase tables get."""

    names: int
    waves: int
    tables: int

    @classmethod
    def of(cls, signals: Sequence[ScopeSignal], columns: int) -> "ScopeLayout":
        """The layout for a width; phase tables stand beside the waves only where there is room."""
        names = min(MOST_NAME, max((len(title(signal)) for signal in signals), default=0)) + 2
        tables = TABLES if columns >= WIDE else 0
        return cls(names, max(1, columns - names - VALUES - tables), tables)


class _Waves(NamedTuple):
    """What all rows of a drawing share. ``at``: the cursor's column; ``end``: the last edge, a tick."""

    source: ScopeSource
    look: ScopeLook
    layout: ScopeLayout
    moment: Moment
    edges: Ints
    at: int
    end: int

    def known(self, row: int) -> Ints:
        """The edges up to which a signal is known."""
        known_to = self.source.known_to(row)
        return self.edges if known_to >= self.end else self.edges[: self.edges.searchsorted(known_to, side="right")]


def title(signal: ScopeSignal) -> str:
    """The name of a signal's row, with its group where that is needed."""
    return signal.name if signal.group in BESIDE_NAME else f"{signal.group}.{signal.name}"


def scope_lines(source: ScopeSource, look: ScopeLook, columns: int, rows: int) -> tuple[list[Line], int, int]:
    """The lines, the line at which the waves begin, and how many of them there are."""
    layout = ScopeLayout.of(source.signals(), columns)
    if source.last_tick < source.first_tick:
        return [[("dark", _("Nothing was run yet."))]], 0, 0
    head = folded(_heading(source, look), columns)
    moment = source.at(look.view.cursor)
    foot = folded(_foot(source, look, moment, columns, bool(layout.tables)), columns)
    room = max(1, rows - len(head) - len(foot) - 1)
    edges = look.view.edges()
    at = look.view.column_of(look.view.cursor)
    waves = [_ruler(look, layout, edges)]
    waves += _rows(_Waves(source, look, layout, moment, edges, at, int(edges[-1])), room)
    waves += [[""]] * (room + 1 - len(waves))
    if layout.tables:
        waves = _beside(waves, _tables(moment.axes, room + 1))
    return [*head, *waves, *foot], len(head) + 1, room


def _heading(source: ScopeSource, look: ScopeLook) -> list[Line]:
    ticks = _("{hz} Hz, ticks {first}..{last}")
    ticks = ticks.format(hz=source.tick_hz, first=source.first_tick, last=source.last_tick)
    follows: Line = [("good", _(" following"))] if look.following else []
    notices: list[Line] = [
        [("warning", translated(Message(LACKS[notice.lack], value=notice.value)))] for notice in source.notices()
    ]
    return [[("title", source.name), f" {ticks}, {_zoom(look.view, source.tick_hz)}", *follows], *notices]


def _zoom(view: Viewport, tick_hz: int) -> str:
    ticks, columns = view.zoom
    if columns > 1:
        return ngettext("{count} cell a tick", "{count} cells a tick", columns).format(count=columns)
    counted = ngettext("{count} tick", "{count} ticks", ticks).format(count=ticks)
    return _("a cell: {ticks}, {ms} ms").format(ticks=counted, ms=f"{ticks * 1000 / tick_hz:.10g}")


def _ruler(look: ScopeLook, layout: ScopeLayout, edges: Ints) -> Line:
    view = look.view
    marks = [(view.column_of(tick), name) for name, tick in look.marks]
    cursor = (view.column_of(view.cursor), SIGNS[look.plain].cursor)
    labels = ruler(edges, layout.waves, [*marks, cursor])
    return [" " * layout.names, ("title", labels), ("title", f"{_('at cursor'):>{VALUES}}"[:VALUES])]


def _rows(waves: _Waves, room: int) -> list[Line]:
    """The lines of the rows: one each, or as many as a curve has."""
    window = waves.look.rows.window(room)
    curves = {row: _curve(waves, row) for row, part in window if part}
    lines = []
    for row, part in window:
        first = _row(waves, row) if not part else []
        lines.append(_on_curve(first, curves[row][part], waves) if row in curves else first)
    return lines


def _curve(waves: _Waves, row: int) -> list[tuple[str, str]]:
    look = waves.look
    return curve_lines(waves.source, row, waves.known(row), waves.layout.waves, look.rows.heights[row], look.plain)


def _on_curve(row: Line, drawn: tuple[str, str], waves: _Waves) -> Line:
    """A line of a curve, the cursor's column in it marked; the first has the row's name and its value."""
    label, text = drawn
    at, names = waves.at, waves.layout.names
    curve: Line = [("good", text[:at]), ("focus", text[at : at + 1]), ("good", text[at + 1 :])]
    if row:
        return [row[0], *curve, row[-1]]
    return [("dark", f"  {label:{names - 2}}"[:names]), *curve, " " * VALUES]


def _row(waves: _Waves, row: int) -> Line:
    source, look, layout, moment, _edges, at, _end = waves
    signal, value = source.signals()[row], moment.values[row]
    here = row == look.rows.at
    name = f"{'>' if here else ' '}{title(signal):{layout.names - 1}}"[: layout.names]
    shown = UNKNOWN if value is None else source.shown(row, value, moment.tick)
    wave = f"{_wave(waves, row):{layout.waves}}"
    cursor: Line = [("lit", wave[:at]), ("focus", wave[at : at + 1]), ("lit", wave[at + 1 :])]
    text = fitted(shown, VALUES - 1, signal.shape == "words", SIGNS[look.plain]).strip()
    return [("focus" if here else "body", name), *cursor, ("body", f"{text:>{VALUES}}")]


def _wave(waves: _Waves, row: int) -> str:
    """The row as far as the signal is known; beyond, where there should be more, a question mark."""
    source, look, known_edges = waves.source, waves.look, waves.known(row)
    unknown = UNKNOWN * (len(waves.edges) - max(1, len(known_edges)))
    if len(known_edges) < 2:
        return unknown
    strip, shape = source.strip(row, known_edges), source.signals()[row].shape
    exact = look.view.zoom.ticks == 1
    if shape == "wire":
        return wire_line(strip, exact, look.plain) + unknown

    def shown(column: int, value: int) -> str:
        return source.shown(row, value, int(known_edges[column + 1]) - 1)

    if shape == "count":
        return number_line(strip, shown, exact or is_place(source.signals()[row]), look.plain) + unknown
    return word_line(strip, shown, True, look.plain) + unknown


def _foot(source: ScopeSource, look: ScopeLook, moment: Moment, columns: int, with_tables: bool) -> list[Line]:
    """The lines below: the machine at the cursor, the time between the marks, the last message."""
    seconds = f"{moment.tick / source.tick_hz:.3f}"
    place: Line = [("title", _("tick {tick}, {seconds} s").format(tick=moment.tick, seconds=seconds)), "  "]
    axes = [] if with_tables else packed([_axis_part(axis) for axis in moment.axes], columns)
    answer: Line = [("warning", look.said), "  "] if look.said else []
    said: Line = [*answer, between(source, look.marks, look.view.cursor)]
    return [[*place, moment.command or "-", *_fault(source, moment)], *axes, said]


def _fault(source: ScopeSource, moment: Moment) -> Line:
    """The fault at the cursor in full; its row may be hidden, or have no room for it."""
    values = zip(source.signals(), moment.values, strict=True)
    latched = [(row, value) for row, (signal, value) in enumerate(values) if signal.name == "fault" and value]
    return [part for row, value in latched for part in ("  ", ("warning", source.shown(row, value, moment.tick)))]


def _axis_part(axis: AxisMoment) -> Line:
    text = _("{steps}, column {column}, {state}  ")
    text = text.format(steps=axis.position_steps, column=axis.column, state=f"{axis.state:+d}")
    return [("title", f"{axis.name.upper()} "), text]


def _tables(axes: Sequence[AxisMoment], rows: int) -> list[Line]:
    """The phase tables as the drilling screen has them; a line a motor where there are too many."""
    if not axes:
        return [[("dark", _("columns and positions are not known"))]]
    tables = [line for axis in axes for line in phase_table(axis)]
    phases = tables if len(axes) + len(tables) <= rows else [phase_line(axis) for axis in axes]
    return [*map(_place_line, axes), *phases][:rows]


def _place_line(axis: AxisMoment) -> Line:
    return [("title", f"{axis.name.upper():3}"), f"{axis.position_mm:9.3f} mm {axis.position_steps:7}"]


def _beside(left: Sequence[Line], right: Sequence[Line]) -> list[Line]:
    missing: list[Line] = [[""]] * (len(left) - len(right))
    return [[*line, "  ", *beside] for line, beside in zip(left, [*right, *missing], strict=True)]
