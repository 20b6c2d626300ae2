"""How a run ended, what a job will take, how punctual ticks are: in words, as functions of the records."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from drillctl.language.number_text import clock
from drillctl.viewmodel.records import Estimate, Outcome, ToolEstimate

if TYPE_CHECKING:
    from collections.abc import Mapping

    from drillctl.viewmodel.reports import Bar, LatencyReport, Lateness

WIDEST = 40
DOUBTFUL_SHARE = 0.1  # canaries that are late as often as that meet most late ticks by chance
HEADING = f"{'lateness, us':14}{'p50':>8}{'p99':>8}{'p99.9':>8}{'max':>8}"


def latency_lines(report: LatencyReport) -> list[str]:
    """The lines that ``drillctl latency`` prints."""
    ended = ", ended early" if report.interrupted else ""
    ticks = report.ticker.wakes
    doing = "moving" if report.moving else "idle"
    lines = [f"{report.machine}, {doing}: {ticks} ticks at {report.tick_hz} Hz in {report.seconds:.1f} s{ended}"]
    lines += _scheduling(report)
    lines += ["", HEADING, _row("ticker", report.ticker), _row("canaries", report.canary), ""]
    late = f"{report.late} of {ticks} = {report.late / ticks:.3%}"
    lines += [f"late by more than a period ({report.period_us:.0f} us): {late}"]
    lines += _blame(report) if report.late else []
    lines += [f"processor: {report.cpu_share:.1%} of one core", ""]
    lines += ["ticks by lateness (bars are logarithmic)", *_histogram(report), ""]
    lines += [f"grade {report.grade.letter}: good for {report.grade.good_for}", f"advice: {report.grade.advice}"]
    return [*lines, f"rate: {_rate(report)}"]


def _scheduling(report: LatencyReport) -> list[str]:
    if not report.refused:
        return ["scheduling: real-time"]
    return ["scheduling: not real-time", *(f"  {sentence}" for sentence in report.refused)]


def _row(name: str, found: Lateness) -> str:
    return f"  {name:12}{found.p50_us:>8}{found.p99_us:>8}{found.p999_us:>8}{found.max_us:>8}"


def _blame(report: LatencyReport) -> list[str]:
    doubt = ", so that says little" if report.canary_late_share > DOUBTFUL_SHARE else ""
    chance = f"(a canary is late {report.canary_late_share:.2%} of the time{doubt})"
    rows = [
        (report.platform, f"PLATFORM: a process that only sleeps was late at that moment too {chance}"),
        (report.ours, "OURS: the ticker alone was late"),
        (report.unlabelled, "not looked into: too many"),
    ]
    return [f"  {count:>6} {whose}" for count, whose in rows if count]


def _histogram(report: LatencyReport) -> list[str]:
    most = max((bar.ticks for bar in report.histogram), default=1)
    return [f"{_range(bar)} {_drawn(bar.ticks, most):{WIDEST}} {bar.ticks:>8}" for bar in report.histogram]


def _range(bar: Bar) -> str:
    return f"{bar.from_us:>8} .. {'more' if bar.to_us is None else bar.to_us:<6} us"


def _drawn(ticks: int, most: int) -> str:
    """A bar of the histogram: one mark for a single tick, all marks for the most."""
    return "#" * (ticks and 1 + round((WIDEST - 1) * math.log(ticks) / max(math.log(most), 1e-9)))


def _rate(report: LatencyReport) -> str:
    if not report.carries_hz:
        return "this lateness is too great for any usual rate"
    about = f"this lateness would carry {report.carries_hz} Hz"
    if report.carries_hz > report.tick_hz:
        return f"{about}; measure there before relying on it (--hz {report.carries_hz})"
    return about


def summary_lines(outcome: Outcome) -> list[str]:
    """The lines that ``drillctl run`` prints at the end."""
    holes = f"{outcome.holes_done} of {outcome.holes_total} holes drilled, " if outcome.holes_total else ""
    ticks = f"{outcome.ticks} ticks at {outcome.tick_hz} Hz"
    lines = [f"{outcome.machine}: {holes}{ticks} = {clock(outcome.machine_seconds)} of machine time"]
    lines.append(f"steps: {_by_axis(outcome.steps)}; position: {_by_axis(outcome.position)} ({_known(outcome)})")
    if outcome.interrupted:
        kept = "kept" if outcome.position_known else "not known"
        lines.append(f"interrupted: stopped, position {kept}; outputs off")
    if fault := outcome.fault:
        lines += [f"FAULT {fault.title}: {fault.cause}", f"  position {fault.position}", f"  remedy: {fault.remedy}"]
    lines += [f"WARNING: look at hole {hole}: a bit was found broken after it" for hole in outcome.suspect]
    if outcome.lost_steps and any(outcome.lost_steps.values()):
        lines.append(f"WARNING: lost steps: {_by_axis(outcome.lost_steps)}")
    return lines


def estimate_lines(estimate: Estimate) -> list[str]:
    """The lines that ``drillctl estimate`` prints."""
    about = "" if estimate.exact else "about "
    holes = f"{estimate.holes_total} holes, " if estimate.holes_total else ""
    seconds = estimate.ticks / estimate.tick_hz
    ticks = f"{about}{estimate.ticks} ticks at {estimate.tick_hz} Hz"
    lines = [f"{estimate.machine}: {holes}{ticks} = {clock(seconds)} of machine time"]
    for tool in estimate.tools:
        diameter = "?" if tool.diameter_mm is None else f"{tool.diameter_mm:.3f}"
        time = clock(tool.ticks / estimate.tick_hz)
        lines.append(f"  T{tool.number:<4} {diameter:>7} mm  {tool.holes:>6} holes  {time:>8}{_drill(tool)}")
    if estimate.fault:
        lines.append(f"it would end in FAULT {estimate.fault.name}: {estimate.fault.cause}")
    return lines


def _drill(tool: ToolEstimate) -> str:
    if tool.drill_mm is None:
        return ""
    left = "" if tool.hits_left is None else f", good for {tool.hits_left} more holes"
    return f"  drill {tool.drill_mm:.3f} mm{left}"


def _by_axis(values: Mapping[str, int]) -> str:
    return " ".join(f"{axis} {value}" for axis, value in values.items())


def _known(outcome: Outcome) -> str:
    return "known" if outcome.position_known else "from where it was switched on"
