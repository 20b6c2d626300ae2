"""Where each homing of a run left the carriage, as a histogram: the plant's X in a VCD file, whenever a wait ends.

Usage: python histogram.py RUN.vcd
"""

import sys
from collections import Counter
from collections.abc import Iterator

from vcd.reader import TokenKind, tokenize

MM_PER_COLUMN = 25.4 / 1200
SIGN = 1 << 31  # integers in a VCD file are 32 bits wide


def changes(file: str) -> Iterator[tuple[str, str | int]]:
    """Signal, as SCOPE.NAME, and its new value."""
    names, scope = {}, ""
    with open(file, "rb") as stream:
        for token in tokenize(stream):
            if token.kind is TokenKind.SCOPE:
                scope = token.scope.ident
            elif token.kind is TokenKind.VAR:
                names[token.var.id_code] = f"{scope}.{token.var.reference}"
            elif token.kind is TokenKind.CHANGE_STRING:
                yield names[token.string_change.id_code], token.string_change.value
            elif token.kind is TokenKind.CHANGE_VECTOR:
                bits = int(token.vector_change.value)
                yield names[token.vector_change.id_code], (bits ^ SIGN) - SIGN


def places(file: str) -> list[int]:
    """In columns from where zero should be."""
    found, place, waiting = [], 0, False
    for name, value in changes(file):
        if name == "plant.x":
            place = int(value)
        elif name == "kmd.running":
            if waiting:
                found.append(place)
            waiting = value == "KMD_CZEKAJ"
    return found


def main() -> None:
    """A line for each place between the extremes."""
    counts = Counter(places(sys.argv[1]))
    for place in range(min(counts), max(counts) + 1):
        print(f"{place:4} columns {place * MM_PER_COLUMN:7.3f} mm {counts[place]:4} {'#' * counts[place]}")


if __name__ == "__main__":
    main()
