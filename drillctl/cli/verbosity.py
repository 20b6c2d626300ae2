"""``-q`` and ``-v`` of every verb: how much is said on standard error beside errors and warnings.

``-q``: no notices and no progress. ``-v``: what the program reads, opens and chooses, by the logger ``drillctl`` of the
standard library; ``-vv``: every step of it. A program that imports drillctl sets that logger as any other.
"""

import argparse
import logging
import sys

from drillctl.cli import streams

LEVELS = (logging.WARNING, logging.INFO, logging.DEBUG)


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
