"""Numbers as people type and read them: durations, numbers, pairs of millimetres."""

import math


def clock(seconds: float) -> str:
    """Returns a duration as ``1:02:03`` (hours, minutes, seconds) or ``2:03``."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def pair_mm(text: str) -> tuple[float, float] | None:
    """Reads two finite numbers with a space or a semicolon between, with point or comma; None for anything else."""
    numbers = [number(part) for part in text.replace(";", " ").split()]
    if len(numbers) != 2 or numbers[0] is None or numbers[1] is None:
        return None
    return numbers[0], numbers[1]


def number(text: str) -> float | None:
    """Reads a finite number, with point or comma; None for anything else."""
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        return None
    return value if math.isfinite(value) else None
