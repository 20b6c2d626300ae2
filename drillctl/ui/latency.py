"""How punctual this computer is, in words and as a histogram. A function of the record that ``--json`` prints."""

import math

from drillctl.panel.latency import Bar, LatencyReport, Lateness

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
