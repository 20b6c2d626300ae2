"""Where a trace goes to or comes from: a path, or a file that is open already.

Rule: UTF-8 and LF on every platform. What is not valid UTF-8 is passed on as a character that no line allows, so the
reader can name the line it is in.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from io import TextIOWrapper
from typing import TextIO

from drillctl.files import inputs

Target = str | os.PathLike[str] | TextIO


@contextmanager
def opened(target: Target, mode: str) -> Iterator[TextIO]:
    """Gives the text file behind `target`, closed afterwards if it was opened here. Raises OSError as `open`."""
    if isinstance(target, str | os.PathLike):
        plain = inputs.opened(target) if mode == "r" else open(target, mode + "b")  # noqa: SIM115 - by the next line
        with TextIOWrapper(plain, "utf-8", "surrogateescape", "\n") as file:
            yield file
    else:
        yield target
