"""A table on the bench, as lines: the rotor over one cycle, its torque, the steps that motors lost.

Rule: functions of records and sizes. A loss is said in words and capitals, never by a colour alone.
"""

from collections.abc import Sequence
from itertools import zip_longest

from drillctl.language.words import N_, _, ngettext
from drillctl.ui.widgets.curves import curve_rows
from drillctl.ui.widgets.text_graphics import LEVELS, PLAIN_LEVELS
from drillctl.ui.widgets.texts import Line, width_of
from drillctl.viewmodel.bench import BenchReport, CyclePath, MotorRun

Size = tuple[int, int]
Bounds = tuple[float, float]
LABEL_COLUMNS = 6  # left of a curve
SPACE = 2  # columns between two charts
LEAST_HALF = 24  # columns from which two charts stand side by side
NOT_TRIED = N_("F5 tries this table on motors of a bench; the machine does not move.")
CHANGED_SINCE = N_("Changed since the last trial: F5 tries it again.")


def path_cells(path: CyclePath, shown: range, cell: int, plain: bool) -> tuple[str, str]:
    """The places of the rotor under the columns of a phase table, and its torque: a bar a column, none: it is free."""
    columns = [path.columns[index] for index in shown if index < len(path.columns)]
    places = "".join(f"{column.place:>{cell - 1}.0f} " for column in columns)
    most = max((column.torque for column in path.columns), default=0.0)
    levels = PLAIN_LEVELS if plain else LEVELS
    bars = (levels[round(column.torque / most * (len(levels) - 1)) if most else 0] for column in columns)
    return places, "".join(f"{bar:>{cell - 1}} " for bar in bars)


def path_words(path: CyclePath) -> Line:
    """How far one cycle turns the rotor, and the torque; as a warning where the turn is not that of a sound table."""
    if not path.columns:
        return []
    turned = _("motor {motor}: a cycle turns it {turned:.0f} of {wanted} columns").format(
        motor=path.motor.upper(), turned=path.turned, wanted=path.wanted
    )
    if round(path.turned) != path.wanted:
        return [("warning", _("warning: ") + turned)]
    return [turned, ", ", torque_words(path)]


def torque_words(path: CyclePath) -> str:
    """The least and the greatest torque of the columns: in mN m, or in single windings where they aren't known."""
    torques = [column.torque for column in path.columns]
    low, high = min(torques), max(torques)
    if path.torque_mnm is None:
        return _("{low:.2f} to {high:.2f} of one winding's torque").format(low=low, high=high)
    return _("{low:.0f} to {high:.0f} mN m").format(low=low * path.torque_mnm, high=high * path.torque_mnm)


def path_charts(path: CyclePath, saved: CyclePath, size: Size, plain: bool) -> list[Line]:
    """The rotor's place over the cycle, and its torque, each as a curve; those of the saved table to their left where
    they differ. ``size``: columns of the panel, rows of a curve.
    """
    if not path.columns:
        return [[_("no motor of the machine in use has windings for this table")]]
    shown = [path] if saved == path or not saved.columns else [saved, path]
    each = (size[0] - SPACE) // len(shown) if len(shown) > 1 else size[0], size[1]
    which = f": {_('saved')}, {_('now')}" if len(shown) > 1 else ""
    quantity = _("torque, mN m") if path.torque_mnm else _("torque, windings")
    places, torques = ([chart(one, each, plain) for one in shown] for chart in (_places, _torques))
    lines: list[Line] = []
    for caption, charts in ((_("rotor, in columns"), places), (quantity, torques)):
        drawn = charts[0] if len(charts) == 1 else side_by_side(charts[0], charts[1], each[0] + SPACE)
        lines += [[("dark", caption + which)] if which else _caption(caption), *drawn]
    return lines


def _places(path: CyclePath, size: Size, plain: bool) -> list[Line]:
    values = [0.0, *(column.place for column in path.columns)]
    return _curve(_held(values), _spanned(0.0, *values, path.wanted), size, plain)


def _torques(path: CyclePath, size: Size, plain: bool) -> list[Line]:
    unit = path.torque_mnm or 1.0
    values = [column.torque * unit for column in path.columns]
    return _curve(_held(values), (0.0, max(2 * unit, *values)), size, plain)


def _caption(text: str) -> Line:
    return [("dark", f"{'':{LABEL_COLUMNS}}{text}")]


def _curve(values: Sequence[float], bounds: Bounds, size: Size, plain: bool, look: str = "lit") -> list[Line]:
    """A curve with its bounds to its left."""
    columns, rows = size
    drawn = curve_rows(values, max(columns - LABEL_COLUMNS, 1), rows, plain, bounds)
    labels = [
        f"{bounds[1]:{LABEL_COLUMNS - 1}.4g} ",
        *[" " * LABEL_COLUMNS] * (rows - 2),
        f"{bounds[0]:{LABEL_COLUMNS - 1}.4g} ",
    ]
    return [[("dark", label), (look, row)] for label, row in zip(labels, drawn, strict=True)]


def chart(title: str, values: Sequence[float], size: Size, plain: bool) -> list[Line]:
    """A curve between its own extremes, with a title above it. ``size``: columns with those of its bounds, and rows."""
    return [_caption(title), *_curve(values, _spanned(*values), size, plain)]


def _spanned(*values: float) -> Bounds:
    return min(values), max(values)


def _held(places: Sequence[float]) -> list[float]:
    """Each place several times: a rotor steps from column to column, it does not slide."""
    return [place for place in places for _repeat in range(8)]


def verdicts(report: BenchReport | None, saved: BenchReport | None) -> list[Line]:
    """What each motor lost, in a line; with the saved table in a second one where it is another and was tried."""
    if report is None:
        return []
    now = [_("bench at {hz} Hz: ").format(hz=report.tick_hz), *_lost_by_motor(report)]
    return [now] if saved in (None, report) else [now, saved_words(saved)]


def saved_words(saved: BenchReport | None) -> Line:
    """What each motor lost with the saved table, in a line."""
    return [f"{_('saved')}: ", *_lost_by_motor(saved)] if saved else []


def _lost_by_motor(report: BenchReport) -> Line:
    return [("danger" if run.lost else "good", f"{run.motor.upper()} {lost_words(run)}  ") for run in report.runs]


def lost_words(run: MotorRun) -> str:
    """What a motor lost, in its worst move."""
    if not run.lost:
        return _("no step lost")
    text = ngettext("LOST {lost} of {count} step", "LOST {lost} of {count} steps", run.steps)
    return text.format(lost=abs(run.lost), count=abs(run.steps))


def bench_lines(report: BenchReport | None, saved: BenchReport | None, size: Size, plain: bool) -> list[Line]:
    """The trial of the table on the screen; to its left that of the saved one, where it is another and was tried.
    ``size``: columns of the panel, rows of a curve.
    """
    columns, rows = size
    if report is None:
        return [[_(NOT_TRIED if saved is None else CHANGED_SINCE)]]
    if saved is None or saved == report:
        return _bench(report, _("now"), size, plain, _bounds(report))
    if columns < 2 * LEAST_HALF:
        return [*_bench(report, _("now"), size, plain, _bounds(report)), [("title", _("saved"))], *_results(saved)]
    half, bounds = (columns - SPACE) // 2, _bounds(saved, report)
    before = _bench(saved, _("saved"), (half, rows), plain, bounds)
    return side_by_side(before, _bench(report, _("now"), (half, rows), plain, bounds), half + SPACE)


def _bench(report: BenchReport, title: str, size: Size, plain: bool, bounds: Bounds) -> list[Line]:
    worst = report.worst
    heading: Line = [("title", _("{title}, at {hz} Hz").format(title=title, hz=report.tick_hz))]
    results = _results(report)
    kind: list[Line] = [] if worst.dynamic else [[("dark", _("ideal motors: no dynamics are known"))]]
    other: list[Line] = [] if report.in_use else [[("dark", _("no motor here has this table; tried on one that fits"))]]
    behind = ngettext("lag in steps: {motor}, {count:+d} step", "lag in steps: {motor}, {count:+d} steps", worst.steps)
    caption = behind.format(motor=worst.motor.upper(), count=worst.steps)
    lag = _curve(worst.behind, bounds, size, plain, "danger" if worst.lost else "good")
    return [heading, *results, *kind, *other, _caption(caption), *lag]


def _results(report: BenchReport) -> list[Line]:
    return [_run_line(run) for run in report.runs]


def _run_line(run: MotorRun) -> Line:
    moves = ngettext("{count} move", "{count} moves", run.moves).format(count=run.moves)
    return [("title", f"{run.motor.upper():3}"), ("danger" if run.lost else "good", lost_words(run)), f", {moves}"]


def _bounds(*reports: BenchReport) -> Bounds:
    """What the charts of these reports span, alike for all: at least a step to either side."""
    values = [value for report in reports for value in report.worst.behind]
    return min(-1.0, *values), max(1.0, *values)


def side_by_side(left: Sequence[Line], right: Sequence[Line], columns: int) -> list[Line]:
    """Two groups of lines, the right one from column ``columns`` on."""
    nothing: Line = []
    pairs = zip_longest(left, right, fillvalue=nothing)
    return [[*one, " " * max(columns - width_of(one), 0), *other] for one, other in pairs]
