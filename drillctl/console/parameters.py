"""A machine's parameters changed and saved, for the screen's dialogs and for ``drillctl parameters``.

Rule: a machine's file changes whole or not at all, after the readers of files have found the new text sound. A machine
that comes with the program is saved as the user's own copy; any other in the file that it was read from. Changes by
several processes come one after the other, and none takes another's back.
"""

from collections.abc import Callable
from pathlib import Path

from drillctl.files.inputs import real_path
from drillctl.files.kept import alone
from drillctl.files.outputs import OutputError, write_text
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
        _changed(library, machine, target, change)  # or a refusal, before a folder is made
        with alone(target):
            return write_text(target, _changed(library, machine, target, change))
    except (TableError, ParameterError, OutputError) as error:
        return error.messages


def _changed(library: Library, machine: Machine, target: Path, change: Change) -> str:
    """The new text, made of what the file is now. Raises TableError, ParameterError."""
    text = change(Source.read(target if target.exists() else Path(machine.file)))
    library.check_source(Source(target, text))
    return text
