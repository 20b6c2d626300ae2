"""A drill file in words: tools, counts, size, format and why. A function of the summary that ``--json`` prints."""

import math
from collections.abc import Mapping
from typing import Any

from drillctl.language.figures import clock
from drillctl.viewmodel import Estimate, Outcome, ToolEstimate
from drillctl.viewmodel.latency import Bar, LatencyReport, Lateness


def inspect_lines(name: str, told: Mapping[str, Any]) -> list[str]:
    """The lines that ``drillctl inspect`` prints."""
    lines = [f"{name}: {told['holes']} holes, {told['slots']} slots, {told['routs']} milled cuts"]
    if box := told["bbox_mm"]:
        lines.append(f"  {box[2] - box[0]:.3f} x {box[3] - box[1]:.3f} mm, X {box[0]:.3f}..{box[2]:.3f}, "
                     f"Y {box[1]:.3f}..{box[3]:.3f}")  # fmt: skip
    zeros = f", {told['zeros']} zeros suppressed" if told["zeros"] else ""
    lines.append(f"  {told['units']} {told['format']}{zeros} (confidence {told['confidence']:.0%}): {told['reason']}")
    lines += [_tool_line(tool) for tool in told["tools"]]
    lines += [f"  warning: {_place(name, warning)}{warning['reason']}" for warning in told["warnings"]]
    return lines


def _tool_line(tool: Mapping[str, Any]) -> str:
    diameter = "?" if tool["diameter_mm"] is None else f"{tool['diameter_mm']:.3f}"
    slots = f", {tool['slots']} slots" if tool["slots"] else ""
    return f"  T{tool['number']:<4} {diameter:>7} mm  {tool['count']:>6} holes{slots}"


def _place(name: str, warning: Mapping[str, Any]) -> str:
    return f"{name}:{warning['line']}: " if warning["line"] else ""


WIDEST = 40
DOUBTFUL_SHARE = 0.1  # canaries that are late as often as that meet most late ticks by chance
HEADING = f"{'lateness, us':14}{'p50':>8}{'p99':>8}{'p99.9':>8}{'max':>8}"


def latency_lines(told: LatencyReport) -> list[str]:
    """The lines that ``drillctl latency`` prints."""
    ended = ", ended early" if told.interrupted else ""
    ticks = told.ticker.wakes
    lines = [f"{told.machine}, idle: {ticks} ticks at {told.tick_hz} Hz in {told.seconds:.1f} s{ended}"]
    lines += _scheduling(told)
    lines += ["", HEADING, _row("ticker", told.ticker), _row("canaries", told.canary), ""]
    lines += [f"late by more than a period ({told.period_us:.0f} us): {told.late} of {ticks} = {told.late / ticks:.3%}"]
    lines += _blame(told) if told.late else []
    lines += [f"processor: {told.cpu_share:.1%} of one core", ""]
    lines += ["ticks by lateness (bars are logarithmic)", *_histogram(told), ""]
    lines += [f"grade {told.grade.letter}: good for {told.grade.good_for}", f"advice: {told.grade.advice}"]
    return [*lines, f"rate: {_rate(told)}"]


def _scheduling(told: LatencyReport) -> list[str]:
    if not told.refused:
        return ["scheduling: real-time"]
    return ["scheduling: not real-time", *(f"  {sentence}" for sentence in told.refused)]


def _row(name: str, found: Lateness) -> str:
    return f"  {name:12}{found.p50_us:>8}{found.p99_us:>8}{found.p999_us:>8}{found.max_us:>8}"


def _blame(told: LatencyReport) -> list[str]:
    doubt = ", so that says little" if told.canary_late_share > DOUBTFUL_SHARE else ""
    chance = f"(a canary is late {told.canary_late_share:.2%} of the time{doubt})"
    rows = [
        (told.platform, f"PLATFORM: a process that only sleeps was late at that moment too {chance}"),
        (told.ours, "OURS: the ticker alone was late"),
        (told.unlabelled, "not looked into: too many"),
    ]
    return [f"  {count:>6} {whose}" for count, whose in rows if count]


def _histogram(told: LatencyReport) -> list[str]:
    most = max((bar.ticks for bar in told.histogram), default=1)
    return [f"{_range(bar)} {_drawn(bar.ticks, most):{WIDEST}} {bar.ticks:>8}" for bar in told.histogram]


def _range(bar: Bar) -> str:
    return f"{bar.from_us:>8} .. {'more' if bar.to_us is None else bar.to_us:<6} us"


def _drawn(ticks: int, most: int) -> str:
    """One mark for a single tick, all of them for the most."""
    return "#" * (ticks and 1 + round((WIDEST - 1) * math.log(ticks) / max(math.log(most), 1e-9)))


def _rate(told: LatencyReport) -> str:
    if not told.carries_hz:
        return "this lateness is too great for any usual rate"
    about = f"this lateness would carry {told.carries_hz} Hz"
    if told.carries_hz > told.tick_hz:
        return f"{about}; measure there before relying on it (--hz {told.carries_hz})"
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
        lines += [f"FAULT {fault.name}: {fault.cause}", f"  position {fault.position}", f"  remedy: {fault.remedy}"]
    if outcome.lost_steps and any(outcome.lost_steps.values()):
        lines.append(f"WARNING: lost steps: {_by_axis(outcome.lost_steps)}")
    return lines


def estimate_lines(told: Estimate) -> list[str]:
    """The lines that ``drillctl estimate`` prints."""
    about = "" if told.exact else "about "
    holes = f"{told.holes_total} holes, " if told.holes_total else ""
    seconds = told.ticks / told.tick_hz
    ticks = f"{about}{told.ticks} ticks at {told.tick_hz} Hz"
    lines = [f"{told.machine}: {holes}{ticks} = {clock(seconds)} of machine time"]
    for tool in told.tools:
        diameter = "?" if tool.diameter_mm is None else f"{tool.diameter_mm:.3f}"
        time = clock(tool.ticks / told.tick_hz)
        lines.append(f"  T{tool.number:<4} {diameter:>7} mm  {tool.holes:>6} holes  {time:>8}{_drill(tool)}")
    if told.fault:
        lines.append(f"it would end in FAULT {told.fault.name}: {told.fault.cause}")
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
