"""What options of a job and of a sweep may be, by name: one table for the command line, the library, the screens,
journals, and layer 2.

Rule: nothing heavy is imported here.
"""

from typing import Literal, get_args

Origin = Literal["base", "file"]
Mirror = Literal["x", "y"]
Order = Literal["file", "nearest", "optimised"]
AfterEnd = Literal["refuse", "ignore", "drill"]
PinPlaces = Literal["corners", "left-right", "top-bottom"]

ORIGINS: tuple[str, ...] = get_args(Origin)
MIRRORED: tuple[str, ...] = get_args(Mirror)
ORDERS: tuple[str, ...] = get_args(Order)
MOST_ORDER_SECONDS = 86_400
PIN_PLACES: tuple[str, ...] = get_args(PinPlaces)
AFTER_END: tuple[str, ...] = get_args(AfterEnd)
MOST_WORKERS = 1024  # processes of a sweep
MOST_DRAWS = 100_000
GREATEST_SPREAD = 0.5
