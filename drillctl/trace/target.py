"""Where a trace goes to or comes from: a path, or a file that is open already.

Rule: UTF-8 and LF whatever the platform. What is not valid UTF-8 is handed on as a character that no line
allows, so the reader can name the line it stands in. Called by text, reader and vcd.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO, cast

Target = str | os.PathLike[str] | TextIO


@contextmanager
def opened(target: Target, mode: str) -> Iterator[TextIO]:
    """The text file behind `target`, closed afterwards if it was opened here. Raises OSError as `open`."""
    if isinstance(target, str | os.PathLike):
        with open(target, mode, encoding="utf-8", errors="surrogateescape", newline="\n") as file:
            yield cast(TextIO, file)
    else:
        yield target
