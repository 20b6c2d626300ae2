"""The words of a report: how the run ended, what each axis did, its commands and events, as HTML."""

from collections.abc import Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

from drillctl.language import visible
from drillctl.language.words import _, translated
from drillctl.viewmodel.run_report import ReportCommand, RunReport

MOST_COMMANDS = 2000  # shown; a page with more is slow to scroll
UM_PER_MM = 1000


def summary(report: RunReport) -> str:
    """Returns the section that says how the run ended: done or a fault, time, holes and their errors."""
    rows = [
        (_("machine time"), _("{seconds:.2f} s: {ticks} ticks at {hz} Hz").format(
            seconds=report.seconds, ticks=report.ticks, hz=report.tick_hz)),
        (_("plant"), report.plant),
        (_("holes"), _holes(report)),
        (_("lost steps"), _lost(report)),
    ]  # fmt: skip
    return f'<section class="{_kind(report)}">{_ending(report)}{_table(rows)}</section>'


def axes_table(report: RunReport) -> str:
    """Returns the table of the axes: way, greatest speed, greatest lag, lost steps."""
    heads = (_("axis"), _("way, mm"), _("fastest, mm/s"), _("greatest lag, full steps"), _("lost steps"))
    rows = [
        (axis.name, f"{axis.travelled_mm:.1f}", f"{_most(axis.speed_mm_s):.1f}",
         f"{_most(axis.lag_steps):.2f}" if len(axis.lag_steps) else "-", str(axis.lost_steps))
        for axis in report.axes
    ]  # fmt: skip
    return f"<section><h2>{_('Axes')}</h2>{grid(heads, rows)}</section>"


def events_list(report: RunReport) -> str:
    """Returns the requests, faults and gaps in time as a list; nothing where there were none."""
    if not report.events:
        return ""
    lines = [
        f"<li>{_at(report, event.tick)}: {escape(visible(translated(event.words)))}</li>" for event in report.events
    ]
    return f"<section><h2>{_('Events')}</h2><ul>{''.join(lines)}</ul></section>"


def commands_table(report: RunReport) -> str:
    """Returns the commands as they were run, the first MOST_COMMANDS of them."""
    heads = (_("number"), _("command"), _("from"), _("ticks"))
    shown = report.commands[:MOST_COMMANDS]
    left = len(report.commands) - len(shown)
    more = _("{count} more are not shown").format(count=left) if left else ""
    rows = [_command(report, command) for command in shown]
    return (
        f"<section><details><summary><h2>{_('Commands')} ({len(report.commands)})</h2></summary>"
        f"{grid(heads, rows)}<p>{more}</p></details></section>"
    )


def grid(heads: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """Returns a table that scrolls by itself where the page is narrower."""
    head = "".join(f"<th>{escape(each)}</th>" for each in heads)
    body = "".join(f"<tr>{''.join(f'<td>{escape(visible(cell))}</td>' for cell in row)}</tr>" for row in rows)
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def _command(report: RunReport, command: ReportCommand) -> tuple[str, ...]:
    ticks = command.end_tick - command.first_tick
    return str(command.sequence), command.text, _at(report, command.first_tick), str(ticks)


def _table(rows: list[tuple[str, str]]) -> str:
    cells = "".join(f"<tr><th>{escape(head)}</th><td>{escape(visible(cell))}</td></tr>" for head, cell in rows)
    return f"<table>{cells}</table>"


def _ending(report: RunReport) -> str:
    if report.fault is None:
        return f"<h2>{escape(_('The run ended without a fault'))}</h2>"
    name, cause, remedy = report.fault
    told = f"{translated(cause)}. {_('What to do')}: {translated(remedy)}."
    return f"<h2>{escape(name)}</h2><p>{escape(told)}</p>"


def _kind(report: RunReport) -> str:
    if report.fault is not None:
        return "fault"
    return "attention" if any(axis.lost_steps for axis in report.axes) else "ready"


def _holes(report: RunReport) -> str:
    error_um = report.holes.error_mm * UM_PER_MM
    if not len(error_um):
        return _("none")
    template = _("{count}, off by {mean:.0f} um on average and {most:.0f} um at most (number {worst})")
    worst = int(error_um.argmax()) + 1
    return template.format(count=len(error_um), mean=error_um.mean(), most=error_um.max(), worst=worst)


def _lost(report: RunReport) -> str:
    losing = [f"{axis.name} {axis.lost_steps:+d}" for axis in report.axes if axis.lost_steps]
    return ", ".join(losing) or _("none")


def _at(report: RunReport, tick: int) -> str:
    return _("tick {tick}, {seconds:.3f} s").format(tick=tick, seconds=tick / report.tick_hz)


def _most(values: NDArray[np.float64]) -> float:
    return float(np.abs(values).max(initial=0.0))
