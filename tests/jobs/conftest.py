"""A folder with the board that journal and resume are tried with; the tests run in it. A magazine record."""

from tests.jobs.near_machine import kept
from tests.support.journalled import folder

__all__ = ["folder", "kept"]
