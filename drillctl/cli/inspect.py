"""``drillctl inspect FILE``: what a drill file holds, and which format it was read as."""

import argparse
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import jobs
from drillctl.cli.operating import waiting
from drillctl.language import json_text

if TYPE_CHECKING:
    from drillctl.generation.drillfile import DrillFile


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("inspect", help="say what a drill file holds", description=__doc__)
    verb.add_argument("file", type=Path, metavar="FILE", help="a drill file of any CAD program")
    jobs.add_reading(verb)
    verb.add_argument("--json", action="store_true", help="print one JSON object, also for a refused file")
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Prints the summary; a refused file is an error (exit 2)."""
    from drillctl.generation.drillfile import DrillFileError, read, summary
    from drillctl.generation.pcb_drill.board import refusal
    from drillctl.generation.waits import reading
    from drillctl.ui.terminal.reports import inspect_lines

    try:
        with waiting() as wait:
            advance = wait(reading(arguments.file.name))
            drill_file = read(arguments.file, fmt=arguments.format, after_end=arguments.after_end, advance=advance)
    except DrillFileError as error:
        raise refusal(arguments.file, error) from error
    contents = summary(drill_file)
    if arguments.json:
        print(json_text(contents, 2))
    else:
        print("\n".join(inspect_lines(arguments.file.name, contents)))
        print("\n".join(_drawing(drill_file)))
    return 0


def _drawing(drill_file: "DrillFile") -> list[str]:
    """Returns the board drawn as wide as the terminal, and at most half as high; nothing where
    braille can't be shown.
    """
    import numpy as np

    from drillctl.ui.widgets.dots import dot_rows

    if "utf" not in (sys.stdout.encoding or "").lower():
        return []
    columns, rows = shutil.get_terminal_size()
    points_mm = np.concatenate([drill_file.hole_xy_mm, drill_file.slot_mm.reshape(-1, 2)])
    return ["", *(f"  {row}" for row in dot_rows(points_mm, min(columns, 100) - 4, rows // 2))]
