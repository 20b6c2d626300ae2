"""A machine's parameters changed and saved, for the screen's dialogs and for ``drillctl parameters``.

Rule: a machine's file changes whole or not at all, after the readers of files have found the new text sound. A machine
that comes with the program is saved as the user's own copy; any other in the file that it was read from.
"""

from collections.abc import Callable
from pathlib import Path

from drillctl.files.inputs import real_path
from drillctl.files.outputs import write_text
from drillctl.machine import Library, Machine, TableError, shipped_tables
from drillctl.machine.parameter_edit import ParameterError
from drillctl.machine.source import Source
from drillctl.viewmodel.console import Problems

Change = Callable[[Source], str]  # of parameter_edit.py; raises TableError or ParameterError


def saved_in(machine: Machine, user_folder: Path) -> Path:
    """The file that a machine's parameters are written to."""
    file = Path(machine.file)
    if shipped_tables() in real_path(file).parents:
        return user_folder / "machines" / file.name
    return file


def save(library: Library, machine: Machine, user_folder: Path, change: Change) -> Problems:
    """Changes the text of a machine's file and saves it; the problems for which it was left as it was."""
    target = saved_in(machine, user_folder)
    try:
        text = change(Source.read(Path(machine.file)))
        library.check_source(Source(target, text))
    except (TableError, ParameterError) as error:
        return error.messages
    return write_text(target, text)
