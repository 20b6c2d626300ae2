"""The jobs opened last, in a file of the user's state folder.

Rule: no job ever fails for this list. One that is missing, damaged or of another version reads as empty, and one that
can't be written is left unwritten.
"""

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import msgspec

from drillctl.files.inputs import read_bytes, real_path
from drillctl.files.outputs import write_text
from drillctl.language import Message
from drillctl.viewmodel.jobs import Asked, RecentJob

MOST_RECENT = 9  # as many as there are digits to choose them by
LARGEST_LIST_BYTES = 64 * 1024


class _File(msgspec.Struct, forbid_unknown_fields=True):
    recent: list[RecentJob]


@dataclass(frozen=True)
class RecentJobs:
    """A list of drill files, the newest first, each once, with the options it was opened with last."""

    file: Path

    def read(self) -> list[RecentJob]:
        """The list, empty where the file can't be read as one."""
        try:
            data = read_bytes(self.file, LARGEST_LIST_BYTES, Message("a list of jobs"))
            return msgspec.json.decode(data, type=_File).recent[:MOST_RECENT]
        except (OSError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return []

    def add(self, file: Path, asked: Asked) -> None:
        """Puts a drill file to the front. A file whose name is not Unicode is left out."""
        newest = RecentJob(str(real_path(file)), asked)
        others = [job for job in self.read() if job.file != newest.file]
        with suppress(UnicodeEncodeError):
            write_text(self.file, msgspec.json.encode(_File([newest, *others][:MOST_RECENT])).decode())
