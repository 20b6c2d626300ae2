"""A machine and the tables that it names as one text: what LOAD hands to a process that has the machine running.

Rule: what is read from it is checked by the readers of files, with the same messages.
"""

import json
from collections.abc import Iterator
from pathlib import Path

from drillctl.files.inputs import json_of
from drillctl.machine.config import parse_machine
from drillctl.machine.model import Machine
from drillctl.machine.parts import Parts
from drillctl.machine.source import Source


def bundle(machine: Machine) -> str:
    """Returns the machine's files as they are now, its own first. Raises TableError where one can't be read."""
    files = dict.fromkeys(machine.files)
    return json.dumps({"shipped": machine.shipped, "files": [(file, Source.read(Path(file)).text) for file in files]})


def unbundle(text: str) -> Machine:
    """Returns the machine of a bundle. Raises TableError, which names the file that is wrong."""
    bundled = json_of(text)
    sources = [Source(Path(file), content) for file, content in bundled["files"]]
    return parse_machine(sources[0], bundled["shipped"], _BundledParts(sources))


class _BundledParts(Parts):
    """Finds tables among the texts of a bundle, by folder and name as in the library."""

    def __init__(self, sources: list[Source]):
        super().__init__((), sources[0].file)
        self._sources = sources[1:]

    def _find(self, kind: str, name: str) -> Source | None:
        fitting = (s for s in self._sources if s.file.parent.name == kind and s.file.stem == name)
        return next(fitting, None)

    def _motors(self) -> Iterator[Source]:
        return (source for source in self._sources if source.file.parent.name == "motor")
