"""The waves of a report: their changes as data in the page, which page.js draws and zooms.

Rule: each wave is its first value and then differences, tick and value in turn: what repeats is short. A wire changes
to and fro, so it needs no values.
"""

import json
from html import escape

import numpy as np

from drillctl.language.words import _
from drillctl.viewmodel.run_report import ReportWave, RunReport


def waves_section(report: RunReport, number: int) -> str:
    """Returns the section with the data of the waves; ``number``: of the run on its page. Nothing without
    waves.
    """
    if not report.waves:
        return ""
    data = {
        "hz": report.tick_hz,
        "end": report.waves_to,
        "waves": [_wave(wave) for wave in report.waves],
        "words": {"ticks": _("ticks")},
    }
    text = json.dumps(data, separators=(",", ":"), ensure_ascii=True).replace("<", "\\u003c")
    cut = _("drawn up to tick {tick} of {ticks}").format(tick=report.waves_to, ticks=report.ticks)
    note = f"<p>{escape(cut)}</p>" if report.waves_to < report.ticks else ""
    buttons = "".join(
        f'<button type="button" data-do="{do}" title="{escape(title)}">{sign}</button>'
        for do, sign, title in (
            ("in", "+", _("zoom in")), ("out", "-", _("zoom out")), ("all", "=", _("the whole run")),
            ("left", "&lt;", _("to the left")), ("right", "&gt;", _("to the right")),
        )
    )  # fmt: skip
    help_ = _("wheel or pinch: zoom; drag: move; + - = < >: the same by keys")
    return (
        f'<section class="waves" id="waves-{number}"><h2>{_("Waves")}</h2>'
        f'<p class="bar">{buttons} <output></output></p>{note}<canvas tabindex="0"></canvas>'
        f'<p>{escape(help_)}</p><script type="application/json">{text}</script></section>'
    )


def _wave(wave: ReportWave) -> dict[str, object]:
    ticks = np.diff(wave.ticks, prepend=0).tolist()
    if wave.is_wire:
        return {"name": wave.name, "first": int(wave.values[0]), "ticks": ticks}
    return {"name": wave.name, "ticks": ticks, "values": np.diff(wave.values, prepend=0).tolist()}
