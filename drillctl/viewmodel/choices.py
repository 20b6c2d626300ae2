"""What options of a job may be, by name: one table for the command line, the screens, journals, and layer 2.

Rule: nothing heavy is imported here.
"""

from typing import Literal, get_args

Origin = Literal["base", "file"]
Mirror = Literal["x", "y"]
Order = Literal["file", "nearest", "optimised"]
AfterEnd = Literal["refuse", "ignore", "drill"]

ORIGINS: tuple[str, ...] = get_args(Origin)
MIRRORED: tuple[str, ...] = get_args(Mirror)
ORDERS: tuple[str, ...] = get_args(Order)
MOST_ORDER_SECONDS = 86_400
AFTER_END: tuple[str, ...] = get_args(AfterEnd)
