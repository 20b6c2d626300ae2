"""Digits three rows high, bars and charts, as text: for what is read from across a room."""

from drillctl.language.words import _

# A figure is three rows of as many characters; with UTF-8, and without.
LIGHT = {
    "0": ("┌─┐", "│ │", "└─┘"), "1": ("  ╷", "  │", "  ╵"), "2": ("╶─┐", "┌─┘", "└─╴"), "3": ("╶─┐", "╶─┤", "╶─┘"),
    "4": ("╷ ╷", "└─┤", "  ╵"), "5": ("┌─╴", "└─┐", "╶─┘"), "6": ("┌─╴", "├─┐", "└─┘"), "7": ("╶─┐", "  │", "  ╵"),
    "8": ("┌─┐", "├─┤", "└─┘"), "9": ("┌─┐", "└─┤", "╶─┘"), "-": ("   ", "╶─╴", "   "), ".": (" ", " ", "."),
    " ": ("   ", "   ", "   "),
}  # fmt: skip
PLAIN = {
    "0": (" _ ", "| |", "|_|"), "1": ("   ", "  |", "  |"), "2": (" _ ", " _|", "|_ "), "3": (" _ ", " _|", " _|"),
    "4": ("   ", "|_|", "  |"), "5": (" _ ", "|_ ", " _|"), "6": (" _ ", "|_ ", "|_|"), "7": (" _ ", "  |", "  |"),
    "8": (" _ ", "|_|", "|_|"), "9": (" _ ", "|_|", " _|"), "-": ("   ", " _ ", "   "), ".": (" ", " ", "."),
    " ": ("   ", "   ", "   "),
}  # fmt: skip
FULL, HALF, EMPTY = "█", "▌", "░"
LEVELS, PLAIN_LEVELS = " ▁▂▃▄▅▆▇█", " .:-=+*#@"


def large(text: str, plain: bool = False) -> tuple[str, str, str]:
    """Three rows that show digits, minus, point and space in large figures, a column between each two."""
    figures = PLAIN if plain else LIGHT
    top, middle, bottom = (" ".join(figures[sign][row] for sign in text) for row in range(3))
    return top, middle, bottom


def bar(part: float, columns: int, plain: bool = False) -> str:
    """A bar of so many columns, filled to ``part`` of 1, to half a column; without UTF-8 to a column."""
    halves = round(min(max(part, 0.0), 1.0) * columns * 2)
    if plain:
        return "#" * (halves // 2) + "." * (columns - halves // 2)
    return (FULL * (halves // 2) + HALF * (halves % 2)).ljust(columns, EMPTY)


def gauge(done: int, total: int, columns: int, plain: bool = False) -> str:
    """A bar with the part that is done behind it, in per cent rounded down: 100 % is said of the whole alone."""
    part = done / total if total else 0.0
    percent = _("{percent:3} %").format(percent=100 * done // total if total else 0)
    return f"{bar(part, max(columns - len(percent) - 1, 0), plain)} {percent}"


def strip(values: list[float], most: float, columns: int, plain: bool = False) -> str:
    """The last ``columns`` values as columns of a chart one row high, from 0 to ``most``; any above 0 is seen."""
    levels = PLAIN_LEVELS if plain else LEVELS
    top = len(levels) - 1
    heights = [min(max(round(value / most * top), value > 0), top) if most > 0 else 0 for value in values[-columns:]]
    return "".join(levels[height] for height in heights).rjust(columns) if columns > 0 else ""
