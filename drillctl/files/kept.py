"""A file that is kept across power loss: replaced whole, and on the disk before the call returns.

Rule: at every moment the file has its last content or the new one, never a part of either. Changes by several
processes come one after the other.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from drillctl.files import system
from drillctl.files.outputs import Output, OutputError
from drillctl.language import Message, message_of


@contextmanager
def alone(path: Path) -> Iterator[None]:
    """Within it no other process is in ``alone`` for a file of the same folder; the folder is made where it is missing.

    Raises OutputError.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        folder = system.open_folder(path.parent)
        if folder >= 0:
            system.lock(folder, wait=True)
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        raise OutputError(Message("can't be written: {why}", why=message_of(error)).at(path)) from error
    try:
        yield
    finally:
        if folder >= 0:
            os.close(folder)


def replace(path: Path, text: str) -> None:
    """Writes the file's new content: beside it, to the disk, and then in its place. Raises OutputError; the last
    content then still stands.
    """
    output = Output(path, durable=True)
    try:
        output.write(lambda file: file.write(text))
    finally:
        output.drop()
