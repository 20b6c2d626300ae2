"""``-q`` and ``-v`` of every verb: how much is said on standard error beside errors and warnings.

``-q``: no notices and no progress. ``-v``: what the program reads, opens and chooses, by the logger ``drillctl`` of the
standard library; ``-vv``: every step of it. A program that imports drillctl sets that logger as any other.
"""

import argparse
import logging
import sys
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager

from drillctl.cli import streams

LEVELS = (logging.WARNING, logging.INFO, logging.DEBUG)
MOST_KEPT = 200  # records while a screen has the terminal; older ones are dropped


def add(verb: argparse.ArgumentParser) -> None:
    """Adds both options to a verb, in a group of their own."""
    said = verb.add_argument_group("what is said").add_mutually_exclusive_group()
    said.add_argument("-q", "--quiet", action="store_true", help="only errors and warnings: no notices, no progress")
    verbose = "say what is read, opened and chosen; -vv: more"
    said.add_argument("-v", "--verbose", action="count", default=0, help=verbose)


def set_from(arguments: argparse.Namespace) -> None:
    """Sets notices and logging for this call."""
    streams.quiet(getattr(arguments, "quiet", False))
    level = LEVELS[min(getattr(arguments, "verbose", 0), len(LEVELS) - 1)]
    logging.basicConfig(level=logging.WARNING, stream=sys.stderr, format="drillctl: %(message)s", force=True)
    logging.getLogger("drillctl").setLevel(level)


@contextmanager
def held_back() -> Iterator[None]:
    """Within it log records are kept, and said when it ends: a line in between would be written across the screen."""
    root = logging.getLogger()
    said, kept = root.handlers[:], _Kept()
    root.handlers[:] = [kept]
    try:
        yield
    finally:
        root.handlers[:] = said
        for record in kept.records:
            root.handle(record)


class _Kept(logging.Handler):
    """Keeps the newest records."""

    def __init__(self) -> None:
        super().__init__()
        self.records: deque[logging.LogRecord] = deque(maxlen=MOST_KEPT)

    def emit(self, record: logging.LogRecord) -> None:
        """Appends a record to those kept; beyond MOST_KEPT the oldest one is dropped."""
        self.records.append(record)
