"""The holes of a drill file that nobody has loaded yet, for the picture beside a list of files.

Rule: costs no more than a person waits between two keys. So a longer file is not read, a slot is its two ends, and the
board is neither repeated nor put into another order.
"""

from pathlib import Path

import numpy as np

from drillctl.generation.pins import with_pins
from drillctl.generation.placing import Placing, PlacingError, boards
from drillctl.viewmodel.console import HolesView, ToolView
from drillctl.viewmodel.job_options import JobOptions

MOST_BYTES = 64 * 1024  # 4,000 holes, which take a tenth of a second to read


def holes_of(file: Path, options: JobOptions) -> HolesView | None:
    """The holes of a file, mirrored, turned and moved by these options; None where it is long, or no drill file."""
    from drillctl.generation.drillfile import DrillFileError, read  # loaded when a file is seen first

    try:
        if not file.is_file() or file.stat().st_size > MOST_BYTES:
            return None
        drill_file = read(file, fmt=options.format, after_end=options.after_end)
        if options.pins is not None:
            drill_file = with_pins(drill_file, options.pins).drill_file
        ends_mm = drill_file.slot_mm.reshape(-1, 2)
        xy_mm = np.concatenate([drill_file.hole_xy_mm, ends_mm])
        placing = Placing(
            origin=options.origin, mirror=options.mirror, rotate_deg=options.rotate_deg, offset_mm=options.offset_mm,
            pinned=options.pins is not None,
        )  # fmt: skip
        placed = boards(placing, xy_mm)[0].apply(xy_mm)
    except (DrillFileError, PlacingError, OSError):
        return None
    tool = np.concatenate([drill_file.hole_tool, np.repeat(drill_file.slot_tool, 2)]).astype(np.int64)
    counts = np.bincount(tool, minlength=len(drill_file.tools)).tolist()
    tools = [ToolView(t.number, t.diameter_mm, count) for t, count in zip(drill_file.tools, counts, strict=True)]
    return HolesView(placed, tool, tuple(tools)) if len(placed) else None
