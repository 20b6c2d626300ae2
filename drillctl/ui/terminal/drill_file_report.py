"""A drill file in words: tools, counts, size, format and why. A function of the summary that ``--json`` prints."""

from collections.abc import Mapping
from typing import Any


def inspect_lines(name: str, summary: Mapping[str, Any]) -> list[str]:
    """The lines that ``drillctl inspect`` prints."""
    lines = [f"{name}: {summary['holes']} holes, {summary['slots']} slots, {summary['routs']} milled cuts"]
    if box := summary["bbox_mm"]:
        lines.append(f"  {box[2] - box[0]:.3f} x {box[3] - box[1]:.3f} mm, X {box[0]:.3f}..{box[2]:.3f}, "
                     f"Y {box[1]:.3f}..{box[3]:.3f}")  # fmt: skip
    zeros = f", {summary['zeros']} zeros suppressed" if summary["zeros"] else ""
    confidence = f"(confidence {summary['confidence']:.0%})"
    lines.append(f"  {summary['units']} {summary['format']}{zeros} {confidence}: {summary['reason']}")
    lines += [_tool_line(tool) for tool in summary["tools"]]
    lines += [f"  warning: {_place(name, warning)}{warning['reason']}" for warning in summary["warnings"]]
    return lines


def _tool_line(tool: Mapping[str, Any]) -> str:
    diameter = "?" if tool["diameter_mm"] is None else f"{tool['diameter_mm']:.3f}"
    slots = f", {tool['slots']} slots" if tool["slots"] else ""
    return f"  T{tool['number']:<4} {diameter:>7} mm  {tool['count']:>6} holes{slots}"


def _place(name: str, warning: Mapping[str, Any]) -> str:
    return f"{name}:{warning['line']}: " if warning["line"] else ""
