"""A drill file in a few words. Rule: exactly the fields of `inspect --json`, only ever added to.

The command line and the screens call `summary`.
"""

from __future__ import annotations

import numpy as np

from .model import DrillFile


def summary(drill_file: DrillFile) -> dict[str, object]:
    """Counts, tools, extent (mm), format and warnings, ready for json.dumps."""
    choice = drill_file.format
    return {
        "holes": len(drill_file.hole_xy_mm),
        "slots": len(drill_file.slot_mm),
        "routs": drill_file.routs,
        "tools": _tools(drill_file),
        "bbox_mm": None if drill_file.bbox_mm is None else [round(v, 6) for v in drill_file.bbox_mm],
        "units": choice.units,
        "format": choice.format,
        "zeros": choice.zeros,
        "dialect": choice.dialect,
        "confidence": drill_file.confidence,
        "runner_up": str(drill_file.runner_up) if drill_file.runner_up else None,
        "reason": drill_file.reason,
        "warnings": [remark.as_dict() for remark in drill_file.warnings],
    }


def _tools(drill_file: DrillFile) -> list[dict[str, object]]:
    size = len(drill_file.tools)
    holes = np.bincount(drill_file.hole_tool, minlength=size).tolist()
    slots = np.bincount(drill_file.slot_tool, minlength=size).tolist()
    return [
        {"number": tool.number, "diameter_mm": tool.diameter_mm, "count": count, "slots": slot_count}
        for tool, count, slot_count in zip(drill_file.tools, holes, slots, strict=True)
    ]
