"""A report as one page of HTML.

Rule: a function of a record, and of the operator's language; no date, no path, so that the same run gives the same
page. Every text of the run is escaped here or in facts.py.
"""

from collections.abc import Sequence
from html import escape
from importlib.resources import files

from drillctl.language import visible
from drillctl.language.words import _
from drillctl.ui.report.board_plan import board_figure
from drillctl.ui.report.drawings import curve_figures
from drillctl.ui.report.facts import axes_table, commands_table, events_list, summary
from drillctl.ui.report.waves import waves_section
from drillctl.viewmodel.run_report import Comparison, RunReport


def report_page(reports: Sequence[RunReport], language: str = "en", comparison: Comparison | None = None) -> str:
    """Returns the page of one run or several; first, where it is given, how two runs compare. ``language``: that of the
    words, as the page tells it to the browser.
    """
    sections = [] if comparison is None else [_comparison(comparison, reports[0].tick_hz)]
    for number, report in enumerate(reports, 1):
        sections += _of_run(report, number)
    title = " | ".join(report.name for report in reports)
    return (
        f'<!DOCTYPE html>\n<html lang="{language}"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{text(title)}</title><style>{_part('page.css')}</style></head>\n<body><main>\n"
        + "\n".join(sections)
        + f"\n</main><script>{_part('page.js')}</script></body></html>\n"
    )


def text(words: str) -> str:
    """Returns words of a run for HTML: escaped, and hidden characters made visible."""
    return escape(visible(words))


def _of_run(report: RunReport, number: int) -> list[str]:
    parts = [
        f'<header><h1>{text(report.name)}</h1><p>{text(report.machine)}: {text(report.description)}</p></header>',
        summary(report),
        board_figure(report.holes),
        axes_table(report),
        *curve_figures(report),
        waves_section(report, number),
        events_list(report),
        commands_table(report),
    ]
    return [part for part in parts if part]


def _comparison(found: Comparison, tick_hz: int) -> str:
    if found.tick is None:
        return f'<section class="ready"><h2>{text(_("The two runs are the same to the end"))}</h2></section>'
    head = _("The two runs part at tick {tick} ({seconds:.3f} s)").format(tick=found.tick, seconds=found.tick / tick_hz)
    lines = "\n".join(text(line) for line in found.lines)
    which = _("- {first}   + {second}").format(first=found.first, second=found.second)
    return f'<section class="fault"><h2>{text(head)}</h2><p>{text(which)}</p><pre>{lines}</pre></section>'


def _part(name: str) -> str:
    return (files("drillctl.ui.report") / name).read_text("utf-8")
