"""Whether a name may be opened from the screen.

Rule: what could keep the program waiting (a pipe, a device) is refused before it is opened; whether a file is there,
and what is in it, its reader says. Called by what opens files for a screen.
"""

from pathlib import Path

from drillctl.panel.console import Problems


def keeps_waiting(file: Path) -> Problems:
    """The reason why it is not opened; none for a file, a folder, or a name of nothing."""
    try:
        waits = file.exists() and not (file.is_file() or file.is_dir())
    except (OSError, ValueError):  # a name that can't be: its reader says so
        return ()
    return (f"{file}: a pipe or a device, not a file",) if waits else ()
