"""The jobs opened last, in a file of the user's state folder. Called by the station.

Rule: a convenience. A list that is missing, damaged or of another version reads as an empty one, and one that can't be
written is given up without a word; no job ever fails for it.
"""

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import msgspec

from drillctl.files.inputs import read_bytes, real_path
from drillctl.files.outputs import write_text
from drillctl.viewmodel.jobs import Asked, RecentJob

MOST_RECENT = 9  # as many as there are digits to choose them by
LARGEST_LIST_BYTES = 64 * 1024


class _File(msgspec.Struct, forbid_unknown_fields=True):
    recent: list[RecentJob]


@dataclass(frozen=True)
class RecentJobs:
    """The newest first, each drill file once, with the settings it was opened with last."""

    file: Path

    def read(self) -> list[RecentJob]:
        """Never raises for what the file holds."""
        try:
            data = read_bytes(self.file, LARGEST_LIST_BYTES, "a list of jobs")
            return msgspec.json.decode(data, type=_File).recent[:MOST_RECENT]
        except (OSError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return []

    def add(self, file: Path, asked: Asked) -> None:
        """To the front. A file whose name is not Unicode can't be listed."""
        newest = RecentJob(str(real_path(file)), asked)
        others = [job for job in self.read() if job.file != newest.file]
        with suppress(UnicodeEncodeError):
            write_text(self.file, msgspec.json.encode(_File([newest, *others][:MOST_RECENT])).decode())
