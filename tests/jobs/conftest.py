"""A folder with the board that journal and resume are tried with; the tests run in it."""

from tests.support.journalled import folder

__all__ = ["folder"]
