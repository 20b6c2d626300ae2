"""How a job ended, in words. Rule: a stop says *position kept* or *position lost*; all comes from Outcome."""

from collections.abc import Mapping

from drillctl.panel import Estimate, Outcome, ToolEstimate
from drillctl.ui.progress import clock


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
