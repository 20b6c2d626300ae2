"""What a part program does, found from its characters alone: an independent reading of the sentence format.

It shares nothing with drillctl: the paper's sentence is six characters, and a store three bytes a sentence.
"""

SPEEDS = ("0.16", "0.2", "0.25", "0.315", "0.4", "0.5", "0.63", "0.8", "1", "1.25", "1.6", "2", "2.5", "3.15", "4", "5")
ARROWS = {"2": (0, -1), "4": (-1, 0), "6": (1, 0), "8": (0, 1)}  # (large carriage, small carriage)
PULSE_MM = 0.02


def decoded(text: str) -> list[tuple[int, int, float]]:
    """Steps of the large and of the small carriage and m/min, a row for each sentence of a text."""
    rows = []
    for line in text.splitlines():
        code = line.split("#")[0].strip()
        if code:
            rows.append(decoded_sentence(code))
    return rows


def decoded_sentence(code: str) -> tuple[int, int, float]:
    steps = round(int(code[2:], 10) * 0.1 / PULSE_MM)
    along, across = ARROWS[code[0]]
    return along * steps, across * steps, float(SPEEDS["0123456789ABCDEF".index(code[1].upper())])


def decoded_store(cells: bytes, number: int) -> list[tuple[int, int, float]]:
    """The same of a workpiece, as the 8031 walks through its cells."""
    pointer = cells[2 * number - 2] * 256 + cells[2 * number - 1]
    rows = []
    while cells[pointer] != 0xFF:
        rows.append(decoded_sentence("".join(f"{byte:02X}" for byte in cells[pointer : pointer + 3])))
        pointer += 3
    return rows
