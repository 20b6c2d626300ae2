"""``drillctl inspect FILE``: what a drill file holds, and which format it was read as; what a part program does."""

import argparse
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import jobs, options, part_programs
from drillctl.language import json_text

if TYPE_CHECKING:
    from drillctl.generation.drillfile import DrillFile


def add(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Adds the verb to the command line."""
    verb = verbs.add_parser("inspect", help="say what a drill file or a part program holds", description=__doc__)
    kinds = "a drill file of any CAD program, a part program (.sentences), or a workpiece (01..99)"
    verb.add_argument("file", type=Path, metavar="FILE", help=kinds)
    options.add_machine(verb)
    jobs.add_reading(verb)
    jobs.add_pins(verb)
    jobs.add_mill(verb)
    jobs.add_store(verb)
    part_programs.add_language(verb)
    verb.add_argument("--json", action="store_true", help="print one JSON object, also for a refused file")
    verb.set_defaults(call=call)


def call(arguments: argparse.Namespace) -> int:
    """Prints the summary; a refused file is an error (exit 2)."""
    return _part_program(arguments) if _is_part_program(arguments) else _drill_file(arguments)


def _is_part_program(arguments: argparse.Namespace) -> bool:
    """Returns whether it is a part program's file or a workpiece; the machine is read only where that depends on it."""
    from drillctl.generation.boiler_drum.names import is_sentences

    if not str(arguments.file).isdecimal():
        return is_sentences(arguments.file)
    from drillctl.generation.boiler_drum.part import is_workpiece

    return is_workpiece(arguments.file, options.machine(arguments))


def _part_program(arguments: argparse.Namespace) -> int:
    from drillctl.generation.boiler_drum.part import part_of

    part_programs.speak(arguments)
    part = part_of(arguments.file, options.machine(arguments), arguments.store)
    if arguments.json:
        print(json_text(part_programs.as_dict(part), 2))
    else:
        print("\n".join(part_programs.lines(part)))
    return 0


def _drill_file(arguments: argparse.Namespace) -> int:
    from drillctl.generation.drillfile import summary
    from drillctl.ui.terminal.drill_file_report import inspect_lines

    drill_file = jobs.read_drill_file(arguments)
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
