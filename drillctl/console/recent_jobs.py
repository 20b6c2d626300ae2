"""The jobs opened last, in a file of the user's state folder.

Rule: no job ever fails for this list. A list that is missing or damaged reads as empty, a row of it that is of another
version is left out, and a list that can't be written is left unwritten.
"""

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec

from drillctl.files.inputs import read_bytes, real_path
from drillctl.files.outputs import write_text
from drillctl.language import Message
from drillctl.viewmodel.job_options import NAMES_IN_FILES, JobOptions
from drillctl.viewmodel.jobs import RecentJob

MOST_RECENT = 9  # as many as there are digits to choose them by
LARGEST_LIST_BYTES = 64 * 1024


class _Row(msgspec.Struct, forbid_unknown_fields=True, omit_defaults=True):
    """A job: its drill file, and its options; those of older versions as ``asked``, in a form of their own."""

    file: str
    options: JobOptions | None = None
    asked: dict[str, Any] | None = None


class _File(msgspec.Struct, forbid_unknown_fields=True):
    recent: list[Any]


@dataclass(frozen=True)
class RecentJobs:
    """A list of drill files, the newest first, each once, with the options it was opened with last."""

    file: Path

    def read(self) -> list[RecentJob]:
        """The list, empty where the file can't be read as one."""
        try:
            data = read_bytes(self.file, LARGEST_LIST_BYTES, Message("a list of jobs"))
            rows = msgspec.json.decode(data, type=_File).recent
        except (OSError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return []
        jobs: list[RecentJob] = []
        for row in rows[:MOST_RECENT]:
            with suppress(msgspec.ValidationError):
                jobs.append(_job(msgspec.convert(row, _Row)))
        return jobs

    def add(self, file: Path, options: JobOptions) -> None:
        """Puts a drill file to the front. A file whose name is not Unicode is left out."""
        newest = RecentJob(str(real_path(file)), options)
        others = [job for job in self.read() if job.file != newest.file]
        rows = [_Row(job.file, job.options) for job in [newest, *others][:MOST_RECENT]]
        with suppress(UnicodeEncodeError):
            write_text(self.file, msgspec.json.encode(_File(rows)).decode())


def _job(row: _Row) -> RecentJob:
    return RecentJob(row.file, row.options or (_of_older_version(row.asked) if row.asked else JobOptions()))


def _of_older_version(asked: dict[str, Any]) -> JobOptions:
    """Options whose names had their unit, whose panel and holes were objects, and whose usual origin was 'base'."""
    objects = msgspec.convert(asked, _OlderObjects)
    fields = {NAMES_IN_FILES.get(name, name): value for name, value in asked.items() if name != "measured"}
    fields["origin"] = None if asked.get("origin") == "base" else asked.get("origin")
    fields["panel"] = objects.panel and list(objects.panel.values())  # in the order of the fields of PanelOf
    fields["align"] = [list(hole.values()) for hole in objects.measured] or None
    return msgspec.convert(fields, JobOptions)


class _OlderObjects(msgspec.Struct):
    panel: dict[str, int | float] | None = None
    measured: list[dict[str, float]] = []
