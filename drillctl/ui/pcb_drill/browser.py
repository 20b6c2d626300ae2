"""A file browser: folders first, then the files that match a filter.

Rule: what can't be read shows as what it is, and never stops the browser: the reason takes its place.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import urwid

from drillctl.files.inputs import read_start, real_path
from drillctl.language import one_line
from drillctl.language.words import _
from drillctl.ui.widgets.finder import fits
from drillctl.ui.widgets.texts import Pick

DRILL_FILES = "*.drl *.drd *.xln *.xnc *.exc *.cnc *.nc *.txt *.tap *.ncd *.rou"
MOST_ENTRIES = 2000
PREVIEW_BYTES = 4096


class Browser(urwid.ListBox[int]):
    """The entries of a folder; ``chosen`` is called with a file, ``looked_at`` with what the cursor stands on."""

    def __init__(self, folder: Path, chosen: Callable[[Path], None], looked_at: Callable[[Path], None]):
        self._chosen, self._looked_at = chosen, looked_at
        self.pattern = DRILL_FILES
        self.folder = folder
        self._paths: list[Path] = []
        self._rows: urwid.SimpleFocusListWalker[urwid.AttrMap[Pick]] = urwid.SimpleFocusListWalker([])
        super().__init__(self._rows)
        self.go_to(folder)
        urwid.connect_signal(self._rows, "modified", self._moved)

    def go_to(self, folder: Path) -> None:
        """Lists the files of another folder."""
        self.folder = real_path(folder)
        found = list(self._found())
        self._paths = [path for path, _name in found]
        self._rows[:] = [urwid.AttrMap(self._row(*entry), "body", "focus") for entry in found]
        self._rows.set_focus(0)

    def stand_on(self, file: Path) -> None:
        """Shows a file's folder, the cursor on the file where the filter lets it through."""
        self.go_to(file.parent)
        if file in self._paths:
            self._rows.set_focus(self._paths.index(file))

    def filter(self, pattern: str) -> None:
        """Lists only files that have one of these parts in their names, or fit one with ``*``; every file for none."""
        self.pattern = pattern.strip() or "*"
        self.go_to(self.folder)

    @property
    def current(self) -> Path:
        """The path that the cursor is on."""
        return self._paths[self._rows.focus or 0]

    def _found(self) -> Iterator[tuple[Path, str]]:
        yield self.folder.parent, "../"
        try:
            entries = sorted(self.folder.iterdir(), key=lambda path: path.name.lower())
        except OSError as error:
            yield self.folder, f"({error.strerror})"
            return
        folders = [path for path in entries if path.is_dir() and not path.name.startswith(".")]
        files = [path for path in entries if not path.is_dir() and self._matches(path.name)]
        yield from ((path, f"{path.name}/") for path in folders[:MOST_ENTRIES])
        yield from ((path, path.name) for path in files[:MOST_ENTRIES])
        if max(len(folders), len(files)) > MOST_ENTRIES:
            yield self.folder, _("(more than can be shown: use the filter)")

    def _row(self, path: Path, name: str) -> Pick:
        return Pick(one_line(name), lambda: self._choose(path), wrap="ellipsis")

    def _matches(self, name: str) -> bool:
        return fits(name, self.pattern)

    def _choose(self, path: Path) -> None:
        if path.is_dir():
            self.go_to(path)
        else:
            self._chosen(path)

    def _moved(self) -> None:
        self._looked_at(self.current)


def preview(path: Path) -> list[str]:
    """The first lines of a file, with a dot for what can't be printed; the reason for one that can't be read."""
    if not path.is_file():
        return []
    try:
        text = read_start(path, PREVIEW_BYTES).decode("latin-1")
    except OSError as error:
        return [f"({error.strerror})"]
    return ["".join(c if c.isprintable() else "." for c in line) for line in text.splitlines()]
